#include "ros/body/power_services.h"

#include "ros/service_answer.h"

namespace aibo_driver::node {

PowerServices::PowerServices(const ros::NodeHandle& handle, RcServerClient& client) : client_(client) {
  ros::NodeHandle services(handle);
  shut_down_server_ = services.advertiseService("shut_down", &PowerServices::shutDown, this);
  reboot_server_ = services.advertiseService("reboot", &PowerServices::reboot, this);
}

bool PowerServices::shutDown(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return answerService(response, "The robot does not shut down", [this] {
    client_.shutDownRobot(kTimeout);
    return "The robot shuts down. The driver connects again when it is switched on.";
  });
}

bool PowerServices::reboot(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return answerService(response, "The robot does not start anew", [this] {
    client_.rebootRobot(kTimeout);
    return "The robot starts anew. The driver connects again as soon as it answers.";
  });
}

}  // namespace aibo_driver::node
