/// @file order_events.h
/// What happens in the soak. All times are in seconds since the epoch, by the system clock, which all
/// processes of a computer and the stamps of ROS share.
#ifndef TEST_SOAK_ORDER_EVENTS_H
#define TEST_SOAK_ORDER_EVENTS_H

#include <map>
#include <string>
#include <vector>

namespace soak {

using Targets = std::map<std::string, double>;  ///< rad, by joint

/// A message of a user that moves joints.
struct Order {
  std::string user;  ///< the node
  std::string kind;  ///< command or trajectory
  double time = 0;   ///< when it was published
  double duration = 0;
  Targets targets{};
};

constexpr const char* kNoAnswer = "no answer came";

/// A call of a service by a user.
struct Call {
  std::string user;
  std::string service;
  double begin = 0;
  double end = 0;
  bool success = false;
  std::string message{};  ///< or kNoAnswer
};

/// A joint's target on its way from the driver to the robot.
struct Sent {
  double time = 0;
  std::string joint;
  double target = 0;  ///< rad
};

/// Something that moves the robot, as motion_state names it.
struct Moving {
  std::string user;
  int kind = 0;  ///< as in aibo_driver/Movement
  std::string name;
  std::vector<std::string> joints{};
};

/// A movement that has ended.
struct Ended {
  double time = 0;  ///< when it was said
  Moving movement;
  int how = 0;  ///< as in aibo_driver/EndedMovement
  std::string reason{};
};

/// Where the joints are.
struct Measured {
  double time = 0;  ///< by the stamp
  Targets positions{};
};

/// Something is wrong from begin to end.
struct Fault {
  enum class Kind { kDriverFrozen, kRobotFrozen, kLinkCut, kLinkSlow, kStickSlow };
  Kind kind = Kind::kLinkCut;
  double begin = 0;
  double end = 0;
};

/// All that happened in one round, each in the order of time.
struct Round {
  std::vector<Order> orders{};
  std::vector<Call> calls{};
  std::vector<Sent> sent{};
  std::vector<Ended> ended{};
  std::vector<Moving> moving{};  ///< at its end
  std::vector<Measured> measured{};
  std::vector<Fault> faults{};
};

}  // namespace soak

#endif  // TEST_SOAK_ORDER_EVENTS_H
