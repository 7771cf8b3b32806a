#include "motor_service.h"

#include <string>
#include <utility>

#include "aibo_driver/exceptions.h"

namespace aibo_driver {

MotorService::MotorService(const ros::NodeHandle& handle, RcServerClient& client, std::function<void(bool)> switched)
    : client_(client),
      switched_(std::move(switched)),
      server_(ros::NodeHandle(handle).advertiseService("motors", &MotorService::setMotors, this)) {}

bool MotorService::setMotors(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  try {
    const bool on = client_.setMotors(request.data, kTimeout);
    switched_(on);
    response.success = on == static_cast<bool>(request.data);
    response.message = on ? "The motors are on." : "The motors are off: the joints can be moved by hand.";
  } catch (const Exception& error) {
    response.message = std::string("The motors were not switched: ") + error.what();
  }
  return true;
}

}  // namespace aibo_driver
