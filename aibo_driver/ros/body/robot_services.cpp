#include "ros/body/robot_services.h"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>

#include "aibo_driver/exceptions.h"
#include "files/files.h"
#include "ros/service_answer.h"

namespace aibo_driver::node {
namespace {

using files::motionFileName;

/// While it lives, and until the callbacks that are in a queue when it ends have run, nothing new moves the robot.
class Interruption {
 public:
  /// @param queue may be null: no callback is older
  Interruption(JointMover& mover, ros::CallbackQueueInterface* queue) : mover_(mover), queue_(queue) { mover_.block(); }

  ~Interruption() {
    if (queue_ == nullptr) {
      mover_.unblock();
    } else {
      queue_->addCallback(boost::make_shared<End>(mover_));
    }
  }

  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

 private:
  class End : public ros::CallbackInterface {
   public:
    explicit End(JointMover& mover) : mover_(mover) {}
    CallResult call() override {
      mover_.unblock();
      return Success;
    }

   private:
    JointMover& mover_;
  };

  JointMover& mover_;
  ros::CallbackQueueInterface* const queue_;
};

std::vector<std::uint8_t> contentOf(const UploadMotion::Request& request) {
  if (request.file.empty() == request.data.empty()) {
    throw InvalidArgumentException(request.file.empty() ? "give a file or data" : "give a file or data, not both");
  }
  return request.file.empty() ? request.data : files::loadMotion(request.file);
}

void checkName(const std::string& name) {
  if (name.empty()) {
    throw InvalidArgumentException("give the name of a motion. list_motions lists them.");
  }
}

std::string nameOf(const UploadMotion::Request& request) {
  return motionFileName(request.name.empty() ? std::filesystem::path(request.file).filename().string() : request.name);
}

}  // namespace

void RobotServices::advertise(const ros::NodeHandle& stop_handle, const ros::NodeHandle& joint_handle,
                              const ros::NodeHandle& handle) {
  joint_queue_ = joint_handle.getCallbackQueue();
  ros::NodeHandle stop_services(stop_handle);
  servers_.push_back(stop_services.advertiseService("stop", &RobotServices::stop, this));
  servers_.push_back(stop_services.advertiseService("motors", &RobotServices::setMotors, this));
  ros::NodeHandle joint_services(joint_handle);
  servers_.push_back(joint_services.advertiseService("play_motion", &RobotServices::playMotion, this));
  ros::NodeHandle services(handle);
  servers_.push_back(services.advertiseService("list_motions", &RobotServices::listMotions, this));
  servers_.push_back(services.advertiseService("upload_motion", &RobotServices::uploadMotion, this));
  servers_.push_back(services.advertiseService("delete_motion", &RobotServices::deleteMotion, this));
  servers_.push_back(services.advertiseService("shut_down", &RobotServices::shutDown, this));
  servers_.push_back(services.advertiseService("reboot", &RobotServices::reboot, this));
}

bool RobotServices::stop(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return answer(response, "The robot could not be told to stop", [&] {
    const Interruption interruption(mover_, joint_queue_);
    mover_.hold("stop was called");
    return "The robot holds: nothing moves it any more.";
  });
}

bool RobotServices::setMotors(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  return answer(response, "The motors were not switched", [&] {
    const bool wanted = request.data != 0;
    const Interruption interruption(mover_, joint_queue_);
    mover_.prepareForMotors();
    const bool on = client_.setMotors(wanted, kMotionTimeout);
    if (on != wanted) {
      throw CommandException(std::string("the robot says that they are still ") + (on ? "on." : "off."));
    }
    return on ? "The motors are on." : "The motors are off: the joints can be moved by hand.";
  });
}

bool RobotServices::playMotion(PlayMotion::Request& request, PlayMotion::Response& response) {
  const std::string name = motionFileName(request.name);
  if (request.stop) {
    return answer(response, "Nothing was stopped", [&] {
      client_.stopMotion(name, kMotionTimeout);
      return (name.empty() ? "All motions" : name) + " stopped: the joints hold where they are.";
    });
  }
  return answer(response, "Nothing was played", [&] {
    checkName(name);
    const int repetitions = std::max<int>(1, request.repetitions);
    std::string changes;
    mover_.play(name, repetitions, kMotionTimeout, &changes);
    return name + " has begun and plays " + (repetitions == 1 ? "once" : std::to_string(repetitions) + " times") +
           (changes.empty() ? "." : ": " + changes + ".");
  });
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
