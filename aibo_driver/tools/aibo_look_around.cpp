// Lets the robot look to the left, to the right and ahead, again and again. Each glance is one joint_trajectory. While
// anything else moves the robot, it waits. Walking is no reason to: that takes the legs alone. After a stop it needs
// leave to go on (leave_to_move.h).

#include <aibo_driver/MotionState.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ros/node.h"
#include "tools/leave_to_move.h"

namespace {

// Where the head turns, and how long that takes, with a second to look. Left and up are positive.
struct Glance {
  double way;   // s
  double pan;   // rad
  double tilt;  // rad
};

constexpr double kRest = 1.0;  // s

// The head eases out of each glance and into the next one, at 0.7 rad/s at most.
const std::vector<Glance> kGlances{{2.5, 0.7, 0.1}, {3.5, -0.7, 0.3}, {2.5, 0.0, 0.0}};

class LookAround {
 public:
  LookAround(ros::NodeHandle handle, const ros::NodeHandle& parameters) : leave_(handle, parameters) {
    publisher_ = handle.advertise<trajectory_msgs::JointTrajectory>("joint_trajectory", 1);
    joints_ = handle.subscribe("joint_states", 1, &LookAround::receiveJoints, this);
    motion_ = handle.subscribe("motion_state", 1, &LookAround::receiveMotion, this);
  }

 private:
  void receiveMotion(const aibo_driver::MotionState::ConstPtr& state) {
    const auto is_other = [](const aibo_driver::Movement& movement) {
      return movement.source != ros::this_node::getName() && movement.kind != aibo_driver::Movement::WALK;
    };
    is_free_ = std::none_of(state->movements.begin(), state->movements.end(), is_other);
    if (!is_free_) {
      next_glance_ = ros::SteadyTime::now() + ros::WallDuration(kRest);
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
  ros::Publisher publisher_;
  ros::Subscriber joints_;
  ros::Subscriber motion_;
  bool is_free_ = false;  // known from the driver's first message on
  std::size_t glance_ = 0;
  ros::SteadyTime next_glance_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_look_around");
  const LookAround look_around(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"), ros::NodeHandle("~"));
  ros::spin();
}
