// Follows a pink ball, like the one that came with the robot: it turns its head or, if ~walk is true, walks to it. The
// robot's camera detects the colour. The ball's place in the picture gives its direction, and its size its distance.
//
// When somebody stops the robot, or anything else moves it, the program ends. So no movement goes on by itself.

#include <aibo_driver/Connection.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "node/node.h"
#include "text/plain_text.h"
#include "tools/ball_finder.h"
#include "tools/program.h"

namespace {

using aibo_driver::Movement;
using aibo_driver::RobotState;
using aibo_driver::ball::Ball;
using aibo_driver::text::plainLine;
using geometry_msgs::PointStamped;
using geometry_msgs::Twist;

constexpr double kClose = 0.45;  // m; the robot walks around a ball that is closer

// While the ball is this near to the middle of the picture, the head stays where it is.
constexpr double kQuiet = 0.03;  // the tangent of the angle

class FollowBall {
 public:
  FollowBall(ros::NodeHandle handle, const ros::NodeHandle& parameters)
      : walks_(aibo_driver::node::readFlag(parameters, "walk")) {
    if (walks_) {
      velocities_ = handle.advertise<Twist>("cmd_vel", 1);
      connection_ = handle.subscribe("connection", 10, &FollowBall::receiveConnection, this);
    } else {
      points_ = handle.advertise<PointStamped>("look_at", 1);
      others_points_ = handle.subscribe("look_at", 10, &FollowBall::receivePoint, this);
    }
    motion_ = handle.subscribe("motion_state", 10, &FollowBall::receiveMotion, this);
    state_ = handle.subscribe("robot_state", 1, &FollowBall::receiveState, this);
    mask_ = handle.subscribe("color_mask", 1, &FollowBall::receiveMask, this);
  }

 private:
  void receiveState(const RobotState::ConstPtr& state) {
    if (state->stopped != 0) {
      end(plainLine(state->stopped_by) + " has stopped the robot");
    }
    state_problem_ = state->motors == RobotState::OFF                  ? "the motors are off"
                     : walks_ && state->posture == RobotState::FALLEN  ? "the robot has fallen"
                     : walks_ && state->posture == RobotState::CARRIED ? "the robot is carried"
                                                                       : "";
    endIf(state_problem_);
  }

  void receiveMotion(const aibo_driver::MotionState::ConstPtr& state) {
    const auto other = std::find_if(state->movements.begin(), state->movements.end(),
                                    [this](const Movement& movement) { return !isOurs(movement); });
    motion_problem_ = other != state->movements.end() ? plainLine(other->source) + " moves the robot" : "";
    endIf(motion_problem_);
  }

  // True for movements that this program causes: aibo_look_at moves the head for it. Walking leaves the head free.
  bool isOurs(const Movement& movement) const {
    return movement.source == ros::this_node::getName() ||
           (!walks_ && (movement.kind == Movement::LOOK_AT || movement.kind == Movement::WALK));
  }

  // Over a new connection, the driver refuses velocities until the program pauses them.
  void receiveConnection(const aibo_driver::Connection::ConstPtr& connection) {
    endIf(connection->state == aibo_driver::Connection::CONNECTED ? "" : "the connection was lost");
  }

  void receivePoint(const ros::MessageEvent<const PointStamped>& event) {
    if (event.getPublisherName() != ros::this_node::getName()) {
      end(plainLine(event.getPublisherName()) + " points the head");
    }
  }

  // Ends the program because of a problem, unless it still waits until it can begin.
  void endIf(const std::string& problem) {
    if (has_begun_ && !problem.empty()) {
      end(problem);
    }
  }

  void end(const std::string& why) {
    mask_.shutdown();  // so that no command follows
    ROS_WARN_STREAM_ONCE("The robot does not follow the ball any more: " << why << ". To go on: rosrun aibo_driver "
                                                                         << "aibo_follow_ball"
                                                                         << (walks_ ? " _walk:=true" : ""));
    ros::requestShutdown();
  }

  // If no masks come, there are no commands, and the driver stops the robot.
  void receiveMask(const sensor_msgs::Image::ConstPtr& mask) {
    if (const std::string& problem = state_problem_.empty() ? motion_problem_ : state_problem_; !problem.empty()) {
      if (problem != std::exchange(told_problem_, problem)) {
        ROS_INFO_STREAM("The robot cannot follow the ball yet: " << problem << ".");
      }
      return;
    }
    has_begun_ = true;
    const auto ball = aibo_driver::ball::findBall(*mask);
    if (walks_) {
      velocities_.publish(ball ? towards(*ball) : searching());
    } else if (ball && std::hypot(ball->left, ball->up) > kQuiet) {
      points_.publish(placeOf(*ball, mask->header));
    }
  }

  Twist towards(const Ball& ball) {
    last_seen_on_ = ball.left < 0 ? -1 : 1;
    Twist twist;
    twist.linear.x = std::clamp(0.6 * (ball.distance - kClose), -0.05, 0.12);
    twist.linear.y = ball.distance < kClose + 0.1 ? -0.04 : 0;
    twist.angular.z = std::clamp(1.4 * ball.left, -0.6, 0.6);
    return twist;
  }

  Twist searching() const {
    Twist twist;
    twist.angular.z = 0.4 * last_seen_on_;
    return twist;
  }

  // The ball's place in the camera's frame at the time of the picture. aibo_look_at knows from tf where this is now.
  static PointStamped placeOf(const Ball& ball, const std_msgs::Header& header) {
    PointStamped point;
    point.header = header;
    point.point.x = -ball.left * ball.distance;
    point.point.y = -ball.up * ball.distance;
    point.point.z = ball.distance;
    return point;
  }

  const bool walks_;  // false: the robot moves only the head
  bool has_begun_ = false;
  // Reasons why the program cannot begin to follow the ball; empty if there is none.
  std::string state_problem_ = "robot_state has not come";
  std::string motion_problem_ = "motion_state has not come";
  std::string told_problem_;  // the last of these reasons that was logged
  int last_seen_on_ = 1;      // the side of the robot on which the ball was last seen; -1 means on the right
  ros::Publisher velocities_;
  ros::Publisher points_;
  ros::Subscriber others_points_;
  ros::Subscriber connection_;
  ros::Subscriber motion_;
  ros::Subscriber state_;
  ros::Subscriber mask_;
};

constexpr char kHelp[] = R"(  rosrun aibo_driver aibo_follow_ball [_walk:=true]

Follows a pink ball with the head or, with ~walk, on the robot's legs. It ends when somebody stops the robot, or when
anything else moves it.
)";

}  // namespace

int main(int argc, char** argv) {
  return aibo_driver::tools::run<FollowBall>(argc, argv, "aibo_follow_ball", kHelp);
}
