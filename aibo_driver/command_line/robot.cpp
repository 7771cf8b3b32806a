#include "command_line/robot.h"

#include <poll.h>

#include <algorithm>

#include "aibo_client/exceptions.h"
#include "command_line/interruption.h"
#include "command_line/quantities.h"

namespace aibo_driver::command_line {

using aibo_client::ClientOptions;
using aibo_client::ConnectionState;
using aibo_client::ConnectionStatus;
using aibo_client::EndedHow;
using aibo_client::FaultKind;
using aibo_client::LogLevel;
using aibo_client::RcServerClient;
using aibo_client::RefusalCause;
using aibo_client::RefusedRequest;

namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr std::size_t kMostWarnings = 64;
constexpr int kMostTurnsAway = 4;  // the client waits between the attempts, so this takes about a second

ClientOptions optionsFor(const RobotAddress& address, ClientOptions options) {
  options.host = address.host;
  options.port = address.port;
  options.connect_timeout = std::clamp(address.timeout, milliseconds(50), options.connect_timeout);
  return options;
}

std::string wordsOf(const aibo_client::Refusal& refusal) {
  return (refusal.cause == RefusalCause::kRobot ? "the robot refused: " : "") + refusal.reason;
}

const char* wordsOf(EndedHow how) {
  switch (how) {
    case EndedHow::kDone:
      return "was done";
    case EndedHow::kReplaced:
      return "was replaced";
    case EndedHow::kStopped:
      return "was stopped";
    case EndedHow::kRefused:
      return "could not go on";
    case EndedHow::kFell:
      return "ended because the robot fell or was lifted";
    case EndedHow::kUnknown:
    case EndedHow::kNotReached:
    case EndedHow::kLost:
      break;
  }
  return "ended in a way that this program does not know";
}

/// Limits a list that a robot can make endless. The newest items are kept.
template <typename Kept>
void keep(const Kept& one, std::size_t most, std::deque<Kept>* kept) {
  kept->push_back(one);
  if (kept->size() > most) {
    kept->pop_front();
  }
}

}  // namespace

Robot::Robot(const RobotAddress& address, Output& output, const ClientOptions& base,
             std::function<void(const aibo_client::SoundEnd& end)> on_sound_ended)
    : address_(address), output_(output), on_sound_ended_(std::move(on_sound_ended)) {
  client_ = std::make_unique<RcServerClient>(optionsFor(address, base), callbacks());
}

Robot::~Robot() {
  client_->stop();
  // The client has logged why the connection was lost, and that it tries again. A command that ends with the connection
  // does not try again, and reports the reason itself.
  const auto says_why = [this](const std::string& text) { return text.find(last_loss_) != std::string::npos; };
  if (!last_loss_.empty()) {
    warnings_.erase(std::remove_if(warnings_.begin(), warnings_.end(), says_why), warnings_.end());
  }
  showWarnings();
}

void Robot::connect() {
  client_->start();
  const bool in_time = waitUntil(
      [](const Received& received) {
        const ConnectionStatus& status = received.status;
        const bool tries_again = status.fault == FaultKind::kTurnedAway && received.failures < kMostTurnsAway;
        return status.state == ConnectionState::kConnected ||
               (status.state == ConnectionState::kDisconnected && status.fault != FaultKind::kNone && !tries_again);
      },
      address_.timeout, Loss::kIsTolerated);
  const Received received = this->received();
  if (received.status.state == ConnectionState::kConnected) {
    return;
  }
  if (!in_time && received.status.reason.empty()) {
    throw aibo_client::TimeoutException(aibo_client::addressText(address_.host, address_.port) +
                                            " did not answer within " + std::to_string(address_.timeout.count()) +
                                            " ms. Is the robot switched on, is its WLAN " +
                                            "up, and is this its address?",
                                        FaultKind::kNoAnswer);
  }
  checkConnection(received);
}

const robot_model::RobotModel& Robot::model() const {
  const std::string design = received().status.robot.design;
  const robot_model::RobotModel* const model = robot_model::findRobotModel(design.empty() ? "ERS-7" : design.c_str());
  if (model == nullptr) {
    throw aibo_client::CommandException("the robot says that it is of the design '" + design +
                                        "', which this program does not know");
  }
  return *model;
}

aibo_client::OrderTerms Robot::terms() {
  aibo_client::OrderTerms terms;
  terms.number = kOrder;
  return terms;
}

Received Robot::received() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return received_;
}

std::vector<ArrivedPicture> Robot::takePictures() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<ArrivedPicture> pictures(received_.pictures.begin(), received_.pictures.end());
  received_.pictures.clear();
  return pictures;
}

std::deque<aibo_client::HeardSound> Robot::takeSounds() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(received_.sounds, {});
}

bool Robot::waitUntil(const std::function<bool(const Received&)>& done, nanoseconds timeout, Loss loss) {
  const steady_clock::time_point deadline = steady_clock::now() + timeout;
  for (;;) {
    changed_.clear();
    if (interruption() != 0 && !std::exchange(is_interrupted_, true)) {
      throw Interrupted("interrupted");
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (done(received_)) {
        return true;
      }
      if (loss == Loss::kFails) {
        checkConnection(received_);
      }
    }
    if (steady_clock::now() >= deadline) {
      return false;
    }
    waitForEvent(deadline);
  }
}

bool Robot::waitUnlessRefused(const std::function<bool(const Received&)>& done, nanoseconds timeout) {
  const bool in_time = waitUntil([&](const Received& received) { return received.refusal || done(received); }, timeout);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const std::optional<std::string> refusal = std::exchange(received_.refusal, std::nullopt)) {
    throw aibo_client::CommandException(*refusal);
  }
  return in_time;
}

std::optional<std::string> Robot::waitForEnd(const std::string& name, double seconds) {
  if (!waitUntil([](const Received& received) { return received.end.has_value(); }, nanosecondsOf(seconds))) {
    return std::nullopt;
  }
  const aibo_client::ActivityEnd end = *received().end;
  if (end.how != EndedHow::kDone) {
    throw FailedException(name + " " + wordsOf(end.how) + (end.reason.empty() ? "" : ": " + end.reason));
  }
  return end.reason;
}

aibo_client::Callbacks Robot::callbacks() {
  aibo_client::Callbacks callbacks;
  callbacks.on_status = [this](const ConnectionStatus& status) { noteStatus(status); };
  callbacks.on_picture = [this](const aibo_client::PicturePtr& picture) { notePicture(picture); };
  callbacks.on_telemetry = [this](const aibo_client::Telemetry& telemetry) { noteTelemetry(telemetry); };
  callbacks.on_joints_accepted = [this](const std::vector<aibo_client::JointTarget>& targets) {
    change([&] {
      for (const aibo_client::JointTarget& target : targets) {
        received_.accepted_joints[target.id] = target.position;
      }
    });
  };
  callbacks.on_steered = [this](const aibo_client::WalkVelocity& in_force, std::uint64_t, std::uint64_t) {
    change([&] { received_.velocity = in_force.isZero() ? received_.velocity : in_force; });
  };
  callbacks.on_refused = [this](const aibo_client::Refusal& refusal) { noteRefusal(refusal); };
  callbacks.on_ended = [this](const aibo_client::ActivityEnd& end) {
    change([&] {
      if (end.order == kOrder && !received_.end) {
        received_.end = end;
      }
    });
  };
  callbacks.on_heard = [this](const aibo_client::HeardSound& sound) {
    change([&] { keep(sound, kMostSounds, &received_.sounds); });
  };
  callbacks.on_sound_ended = [this](const aibo_client::SoundEnd& end) {
    if (on_sound_ended_) {
      on_sound_ended_(end);
    }
    changed_.raise();
  };
  callbacks.log = [this](LogLevel level, const std::string& message) { noteLog(level, message); };
  return callbacks;
}

template <typename Change>
void Robot::change(const Change& change) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    change();
  }
  changed_.raise();
}

void Robot::noteStatus(const ConnectionStatus& status) {
  change([&] {
    if (status.state == ConnectionState::kDisconnected && status.fault != FaultKind::kNone) {
      ++received_.failures;
      last_loss_ = status.reason;
    }
    received_.status = status;
  });
}

void Robot::notePicture(const aibo_client::PicturePtr& picture) {
  change([&] {
    ArrivedPicture arrived = {picture, steady_clock::now()};
    if (picture->frame_number) {
      const steady_clock::time_point taken =
          clock_.timeOf(picture->connection_number, *picture->frame_number, picture->first_byte_time);
      arrived.age = std::max(0.0, std::chrono::duration<double>(arrived.time - taken).count());
    }
    received_.pictures.push_back(arrived);
    if (received_.pictures.size() > kMostPictures) {
      received_.pictures.pop_front();
      ++received_.lost_pictures;
    }
  });
}

void Robot::noteTelemetry(const aibo_client::Telemetry& telemetry) {
  change([&] {
    for (const aibo_client::JointReading& joint : telemetry.joints) {
      received_.joints[joint.id] = joint;
    }
    for (const aibo_client::SensorReading& sensor : telemetry.sensors) {
      received_.sensors[sensor.id] = sensor.value;
    }
  });
}

// The user hears of the refusal of a motion or posture from the exception of its call. If an order was replaced or
// stopped before it was sent, this program has done so.
void Robot::noteRefusal(const aibo_client::Refusal& refusal) {
  const bool has_a_call = refusal.request == RefusedRequest::kMotion || refusal.request == RefusedRequest::kPosture;
  const bool is_ours = refusal.cause == RefusalCause::kReplaced || refusal.cause == RefusalCause::kStopped;
  change([&] {
    if (!has_a_call && !is_ours && !received_.refusal) {
      received_.refusal = wordsOf(refusal);
    }
  });
}

// The reason for a missing connection is not noted: checkConnection() and the statistics of `watch` show it.
void Robot::noteLog(LogLevel level, const std::string& message) {
  if (level >= LogLevel::kWarn) {
    change([&] {
      if (received_.status.state == ConnectionState::kConnected) {
        keep(message, kMostWarnings, &warnings_);
      }
    });
  }
}

void Robot::checkConnection(const Received& received) const {
  const ConnectionStatus& status = received.status;
  if (status.state == ConnectionState::kConnected) {
    return;
  }
  std::string advice = status.advice;
  if (!address_.host_is_given && status.fault == FaultKind::kRefused) {
    advice += " To say which robot is meant, give --host NAME or set AIBO_HOST.";
  }
  throw aibo_client::NetworkException(
      (status.reason.empty() ? "there is no connection to the robot" : status.reason) + ". " + advice, status.fault);
}

void Robot::showWarnings() {
  std::deque<std::string> warnings;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    warnings.swap(warnings_);
    if (const std::optional<std::string> refusal = std::exchange(received_.refusal, std::nullopt)) {
      warnings.push_back(*refusal);
    }
  }
  for (const std::string& warning : warnings) {
    output_.note("aibo: " + warning);
  }
}

void Robot::waitForEvent(steady_clock::time_point deadline) {
  pollfd polled[] = {{changed_.descriptor(), POLLIN, 0}, {is_interrupted_ ? -1 : interruptionDescriptor(), POLLIN, 0}};
  const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
  ::poll(polled, 2, static_cast<int>(std::clamp(left, milliseconds(0), milliseconds(60000)).count()));
}

}  // namespace aibo_driver::command_line
