// Makes the robot walk after a pink ball, like the one that came with it, and around the ball. It steers by the colours
// that the robot's camera detects. The ball's place in the picture gives its direction, and its size gives its
// distance. When somebody stops or lifts the robot, or makes it take a posture, the node needs permission to go on
// (leave_to_move.h).

#include <aibo_driver/Connection.h>
#include <aibo_driver/MotionState.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "node/node.h"
#include "text/plain_text.h"
#include "tools/ball/ball_finder.h"
#include "tools/leave_to_move.h"

namespace {

using aibo_driver::Connection;
using aibo_driver::Movement;
using aibo_driver::RobotState;
using aibo_driver::ball::Ball;

constexpr double kClose = 0.45;  // m; when it is closer, it walks around the ball

class FollowBall {
 public:
  FollowBall(ros::NodeHandle handle, const ros::NodeHandle& parameters) : leave_(handle, parameters, whyItCannotWalk) {
    publisher_ = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    motion_ = handle.subscribe("motion_state", 1, &FollowBall::receiveMotion, this);
    connection_ = handle.subscribe("connection", 10, &FollowBall::receiveConnection, this);
    mask_ = handle.subscribe("color_mask", 1, &FollowBall::receive, this);
  }

 private:
  static std::string whyItCannotWalk(const RobotState& state) {
    return state.motors == RobotState::OFF        ? "the motors are off"
           : state.posture == RobotState::FALLEN  ? "the robot has fallen"
           : state.posture == RobotState::CARRIED ? "the robot is carried"
                                                  : "";
  }

  void receiveMotion(const aibo_driver::MotionState::ConstPtr& state) {
    const auto posture = std::find_if(state->movements.begin(), state->movements.end(),
                                      [](const Movement& movement) { return movement.kind == Movement::POSTURE; });
    takes_posture_ = posture != state->movements.end();
    if (takes_posture_) {
      leave_.overrule(aibo_driver::text::plainLine(posture->source + " has called " + posture->name));
    }
  }

  // After a new connection the driver ignores velocities until their sender has sent 0.
  void receiveConnection(const Connection::ConstPtr& connection) {
    const bool was_connected = std::exchange(is_connected_, connection->state == Connection::CONNECTED);
    if (is_connected_ && !was_connected) {
      publisher_.publish(geometry_msgs::Twist());
    }
  }

  // Without images there are no commands, and then the driver stops the robot.
  void receive(const sensor_msgs::Image::ConstPtr& mask) {
    if (!takes_posture_ && leave_.has()) {
      const std::optional<Ball> ball = aibo_driver::ball::findBall(*mask);
      publisher_.publish(ball ? towards(*ball) : searching());
    }
  }

  geometry_msgs::Twist towards(const Ball& ball) {
    last_seen_on_ = ball.left < 0 ? -1 : 1;
    geometry_msgs::Twist twist;
    twist.linear.x = std::clamp(0.6 * (ball.distance - kClose), -0.05, 0.12);
    twist.linear.y = ball.distance < kClose + 0.1 ? -0.04 : 0;
    twist.angular.z = std::clamp(1.4 * ball.left, -0.6, 0.6);
    return twist;
  }

  geometry_msgs::Twist searching() const {
    geometry_msgs::Twist twist;
    twist.angular.z = 0.4 * last_seen_on_;
    return twist;
  }

  aibo_driver::tools::LeaveToMove leave_;
  ros::Publisher publisher_;
  ros::Subscriber motion_;
  ros::Subscriber connection_;
  ros::Subscriber mask_;
  bool takes_posture_ = false;
  bool is_connected_ = true;
  int last_seen_on_ = 1;  // -1 means on the right
};

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_follow_ball");
  const FollowBall follow_ball(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"), ros::NodeHandle("~"));
  ros::spin();
}
