#include "power_services.h"

#include <string>

#include "aibo_driver/exceptions.h"

namespace aibo_driver {

PowerServices::PowerServices(const ros::NodeHandle& handle, RcServerClient& client) : client_(client) {
  ros::NodeHandle services(handle);
  shut_down_server_ = services.advertiseService("shut_down", &PowerServices::shutDown, this);
  reboot_server_ = services.advertiseService("reboot", &PowerServices::reboot, this);
}

bool PowerServices::shutDown(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  try {
    client_.shutDownRobot(kTimeout);
    response.message = "The robot shuts down. The driver connects again when it is switched on.";
    response.success = true;
  } catch (const Exception& error) {
    response.message = std::string("The robot does not shut down: ") + error.what();
  }
  return true;
}

bool PowerServices::reboot(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  try {
    client_.rebootRobot(kTimeout);
    response.message = "The robot starts anew. The driver connects again as soon as it answers.";
    response.success = true;
  } catch (const Exception& error) {
    response.message = std::string("The robot does not start anew: ") + error.what();
  }
  return true;
}

}  // namespace aibo_driver
