#include "client/value_poll.h"

#include <algorithm>
#include <iterator>

#include "protocol/version1.h"
#include "robot_model/robot_model.h"

namespace aibo_client {
namespace {

template <typename Part>
std::vector<int> identifiersOf(const Part* parts, int count) {
  std::vector<int> ids;
  std::transform(parts, parts + count, std::back_inserter(ids), [](const Part& part) { return part.identifier; });
  return ids;
}

}  // namespace

ValuePoll::ValuePoll(TimePoint now) : due_at_(now) {
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  groups_[0] = {protocol::REQUEST_JOINT, identifiersOf(model.joints, model.number_of_joints), 0};
  groups_[1] = {protocol::REQUEST_SENSOR, identifiersOf(model.sensors, model.number_of_sensors), 0};
}

bool ValuePoll::empty() const {
  return groups_[0].ids.empty() && groups_[1].ids.empty();
}

ValuePoll::Value ValuePoll::take(TimePoint now) {
  due_at_ = now + kPeriod;
  if (groups_[turn_].ids.empty()) {
    turn_ = 1 - turn_;
  }
  Group& group = groups_[turn_];
  turn_ = 1 - turn_;
  group.next %= group.ids.size();
  return {group.request, group.ids[group.next++]};
}

void ValuePoll::drop(const Value& value) {
  Group& group = groupOf(value.request);
  const auto place = std::find(group.ids.begin(), group.ids.end(), value.id);
  if (place == group.ids.end()) {
    return;
  }
  if (static_cast<std::size_t>(place - group.ids.begin()) < group.next) {
    --group.next;  // the next value moves up, too
  }
  group.ids.erase(place);
}

void ValuePoll::dropAll(char request) {
  groupOf(request).ids.clear();
}

ValuePoll::Group& ValuePoll::groupOf(char request) {
  return groups_[request == protocol::REQUEST_JOINT ? 0 : 1];
}

}  // namespace aibo_client
