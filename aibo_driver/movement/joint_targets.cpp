#include "movement/joint_targets.h"

#include <vector>

#include "aibo_client/exceptions.h"

namespace aibo_driver::movement {

void requireDesign(const aibo_client::RcServerClient& client, const std::string& design) {
  const std::string said = client.robotDesign();
  if (!said.empty() && said != design) {
    throw aibo_client::CommandException("the robot says that it is an " + said +
                                        ", but the driver's parameter robot is " + design +
                                        ": start the driver with the right one.");
  }
}

void sendTargets(aibo_client::RcServerClient& client, const std::string& design, const JointTargets& targets,
                 std::chrono::milliseconds duration, const aibo_client::OrderTerms& terms) {
  if (targets.empty()) {
    return;
  }
  requireDesign(client, design);
  std::vector<aibo_client::JointTarget> list;
  for (const auto& [id, target] : targets) {
    list.push_back(target);
  }
  client.commandJoints(list, duration, terms);
}

}  // namespace aibo_driver::movement
