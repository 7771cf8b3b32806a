// Turns the head so that a point appears in the middle of the camera's picture. The point may be in any frame that tf
// knows. This is a node of its own because listening to tf takes more processor time than most of the driver's work.

#include <aibo_driver/LookAtResult.h>
#include <aibo_driver/RobotState.h>
#include <geometry_msgs/PointStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "node/node.h"
#include "robot_model/head.h"
#include "text/plain_text.h"
#include "text/throttled_warnings.h"
#include "tools/program.h"

namespace {

using aibo_driver::LookAtResult;
using aibo_driver::RobotState;
using geometry_msgs::PointStamped;

// The greatest error, a third of a pixel, with which a point still counts as in the middle of the picture.
constexpr double kMiddle = 0.0015;

// How long to wait for the transform and, after the start, for the driver. The transforms in tf are late by one
// measurement of the robot, which is 32 ms, and by the delay of the radio.
constexpr double kPatience = 0.5;  // s

constexpr double kDegree = M_PI / 180;

// Waits by the wall clock, because ROS' own clock may stand still. Other threads serve tf and connections.
template <typename Condition>
bool waitFor(const Condition& condition) {
  const ros::SteadyTime end = ros::SteadyTime::now() + ros::WallDuration(kPatience);
  bool is_fulfilled = condition();
  while (!is_fulfilled && ros::SteadyTime::now() < end && ros::ok()) {
    ros::WallDuration(0.005).sleep();
    is_fulfilled = condition();
  }
  return is_fulfilled;
}

std::string readFramePrefix(const ros::NodeHandle& parameters) {
  const auto prefix = parameters.param<std::string>("frame_prefix", "");
  return prefix.empty() ? "" : prefix + "/";
}

// The floor around the robot, hardly visible. rviz' tool finds only points on something that is drawn, and its grid
// does not count.
visualization_msgs::Marker makeFloor(const std::string& frame) {
  constexpr double kSize = 6;  // m
  constexpr double kThickness = 0.002;
  visualization_msgs::Marker floor;
  floor.header.frame_id = frame;
  floor.ns = "floor";
  floor.type = visualization_msgs::Marker::CUBE;
  floor.frame_locked = 1u;
  floor.pose.position.z = -kThickness;  // so that the floor is below the grid
  floor.pose.orientation.w = 1;
  floor.scale.x = floor.scale.y = kSize;
  floor.scale.z = kThickness;
  floor.color.r = floor.color.g = floor.color.b = 1;
  floor.color.a = 0.03F;
  return floor;
}

class LookAt {
 public:
  LookAt(ros::NodeHandle handle, const ros::NodeHandle& parameters) : frame_prefix_(readFramePrefix(parameters)) {
    constexpr bool kLatched = true;
    result_ = handle.advertise<LookAtResult>("look_at_result", 1, kLatched);
    joints_ = handle.advertise<sensor_msgs::JointState>("joint_command", 1);
    floor_ = handle.advertise<visualization_msgs::Marker>("look_at_floor", 1, kLatched);
    floor_.publish(makeFloor(frame_prefix_ + "base_footprint"));
    states_ = handle.subscribe("robot_state", 1, &LookAt::receiveState, this);
    points_ = handle.subscribe("look_at", 1, &LookAt::receive, this);
  }

 private:
  void receive(const PointStamped::ConstPtr& point) {
    LookAtResult result;
    result.header = point->header;
    result.error = std::numeric_limits<float>::quiet_NaN();
    try {
      lookAt(findPlace(*point), &result);
    } catch (const std::runtime_error& problem) {
      result.message = problem.what();
    }
    if (!result.success) {
      warnings_.warn(result.message);
    }
    result_.publish(result);
  }

  void receiveState(const RobotState::ConstPtr& state) {
    why_not_ = state->stopped != 0
                   ? aibo_driver::text::plainLine(state->stopped_by) + " has stopped the robot; call release"
               : state->motors == RobotState::OFF ? "the motors are off; call stand, or motors"
                                                  : "";
  }

  void lookAt(const robot_model::Point& place, LookAtResult* result) {
    if (!why_not_.empty()) {
      throw std::runtime_error("The head does not turn: " + why_not_ + ".");
    }
    if (!waitFor([this] { return joints_.getNumSubscribers() > 0; })) {
      throw std::runtime_error("The head does not turn: nobody listens on " + joints_.getTopic() +
                               ". Does the driver run in this namespace?");
    }
    robot_model::HeadAngles angles;
    const double error = robot_model::findHeadAngles(place, &angles);
    sensor_msgs::JointState command;
    command.header.stamp = ros::Time::now();
    command.header.frame_id = "look_at";  // distinguishes this command from others in motion_state
    command.name = {"neck_tilt", "head_pan", "head_tilt"};
    command.position = {angles.neck_tilt, angles.head_pan, angles.head_tilt};
    joints_.publish(command);
    result->success = error < kMiddle;
    result->moves = true;
    result->error = static_cast<float>(error);
    result->message = result->success ? "The head turns to the point." : describeMiss(error);
  }

  static std::string describeMiss(double error) {
    std::ostringstream text;
    text << "The point is out of reach: the head turns as far as it can, and the middle of the picture will be "
         << std::lround(error / kDegree)
         << " degrees from it. The camera can look 88 degrees to either side and, ahead, "
         << "from 70 degrees down to 45 up; not behind the robot, nor at the floor beside it.";
    return text.str();
  }

  // @return the point in the robot's body
  // @throw std::runtime_error the point's place is not known; the message says why
  robot_model::Point findPlace(const PointStamped& point) {
    const Eigen::Vector3d given(point.point.x, point.point.y, point.point.z);
    if (!given.allFinite()) {
      throw std::runtime_error("A point on look_at was refused: a coordinate is not a finite number.");
    }
    if (point.header.frame_id.empty()) {
      throw std::runtime_error(
          "A point on look_at was refused: it has no frame. Set header.frame_id, for instance to " + base_frame_ + ".");
    }
    const geometry_msgs::Transform transform = waitForTransform(point.header).transform;
    const Eigen::Quaterniond rotation(transform.rotation.w, transform.rotation.x, transform.rotation.y,
                                      transform.rotation.z);
    const Eigen::Vector3d translation(transform.translation.x, transform.translation.y, transform.translation.z);
    const Eigen::Vector3d place = rotation * given + translation;
    return {place.x(), place.y(), place.z()};
  }

  geometry_msgs::TransformStamped waitForTransform(const std_msgs::Header& header) {
    const std::string frame = header.frame_id[0] == '/' ? header.frame_id.substr(1) : header.frame_id;
    waitFor([&] { return frames_.canTransform(base_frame_, frame, header.stamp); });
    try {
      return frames_.lookupTransform(base_frame_, frame, header.stamp);
    } catch (const tf2::TransformException& error) {
      throw std::runtime_error("A point on look_at was dropped: tf does not know where frame '" + frame + "' was in '" +
                               base_frame_ + "' at the point's time (" + error.what() +
                               "). Is the frame's name right, is the robot connected, and is the stamp recent? Stamp 0 "
                               "means now.");
    }
  }

  const std::string frame_prefix_;
  const std::string base_frame_ = frame_prefix_ + "base_link";
  tf2_ros::Buffer frames_;
  const tf2_ros::TransformListener listener_{frames_};
  aibo_driver::text::ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM(text); }};
  ros::Publisher result_;
  ros::Publisher joints_;
  ros::Publisher floor_;
  std::string why_not_;  ///< why the head cannot turn now; empty if it can
  ros::Subscriber states_;
  ros::Subscriber points_;
};

constexpr char kHelp[] = R"(  rosrun aibo_driver aibo_look_at [__ns:=aibo] [_frame_prefix:=PREFIX]

Turns the head so that the middle of the camera's picture shows the points on look_at.
)";

}  // namespace

int main(int argc, char** argv) {
  return aibo_driver::tools::run<LookAt>(argc, argv, "aibo_look_at", kHelp);
}
