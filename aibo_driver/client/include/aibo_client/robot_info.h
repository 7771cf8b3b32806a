/// @file robot_info.h
#ifndef AIBO_CLIENT_ROBOT_INFO_H
#define AIBO_CLIENT_ROBOT_INFO_H

#include <algorithm>
#include <string>
#include <vector>

#include "aibo_client/joints.h"
#include "aibo_client/walk.h"

namespace aibo_client {

/// How a version 2 server introduces itself. It is empty for a version 1 server, which does not introduce itself.
struct RobotInfo {
  std::string design;                     ///< the robot's design, as OPEN-R names it: "ERS-7"
  std::string server;                     ///< the name and version of the server
  std::vector<std::string> capabilities;  ///< the letters of the requests that it serves: "F", "J", "O"...
  std::vector<JointLimits> joint_limits;  ///< the limits of each joint
  WalkLimits walk_limits;

  /// @param word the letter of a request
  bool hasCapability(const std::string& word) const {
    return std::find(capabilities.begin(), capabilities.end(), word) != capabilities.end();
  }
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_ROBOT_INFO_H
