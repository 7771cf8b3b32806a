/// @file robot_info.h
#ifndef AIBO_DRIVER_ROBOT_INFO_H
#define AIBO_DRIVER_ROBOT_INFO_H

#include <algorithm>
#include <string>
#include <vector>

#include "aibo_driver/joints.h"
#include "aibo_driver/walk.h"

namespace aibo_driver {

/// How a version 2 server introduces itself. Empty for a version 1 server, which does not.
struct RobotInfo {
  std::string design;                     ///< of the robot, as OPEN-R names it: "ERS-7"
  std::string server;                     ///< name and version of the server
  std::vector<std::string> capabilities;  ///< letters of the requests that it serves: "F", "J", "O"...
  std::vector<JointLimits> joint_limits;  ///< of each joint
  WalkLimits walk_limits;

  /// @param word the letter of a request
  bool hasCapability(const std::string& word) const {
    return std::find(capabilities.begin(), capabilities.end(), word) != capabilities.end();
  }
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_ROBOT_INFO_H
