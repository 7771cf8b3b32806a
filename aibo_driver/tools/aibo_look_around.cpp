// Makes the robot look to the left, to the right and ahead, again and again. Each glance is one joint_trajectory. It
// waits while anything else moves the robot, except for walking, which moves only the legs. When somebody has pointed
// the head, it leaves the head there for a while. After a stop it needs permission to go on (leave_to_move.h).

#include <aibo_driver/MotionState.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "node/node.h"
#include "tools/leave_to_move.h"

namespace {

// Where the head turns, and how long that takes. Then it looks for a second. Left and up are positive.
struct Glance {
  double way;   // s
  double pan;   // rad
  double tilt;  // rad
};

constexpr double kRest = 1.0;    // s, between two glances, and after anything else has moved the robot
constexpr double kPause = 30.0;  // s, after somebody has pointed the head

bool pointsHead(const aibo_driver::Movement& movement) {
  const auto is_of_head = [](const std::string& joint) { return joint.rfind("head", 0) == 0 || joint == "neck_tilt"; };
  return std::any_of(movement.joints.begin(), movement.joints.end(), is_of_head);
}

// The head speeds up and slows down gently for each glance, at 0.7 rad/s at most.
const std::vector<Glance> kGlances{{2.5, 0.7, 0.1}, {3.5, -0.7, 0.3}, {2.5, 0.0, 0.0}};

class LookAround {
 public:
  LookAround(ros::NodeHandle handle, const ros::NodeHandle& parameters)
      : leave_(handle, parameters), pause_(aibo_driver::node::readNumber(parameters, "pause", kPause, 3600)) {
    publisher_ = handle.advertise<trajectory_msgs::JointTrajectory>("joint_trajectory", 1);
    joints_ = handle.subscribe("joint_states", 1, &LookAround::receiveJoints, this);
    motion_ = handle.subscribe("motion_state", 10, &LookAround::receiveMotion, this);
  }

 private:
  void receiveMotion(const aibo_driver::MotionState::ConstPtr& state) {
    is_free_ = true;
    for (const aibo_driver::Movement& movement : state->movements) {
      if (movement.source != ros::this_node::getName() && movement.kind != aibo_driver::Movement::WALK) {
        is_free_ = false;
        const ros::WallDuration rest(pointsHead(movement) ? pause_ : kRest);
        next_glance_ = std::max(next_glance_, ros::SteadyTime::now() + rest);
      }
    }
  }

  // Measured joints show that there is a robot that can look around.
  void receiveJoints(const sensor_msgs::JointState::ConstPtr&) {
    const ros::SteadyTime now = ros::SteadyTime::now();
    const bool is_limp = leave_.state().motors == aibo_driver::RobotState::OFF;
    if (is_free_ && !is_limp && now >= next_glance_ && leave_.has()) {
      const Glance& glance = kGlances[glance_++ % kGlances.size()];
      publisher_.publish(wayTo(glance));
      next_glance_ = now + ros::WallDuration(glance.way + kRest);
    }
  }

  static trajectory_msgs::JointTrajectory wayTo(const Glance& glance) {
    trajectory_msgs::JointTrajectory trajectory;
    trajectory.joint_names = {"head_pan", "head_tilt"};
    trajectory.points.resize(1);
    trajectory.points[0].time_from_start = ros::Duration(glance.way);
    trajectory.points[0].positions = {glance.pan, glance.tilt};
    trajectory.points[0].velocities = {0, 0};
    return trajectory;
  }

  aibo_driver::tools::LeaveToMove leave_;
  const double pause_;  // s
  ros::Publisher publisher_;
  ros::Subscriber joints_;
  ros::Subscriber motion_;
  bool is_free_ = false;  // known from the driver's first message on
  std::size_t glance_ = 0;
  ros::SteadyTime next_glance_;
};

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_look_around");
  return aibo_driver::node::runNode("node aibo_look_around", [] {
    return std::make_shared<LookAround>(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"),
                                        ros::NodeHandle("~"));
  });
}
