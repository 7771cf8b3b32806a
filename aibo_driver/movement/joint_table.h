/// @file joint_table.h
#ifndef AIBO_DRIVER_MOVEMENT_JOINT_TABLE_H
#define AIBO_DRIVER_MOVEMENT_JOINT_TABLE_H

#include <atomic>
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/parts.h"
#include "aibo_client/rcserver_client.h"

namespace aibo_driver::movement {

/// The speed limit of commanded joints in rad/s, unless the user sets another one.
constexpr double kUsualSpeedLimit = 3.0;

/// A speed limit in rad/s that is above the speed of any joint, so that each joint's own highest speed counts.
constexpr double kNoSpeedLimit = 20.0;

/// The properties of a joint.
struct JointProperties {
  std::string name;
  int id = 0;                ///< RCServer identifier
  double lowest = 0;         ///< rad
  double highest = 0;        ///< rad
  double highest_speed = 0;  ///< rad/s; JointTable::speedLimit() has the limit in force
  double own_speed = 0;      ///< rad/s, the highest speed that the joint itself can reach
  bool is_of_leg = false;
};

inline bool isOfLeg(const JointProperties& joint) {
  return joint.is_of_leg;
}

/// The joints of a robot, as aibo_rcserver/robot_model lists them.
class JointTable {
 public:
  /// A joint that is slower than a limit by itself keeps its own highest speed.
  /// @param design the robot's name in OPEN-R: "ERS-7" or "ERS-210"
  /// @param speed_limit rad/s, for every joint that is commanded
  /// @param motion_speed_limit rad/s, for every joint while a motion file is played
  /// @throw InvalidArgumentException there is no table for this design
  JointTable(const std::string& design, double speed_limit, double motion_speed_limit = kNoSpeedLimit);

  const std::string& design() const { return design_; }
  const std::vector<JointProperties>& joints() const { return joints_; }
  std::size_t size() const { return joints_.size(); }
  const JointProperties& operator[](std::size_t index) const { return joints_[index]; }

  /// The speed limit in force, in rad/s. Any thread may call this function.
  double speedLimit(std::size_t index) const { return joints_[index].highest_speed * speed_scale_; }

  /// What `select` returns for each joint for which a condition holds.
  template <typename Condition, typename Select>
  auto collect(const Condition& condition, const Select& select) const {
    std::vector<decltype(select(joints_.front()))> selected;
    for (const JointProperties& joint : joints_) {
      if (condition(joint)) {
        selected.push_back(select(joint));
      }
    }
    return selected;
  }

  /// The names of the joints for which a condition holds.
  template <typename Condition>
  std::vector<std::string> namesOf(const Condition& condition) const {
    return collect(condition, [](const JointProperties& joint) { return joint.name; });
  }

  /// The speed limits of all joints while a motion file is played. Any thread may call it.
  std::vector<aibo_client::JointSpeedLimit> motionSpeedLimits() const;

  /// How fast the joints of the legs can move without speed limits.
  std::vector<aibo_client::JointSpeedLimit> ownSpeedsOfLegs() const;

  /// Scales the speed limits of all joints. Any thread may call it.
  /// @param scale above 0, at most 1; initially 1
  void setSpeedScale(double scale) { speed_scale_ = scale; }

  std::optional<std::size_t> findByName(const std::string& name) const;
  std::optional<std::size_t> findById(int id) const;

 private:
  std::string design_;
  std::vector<JointProperties> joints_;
  double motion_speed_limit_;
  std::atomic<double> speed_scale_{1.0};
};

/// Targets with speeds, by the joints' RCServer identifiers.
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

#endif  // AIBO_DRIVER_MOVEMENT_JOINT_TABLE_H
