/// @file joint_commands.h
#ifndef AIBO_DRIVER_CLIENT_JOINT_COMMANDS_H
#define AIBO_DRIVER_CLIENT_JOINT_COMMANDS_H

#include <chrono>
#include <cstddef>
#include <deque>
#include <vector>

#include "aibo_driver/joints.h"

namespace aibo_driver {

/// @throw InvalidArgumentException naming what is wrong, if RcServerClient::commandJoints() does not take it
void checkJointTargets(const std::vector<JointTarget>& targets, std::chrono::milliseconds duration);

/// @throw InvalidArgumentException naming what is wrong, if RcServerClient::setJointSpeedLimits() does not take it
void checkJointSpeedLimits(const std::vector<JointSpeedLimit>& limits);

/// Joints that are told together where to go.
struct JointCommand {
  std::chrono::milliseconds duration{0};
  std::vector<JointTarget> targets;
};

/// What the joints have been told and has not been sent yet. Never grows without end: it holds each joint once, with
/// its latest target, which takes the place in the queue that an older one had. So no joint waits for ever, however
/// fast commands come.
class JointCommands {
 public:
  void add(const JointCommand& command);
  void add(const std::vector<JointSpeedLimit>& limits);

  /// Adds what came later.
  void append(const JointCommands& newer);

  bool hasSpeedLimits() const { return !speed_limits_.empty(); }
  bool hasTargets() const { return !commands_.empty(); }

  /// Takes the oldest speed limits, at most so many.
  std::vector<JointSpeedLimit> takeSpeedLimits(std::size_t most);

  /// Takes the oldest command. There has to be one.
  JointCommand takeCommand();

  /// Takes the target of one joint: of the one with the next higher id, or else with the lowest. There has to be one.
  JointTarget takeTargetAfter(int id);

 private:
  std::deque<JointCommand> commands_;  // none without targets
  std::vector<JointSpeedLimit> speed_limits_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_JOINT_COMMANDS_H
