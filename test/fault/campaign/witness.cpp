#include "campaign/witness.h"

#include <utility>

using aibo_client::ConnectionState;
using aibo_client::ConnectionStatus;
using aibo_client::LogLevel;
using aibo_client::Picture;
using aibo_client::PicturePtr;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace fault_bench {
namespace {

constexpr milliseconds kHeldUp{100};
// One for the end of the connection, one because nobody answers, and one if the first to answer turns the client away.
constexpr int kMostWarnings = 3;

}  // namespace

aibo_client::Callbacks Witness::callbacks() {
  aibo_client::Callbacks callbacks;
  callbacks.on_picture = [this](const PicturePtr& picture) { see(*picture); };
  callbacks.on_status = [this](const ConnectionStatus& status) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (std::exchange(state_, status.state) != status.state) {
      state_since_ = steady_clock::now();
      judgeEnd(status);
      changed_.notify_all();
    }
  };
  callbacks.log = [this](LogLevel level, const std::string& line) { hear(level, line); };
  return callbacks;
}

void Witness::judgeEnd(const ConnectionStatus& status) {
  if (status.state != ConnectionState::kDisconnected) {
    return;
  }
  if (status.reason.empty() || status.advice.empty()) {
    complain("a connection has ended without a reason or advice: '" + status.reason + "', '" + status.advice + "'");
  }
  if (warnings_ == 0) {
    complain("the end of a connection was not logged: " + status.reason);
  }
}

void Witness::hear(LogLevel level, const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (level == LogLevel::kInfo) {
    warnings_ = line.rfind("Connected to ", 0) == 0 ? 0 : warnings_;
    return;
  }
  last_warning_ = line;
  if (line.rfind("No connection to the robot: ", 0) == 0 && ++warnings_ > kMostWarnings) {
    complain("a warning after " + std::to_string(kMostWarnings) + " others for the same interruption: " + line);
  }
}

void Witness::see(const Picture& picture) {
  const auto name = test_pictures::nameOf(picture.jpeg);
  const TimePoint sent = name ? server_.timeOf(name->number) : TimePoint();
  const auto spoilt = server_.lastSpoilt();
  const std::lock_guard<std::mutex> lock(mutex_);
  ++count_;
  if (picture.jpeg == spoilt.second) {
    spoilt_ = spoilt.first.number;
    return;  // the experiment that spoilt it judges it
  }
  if (!name) {
    complain("I2: a picture that the server never sent");
    return;
  }
  const Sighting sighting = {*name, steady_clock::now(), picture.first_byte_time, sent};
  judge(picture, sighting);
  last_ = sighting;
  changed_.notify_all();
}

void Witness::judge(const Picture& picture, const Sighting& sighting) {
  const std::string which = "picture " + std::to_string(sighting.name.number);
  if (picture.jpeg != test_pictures::makeNamed(sighting.name) || sighting.name.number > server_.lastNumber()) {
    complain("I2: " + which + " is not as it was sent");
  }
  if (sighting.name.number <= last_.name.number) {
    complain("I3: " + which + " after picture " + std::to_string(last_.name.number));
  }
  if (picture.first_byte_time < last_.arrival) {
    complain("I4: the time of " + which + " is before that of the one before");
  }
  // The client may be held up between looking at the clock and reading.
  if (picture.first_byte_time + kHeldUp < sighting.sent) {
    complain("M: I4: the time of " + which + " is before it was sent");
  }
  const bool same_connection = sighting.name.connection == last_.name.connection;
  const std::uint64_t spoilt = server_.lastSpoilt().first.number;
  const bool only_the_spoilt_one = spoilt == last_.name.number + 1 && sighting.name.number == spoilt + 1;
  if (same_connection && sighting.name.number > last_.name.number + 1 && !gaps_allowed_ && !only_the_spoilt_one) {
    complain("I5: lost over one connection: pictures " + std::to_string(last_.name.number + 1) + " to " +
             std::to_string(sighting.name.number - 1));
  }
}

void Witness::allowGaps(bool allowed) {
  const std::lock_guard<std::mutex> lock(mutex_);
  gaps_allowed_ = allowed;
}

Witness::Sighting Witness::last() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_;
}

std::uint64_t Witness::count() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return count_;
}

std::optional<Witness::Sighting> Witness::waitFor(const std::function<bool(const Sighting&)>& condition,
                                                  milliseconds timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!changed_.wait_for(lock, timeout, [&] { return last_.name.number > 0 && condition(last_); })) {
    return std::nullopt;
  }
  return last_;
}

std::optional<TimePoint> Witness::waitForState(ConnectionState state, milliseconds timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!changed_.wait_for(lock, timeout, [&] { return state_ == state; })) {
    return std::nullopt;
  }
  return state_since_;
}

std::string Witness::lastWarning() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_warning_;
}

bool Witness::hasSeenSpoilt() const {
  const std::uint64_t number = server_.lastSpoilt().first.number;
  const std::lock_guard<std::mutex> lock(mutex_);
  return number > 0 && spoilt_ == number;
}

std::vector<std::string> Witness::takeViolations() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(violations_, {});
}

}  // namespace fault_bench
