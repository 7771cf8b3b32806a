#include "ros/body/motor_service.h"

#include <string>
#include <utility>

#include "aibo_driver/exceptions.h"
#include "ros/service_answer.h"

namespace aibo_driver::node {

MotorService::MotorService(const ros::NodeHandle& handle, RcServerClient& client, std::function<void()> switching)
    : client_(client),
      switching_(std::move(switching)),
      server_(ros::NodeHandle(handle).advertiseService("motors", &MotorService::setMotors, this)) {}

bool MotorService::setMotors(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  return answerService(response, "The motors were not switched", [&] {
    const bool wanted = request.data != 0;
    switching_();
    const bool on = client_.setMotors(wanted, kTimeout);
    if (on != wanted) {
      throw CommandException(std::string("the robot says that they are ") + (on ? "on" : "off") + " all the same.");
    }
    return on ? "The motors are on." : "The motors are off: the joints can be moved by hand.";
  });
}

}  // namespace aibo_driver::node
