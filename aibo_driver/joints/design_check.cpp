#include "joints/design_check.h"

#include "aibo_driver/exceptions.h"

namespace aibo_driver::joints {

void requireDesign(const RcServerClient& client, const std::string& design) {
  const std::string said = client.status().robot.design;
  if (!design.empty() && !said.empty() && said != design) {
    throw CommandException("the robot says that it is an " + said + ", but the driver's parameter robot is " + design +
                           ": start the driver with the right one.");
  }
}

}  // namespace aibo_driver::joints
