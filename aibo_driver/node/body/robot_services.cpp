#include "node/body/robot_services.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/orders.h"
#include "node/service_answer.h"

namespace aibo_driver::node {
namespace {

using files::motionFileName;

std::vector<std::uint8_t> contentOf(const UploadMotion::Request& request) {
  if (request.file.empty() == request.data.empty()) {
    throw aibo_client::InvalidArgumentException(request.file.empty() ? "give a file or data"
                                                                     : "give a file or data, not both");
  }
  return request.file.empty() ? request.data : files::loadMotion(request.file);
}

void checkName(const std::string& name) {
  if (name.empty()) {
    throw aibo_client::InvalidArgumentException("give the name of a motion. list_motions lists them.");
  }
}

std::string nameOf(const UploadMotion::Request& request) {
  return motionFileName(request.name.empty() ? std::filesystem::path(request.file).filename().string() : request.name);
}

}  // namespace

void RobotServices::advertise(const ros::NodeHandle& stop_handle, const ros::NodeHandle& motion_handle,
                              const ros::NodeHandle& handle) {
  using movement::Order;
  ros::NodeHandle stop_services(stop_handle);
  servers_.push_back(advertiseOrder<std_srvs::Trigger>(
      stop_services, "stop",
      [this](const Order& order, const auto&, auto& response) { return stop(order, response); }));
  servers_.push_back(advertiseOrder<std_srvs::Trigger>(
      stop_services, "release",
      [this](const Order& order, const auto&, auto& response) { return release(order, response); }));
  servers_.push_back(advertiseOrder<std_srvs::SetBool>(stop_services, "motors",
                                                       [this](const Order& order, const auto& request, auto& response) {
                                                         return setMotors(order, request.data != 0, response);
                                                       }));
  ros::NodeHandle motion_services(motion_handle);
  servers_.push_back(advertiseOrder<PlayMotion>(motion_services, "play_motion",
                                                [this](const Order& order, const auto& request, auto& response) {
                                                  return playMotion(order, request, response);
                                                }));
  ros::NodeHandle services(handle);
  servers_.push_back(services.advertiseService("list_motions", &RobotServices::listMotions, this));
  servers_.push_back(services.advertiseService("upload_motion", &RobotServices::uploadMotion, this));
  servers_.push_back(services.advertiseService("delete_motion", &RobotServices::deleteMotion, this));
  servers_.push_back(services.advertiseService("shut_down", &RobotServices::shutDown, this));
  servers_.push_back(services.advertiseService("reboot", &RobotServices::reboot, this));
}

bool RobotServices::stop(const movement::Order& order, std_srvs::Trigger::Response& response) {
  return answer(response, "No order moves the robot any more, but it could not be told to stop", [&] {
    mover_.stop(order);
    return "The robot holds, and nothing moves it until release is called.";
  });
}

bool RobotServices::release(const movement::Order& order, std_srvs::Trigger::Response& response) {
  return answer(response, "The robot stays stopped", [&] {
    mover_.release(order);
    return "The robot may be moved again.";
  });
}

bool RobotServices::setMotors(const movement::Order& order, bool on, std_srvs::SetBool::Response& response) {
  return answer(response, "The motors were not switched", [&] {
    const bool is_on = mover_.setMotors(order, on);
    if (is_on != on) {
      throw aibo_client::CommandException(std::string("the robot says that they are still ") +
                                          (is_on ? "on." : "off."));
    }
    return is_on ? "The motors are on." : "The motors are off: the joints can be moved by hand.";
  });
}

bool RobotServices::playMotion(const movement::Order& order, const PlayMotion::Request& request,
                               PlayMotion::Response& response) {
  const std::string name = motionFileName(request.name);
  if (request.stop || request.repetitions == 0) {
    return answer(response, "Nothing was stopped", [&] {
      mover_.stopMotion(order, name);
      return (name.empty() ? "All motions" : name) + " stopped: the joints hold where they are.";
    });
  }
  std::string failure = "Nothing was played";
  answer(response, failure, [&] {
    checkName(name);
    const movement::Mover::Begun begun = mover_.play(order, name, request.repetitions);
    const movement::EndedMovement* const end = begun.ended();
    if (end != nullptr && end->how != aibo_client::EndedHow::kDone && end->how != aibo_client::EndedHow::kUnknown) {
      throw aibo_client::CommandException(end->reason + ".");
    }
    if (begun.is_uncertain) {
      failure = name + " may or may not play";
      throw aibo_client::TimeoutException(begun.remark + ". motion_state says when it is known.");
    }
    return name + " has begun and plays " +
           (request.repetitions == 1 ? "once" : std::to_string(request.repetitions) + " times") +
           (begun.remark.empty() ? "." : ": " + begun.remark + ".");
  });
  return true;
}

bool RobotServices::listMotions(ListMotions::Request&, ListMotions::Response& response) {
  return answer(response, "The motions could not be listed", [&] {
    response.names = client_.listMotions(kFileTimeout);
    return "Motions on the robot: " + std::to_string(response.names.size()) + ".";
  });
}

bool RobotServices::uploadMotion(UploadMotion::Request& request, UploadMotion::Response& response) {
  return answer(response, "Nothing was uploaded", [&] {
    const std::vector<std::uint8_t> content = contentOf(request);
    const std::string name = nameOf(request);
    client_.uploadMotion(name, content, kUploadTimeout);
    return name + " is on the robot, " + std::to_string(content.size()) + " bytes.";
  });
}

bool RobotServices::deleteMotion(DeleteMotion::Request& request, DeleteMotion::Response& response) {
  return answer(response, "Nothing was deleted", [&] {
    const std::string name = motionFileName(request.name);
    checkName(name);
    client_.deleteMotion(name, kFileTimeout);
    return name + " was deleted from the robot.";
  });
}

bool RobotServices::shutDown(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return answer(response, "The robot does not shut down", [this] {
    client_.shutDownRobot(kPowerTimeout);
    return "The robot shuts down. The driver connects again when it is switched on.";
  });
}

bool RobotServices::reboot(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return answer(response, "The robot does not reboot", [this] {
    client_.rebootRobot(kPowerTimeout);
    return "The robot reboots. The driver connects again as soon as it answers.";
  });
}

}  // namespace aibo_driver::node
