#include "client/joint_poll.h"

#include <algorithm>

#include "robot_model/robot_model.h"

namespace aibo_driver {

JointPoll::JointPoll(TimePoint now) : due_at_(now) {
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  for (int i = 0; i < model.number_of_joints; ++i) {
    ids_.push_back(model.joints[i].identifier);
  }
}

int JointPoll::take(TimePoint now) {
  due_at_ = now + kPeriod;
  next_ %= ids_.size();
  return ids_[next_++];
}

void JointPoll::drop(int id) {
  ids_.erase(std::remove(ids_.begin(), ids_.end(), id), ids_.end());
}

}  // namespace aibo_driver
