#include "node/orders.h"

namespace aibo_driver::node {

movement::Order orderOfGoal(const std::string& goal_id) {
  const std::size_t time = goal_id.rfind('-');
  const std::size_t number = time == std::string::npos || time == 0 ? time : goal_id.rfind('-', time - 1);
  return {text::plainLine(goal_id.substr(0, number)), receivedAt()};
}

}  // namespace aibo_driver::node
