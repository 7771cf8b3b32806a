#include "client/value_poll.h"

#include <algorithm>

#include "protocol/version1.h"
#include "robot_model/robot_model.h"

namespace aibo_client {

ValuePoll::ValuePoll(TimePoint now) : due_at_(now) {
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

ValuePoll::Value ValuePoll::take(TimePoint now) {
  due_at_ = now + kPeriod;
  const Value value = values_.front();
  values_.pop_front();
  values_.push_back(value);
  return value;
}

void ValuePoll::drop(const Value& value) {
  dropIf([&value](const Value& each) { return each.request == value.request && each.id == value.id; });
}

void ValuePoll::dropAll(char request) {
  dropIf([request](const Value& each) { return each.request == request; });
}

template <typename Condition>
void ValuePoll::dropIf(const Condition& condition) {
  values_.erase(std::remove_if(values_.begin(), values_.end(), condition), values_.end());
}

}  // namespace aibo_client
