// Lets the robot look to the left, to the right and ahead, again and again. Each round is one joint_trajectory.

#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <vector>

#include "ros/node.h"

namespace {

// Where the head rests at a time. Left and up are positive.
struct Glance {
  double time;  // s
  double pan;   // rad
  double tilt;  // rad
};

// The head eases out of each glance and into the next one, at 0.7 rad/s at most.
const std::vector<Glance> kRound{{2.5, 0.7, 0.1},  {3.5, 0.7, 0.1},  {7.0, -0.7, 0.3},
                                 {8.0, -0.7, 0.3}, {10.5, 0.0, 0.0}, {11.5, 0.0, 0.0}};

class LookAround {
 public:
  explicit LookAround(ros::NodeHandle handle) {
    publisher_ = handle.advertise<trajectory_msgs::JointTrajectory>("joint_trajectory", 1);
    subscriber_ = handle.subscribe("joint_states", 1, &LookAround::receive, this);
  }

 private:
  // Measured joints show that there is a robot that can look around.
  void receive(const sensor_msgs::JointState::ConstPtr&) {
    const ros::SteadyTime now = ros::SteadyTime::now();
    if (now >= next_round_) {
      publisher_.publish(round());
      next_round_ = now + ros::WallDuration(kRound.back().time);
    }
  }

  static trajectory_msgs::JointTrajectory round() {
    trajectory_msgs::JointTrajectory trajectory;
    trajectory.joint_names = {"head_pan", "head_tilt"};
    for (const Glance& glance : kRound) {
      trajectory_msgs::JointTrajectoryPoint point;
      point.time_from_start = ros::Duration(glance.time);
      point.positions = {glance.pan, glance.tilt};
      point.velocities = {0, 0};
      trajectory.points.push_back(point);
    }
    return trajectory;
  }

  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  ros::SteadyTime next_round_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_look_around");
  const LookAround look_around(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"));
  ros::spin();
}
