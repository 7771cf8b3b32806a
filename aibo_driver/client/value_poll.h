/// @file value_poll.h
#ifndef AIBO_DRIVER_CLIENT_VALUE_POLL_H
#define AIBO_DRIVER_CLIENT_VALUE_POLL_H

#include <algorithm>
#include <chrono>
#include <deque>

#include "protocol/version1.h"
#include "robot_model/robot_model.h"

namespace aibo_client {

/// Decides when to ask a version 1 server for which joint or sensor. Such a server sends values only when asked, so the
/// client asks for them one by one.
class ValuePoll {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// The time between two requests. A request and its answer are six bytes in two packets. That makes 80 small packets
  /// a second, beside about 120 full packets for 30 pictures. On a wireless link of 11 Mbit/s a small packet takes
  /// about 0.75 ms, so the requests take 6 % of the link's time.
  static constexpr std::chrono::milliseconds kPeriod{25};
  /// Commands are sent before a request that is due, but they delay it for this long at most.
  static constexpr std::chrono::milliseconds kLongestWait{250};

  /// The value to ask for.
  struct Value {
    char request;  ///< the letter of the request
    int id;
  };

  /// Begins with all joints and sensors of an ERS-7. The joints of the ERS-210 have the same identifiers.
  explicit ValuePoll(TimePoint now) : due_at_(now) {
    const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
    for (int i = 0; i < std::max(model.number_of_joints, model.number_of_sensors); ++i) {
      if (i < model.number_of_joints) {
        values_.push_back({protocol::REQUEST_JOINT, model.joints[i].identifier});
      }
      if (i < model.number_of_sensors) {
        values_.push_back({protocol::REQUEST_SENSOR, model.sensors[i].identifier});
      }
    }
  }

  /// True if there is nothing to ask for.
  bool empty() const { return values_.empty(); }

  /// When to ask again, unless empty().
  TimePoint dueAt() const { return due_at_; }

  /// The value to ask for now. Joints and sensors take turns.
  Value take(TimePoint now) {
    due_at_ = now + kPeriod;
    std::rotate(values_.begin(), values_.begin() + 1, values_.end());
    return values_.back();
  }

  /// Does not ask any more for the values for which the condition is true.
  template <typename Condition>
  void dropIf(const Condition& condition) {
    values_.erase(std::remove_if(values_.begin(), values_.end(), condition), values_.end());
  }

 private:
  std::deque<Value> values_;  // the next one is first
  TimePoint due_at_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_VALUE_POLL_H
