#include "command_line/robot.h"

#include <poll.h>

#include <algorithm>
#include <optional>

#include "aibo_driver/exceptions.h"
#include "command_line/interruption.h"

namespace aibo_driver::command_line {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr std::size_t kMostWarnings = 64;
constexpr int kMostTurnsAway = 4;  // with the client's waits between them, about a second

ClientOptions optionsFor(const RobotAddress& address, ClientOptions options) {
  options.host = address.host;
  options.port = address.port;
  options.connect_timeout = std::clamp(address.timeout, milliseconds(50), options.connect_timeout);
  return options;
}

/// Of what a robot can send without end, the newest are kept.
template <typename Kept>
void keep(const Kept& one, std::size_t most, std::deque<Kept>* kept) {
  kept->push_back(one);
  if (kept->size() > most) {
    kept->pop_front();
  }
}

}  // namespace

Robot::Robot(const RobotAddress& address, Output& output, const ClientOptions& base)
    : address_(address), output_(output) {
  client_ = std::make_unique<RcServerClient>(optionsFor(address, base), callbacks());
}

Robot::~Robot() {
  client_->stop();
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
    throw TimeoutException(address_.host + ":" + std::to_string(address_.port) + " did not answer within " +
                               std::to_string(address_.timeout.count()) +
                               " ms. Is the robot switched on, is its WLAN " + "up, and is this its address?",
                           FaultKind::kNoAnswer);
  }
  checkConnection(received);
}

const robot_model::RobotModel& Robot::model() const {
  const std::string design = received().status.robot.design;
  const robot_model::RobotModel* const model = robot_model::findRobotModel(design.empty() ? "ERS-7" : design.c_str());
  if (model == nullptr) {
    throw CommandException("the robot says that it is of the design '" + design +
                           "', which this program does not know");
  }
  return *model;
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

bool Robot::waitUntil(const std::function<bool(const Received&)>& done, nanoseconds timeout, Loss loss) {
  const steady_clock::time_point deadline = steady_clock::now() + timeout;
  for (;;) {
    changed_.clear();
    if (interruption() != 0) {
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

void Robot::beginRequest() {
  showWarnings();
  refusals_before_ = client_->statistics().refusals;
}

bool Robot::waitUnlessRefused(const std::function<bool(const Received&)>& done, nanoseconds timeout) {
  const bool in_time = waitUntil(
      [&](const Received& received) { return client_->statistics().refusals > refusals_before_ || done(received); },
      timeout);
  if (client_->statistics().refusals > refusals_before_) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::string why = warnings_.empty() ? "the robot refused" : warnings_.back();
    warnings_.clear();
    throw CommandException(why);
  }
  return in_time;
}

RcServerClient::Callbacks Robot::callbacks() {
  RcServerClient::Callbacks callbacks;
  callbacks.on_status = [this](const ConnectionStatus& status) { noteStatus(status); };
  callbacks.on_picture = [this](const PicturePtr& picture) { notePicture(picture); };
  callbacks.on_telemetry = [this](const Telemetry& telemetry) { noteTelemetry(telemetry); };
  callbacks.on_joints_accepted = [this](const std::vector<JointTarget>& targets) {
    change([&] {
      for (const JointTarget& target : targets) {
        received_.accepted_joints[target.id] = target.position;
      }
    });
  };
  callbacks.on_ended = [this](const MotionEnd& end) { change([&] { keep(end, kMostEnds, &received_.ends); }); };
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
    received_.failures += status.state == ConnectionState::kDisconnected && status.fault != FaultKind::kNone ? 1 : 0;
    received_.status = status;
  });
}

void Robot::notePicture(const PicturePtr& picture) {
  change([&] {
    received_.pictures.push_back({picture, steady_clock::now()});
    if (received_.pictures.size() > kMostPictures) {
      received_.pictures.pop_front();
      ++received_.lost_pictures;
    }
  });
}

void Robot::noteTelemetry(const Telemetry& telemetry) {
  change([&] {
    for (const JointReading& joint : telemetry.joints) {
      received_.joints[joint.id] = joint;
    }
    for (const SensorReading& sensor : telemetry.sensors) {
      received_.sensors[sensor.id] = sensor.value;
    }
  });
}

// Why there is no connection is said by checkConnection(), and in the statistics of `watch`.
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
  throw NetworkException(
      (status.reason.empty() ? "there is no connection to the robot" : status.reason) + ". " + advice, status.fault);
}

void Robot::showWarnings() {
  std::deque<std::string> warnings;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    warnings.swap(warnings_);
  }
  for (const std::string& warning : warnings) {
    output_.note("aibo: " + warning);
  }
}

void Robot::waitForEvent(steady_clock::time_point deadline) {
  pollfd polled[] = {{changed_.descriptor(), POLLIN, 0}, {interruptionDescriptor(), POLLIN, 0}};
  const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
  ::poll(polled, 2, static_cast<int>(std::clamp(left, milliseconds(0), milliseconds(60000)).count()));
}

}  // namespace aibo_driver::command_line
