/// @file joint_targets.h
#ifndef AIBO_DRIVER_MOVEMENT_JOINT_TARGETS_H
#define AIBO_DRIVER_MOVEMENT_JOINT_TARGETS_H

#include <chrono>
#include <map>
#include <string>

#include "aibo_client/parts.h"
#include "aibo_client/rcserver_client.h"

namespace aibo_driver::movement {

/// Targets with speeds, by RCServer identifier.
using JointTargets = std::map<int, aibo_client::JointTarget>;

/// Call this before a command is sent. To a robot of another design, the numbers in the command mean other joints and
/// LEDs. A version 1 server does not report the design of its robot, so everything passes. Any thread may call it.
/// @param design the design that the commands are made for, such as "ERS-7"
/// @throw CommandException the connected robot reports another design
void requireDesign(const aibo_client::RcServerClient& client, const std::string& design);

/// Sends targets to a robot of this design, all in one request. It sends nothing if there are no targets.
/// @param duration, terms see RcServerClient::commandJoints()
/// @throw the exceptions of requireDesign() and RcServerClient::commandJoints()
void sendTargets(aibo_client::RcServerClient& client, const std::string& design, const JointTargets& targets,
                 std::chrono::milliseconds duration = {}, const aibo_client::OrderTerms& terms = {});

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_JOINT_TARGETS_H
