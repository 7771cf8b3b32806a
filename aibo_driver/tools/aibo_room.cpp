// Shows the simulated robot's room in rviz: the floor, what stands on it, and the ball that rolls there. The frame odom
// begins where the driver starts, so the room is in its right place if the robot has not walked before that. With the
// parameter ~on_table, the robot begins on the table.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/Connection.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "node/node.h"
#include "node/state_publisher.h"
#include "robot_model/robot_model.h"
#include "simulator/ers7/scene/light.h"
#include "simulator/ers7/scene/scene.h"
#include "tools/program.h"

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using simulated_ers7::Body;
using simulated_ers7::Box;
using simulated_ers7::Capsule;
using visualization_msgs::Marker;

constexpr double kFootprint = 0.05;   // m; the colour of a part is the mean over this size
constexpr double kBallsPeriod = 0.1;  // s
constexpr double kSecondsPerFrame = robot_model::FRAME_MILLISECONDS / 1000.0;

std_msgs::ColorRGBA toColor(const simulated_ers7::Color& linear) {
  const auto on_screen = [](double light) {
    return static_cast<float>(std::pow(std::clamp(light, 0.0, 1.0), 1 / 2.2));
  };
  std_msgs::ColorRGBA color;
  color.r = on_screen(linear[0]);
  color.g = on_screen(linear[1]);
  color.b = on_screen(linear[2]);
  color.a = 1;
  return color;
}

geometry_msgs::Point toPoint(const Vector3d& place) {
  geometry_msgs::Point point;
  point.x = place.x();
  point.y = place.y();
  point.z = place.z();
  return point;
}

Marker emptyMarker(int id) {
  Marker marker;
  marker.header.frame_id = "odom";
  marker.ns = "room";
  marker.id = id;
  marker.pose.orientation.w = 1;
  return marker;
}

// Covers a part of the floor with tiles of two triangles each, in the mean colours that the camera would see there.
void pave(Marker& marker, const Vector3d& lowest, const Vector3d& highest, double tile) {
  for (double x = lowest.x(); x < highest.x() - tile / 2; x += tile) {
    for (double y = lowest.y(); y < highest.y() - tile / 2; y += tile) {
      const Vector3d middle(x + tile / 2, y + tile / 2, 0);
      const simulated_ers7::SceneHit hit{0, middle, Vector3d::UnitZ(), middle, simulated_ers7::Surface::kFloor};
      const std_msgs::ColorRGBA color = toColor(simulated_ers7::appearanceOf(hit, {tile, tile, 0}).albedo);
      const double corners[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
      for (const auto& corner : corners) {
        marker.points.push_back(toPoint({x + corner[0] * tile, y + corner[1] * tile, lowest.z()}));
        marker.colors.push_back(color);
      }
    }
  }
}

// The carpet lies on the parquet. Both are a little lower than in truth, or they would flicker where the feet touch
// them.
Marker floorMarker(Marker marker) {
  using namespace simulated_ers7;
  marker.type = Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1;
  pave(marker, {kLowestCorner[0], kLowestCorner[1], -0.006}, {kHighestCorner[0], kHighestCorner[1], 0}, 0.1);
  pave(marker, {kCarpetX - kCarpetHalfLength, -kCarpetHalfWidth, -0.003},
       {kCarpetX + kCarpetHalfLength, kCarpetHalfWidth, 0}, 2 * kLineHalfWidth);
  return marker;
}

// A marker's cylinder has no round ends, but none of the room's rods needs them.
Marker partMarker(const Body& body, const simulated_ers7::Part& part, Marker marker) {
  const Vector3d forward = body.turnToRoom(Vector3d::UnitX());
  Quaterniond turn(Eigen::AngleAxisd(std::atan2(forward.y(), forward.x()), Vector3d::UnitZ()));
  Vector3d middle;
  Vector3d size;
  if (const auto* box = std::get_if<Box>(&part.shape)) {
    marker.type = Marker::CUBE;
    middle = box->center;
    size = 2 * box->half_size;
  } else {
    const auto& capsule = std::get<Capsule>(part.shape);
    const Vector3d along = capsule.end - capsule.start;
    marker.type = along.isZero() ? Marker::SPHERE : Marker::CYLINDER;
    middle = (capsule.start + capsule.end) / 2;
    size = {2 * capsule.radius, 2 * capsule.radius, along.isZero() ? 2 * capsule.radius : along.norm()};
    turn = turn * Quaterniond::FromTwoVectors(Vector3d::UnitZ(), along.isZero() ? Vector3d::UnitZ().eval() : along);
  }
  const simulated_ers7::SceneHit hit{0, body.position(), Vector3d::UnitZ(), middle, part.surface};
  marker.color = toColor(simulated_ers7::appearanceOf(hit, Vector3d::Constant(kFootprint)).albedo);
  marker.pose.position = toPoint(body.position() + body.turnToRoom(middle));
  marker.pose.orientation.w = turn.w();
  marker.pose.orientation.x = turn.x();
  marker.pose.orientation.y = turn.y();
  marker.pose.orientation.z = turn.z();
  marker.scale.x = size.x();
  marker.scale.y = size.y();
  marker.scale.z = size.z();
  return marker;
}

class Room {
 public:
  Room(ros::NodeHandle handle, const ros::NodeHandle& parameters)
      : scene_(aibo_driver::node::readFlag(parameters, "on_table")) {
    constexpr bool kLatched = true;
    room_ = handle.advertise<visualization_msgs::MarkerArray>("room", 1, kLatched);
    ball_ = handle.advertise<Marker>("room/ball", 1);
    state_ = handle.subscribe("camera/state", 1, &Room::receiveState, this);
    connection_ = handle.subscribe("connection", 10, &Room::receiveConnection, this);
    timer_ = handle.createTimer(ros::Duration(kBallsPeriod), [this](const ros::TimerEvent&) { publishBall(); });
    publishRoom();
  }

 private:
  void publishRoom() const {
    visualization_msgs::MarkerArray markers;
    markers.markers.push_back(floorMarker(emptyMarker(0)));
    for (const Body& body : scene_.bodies()) {
      for (const simulated_ers7::Part& part : body.parts()) {
        if (part.surface != simulated_ers7::Surface::kBall) {
          markers.markers.push_back(partMarker(body, part, emptyMarker(static_cast<int>(markers.markers.size()))));
        }
      }
    }
    for (Marker& marker : markers.markers) {
      lower(marker);
    }
    aibo_driver::node::publishLatched(room_, markers);
  }

  // Lowers a marker, because the frame odom is on the ground that the robot stands on at first.
  void lower(Marker& marker) const { marker.pose.position.z -= scene_.groundAt(Eigen::Vector2d::Zero()); }

  // Moves the ball, whose place depends on the time since the robot was switched on.
  void receiveState(const aibo_driver::CameraState::ConstPtr& state) {
    if (state->frame_number > 0) {
      switched_on_ = state->header.stamp.toSec() - state->frame_number * kSecondsPerFrame;
    }
  }

  // Forgets when the robot was switched on, because the next connection may be to another run of it.
  void receiveConnection(const aibo_driver::Connection::ConstPtr& connection) {
    if (connection->state != aibo_driver::Connection::CONNECTED && switched_on_) {
      switched_on_.reset();
      Marker ball = emptyMarker(0);
      ball.action = Marker::DELETE;
      ball_.publish(ball);
    }
  }

  void publishBall() {
    if (!switched_on_ || ball_.getNumSubscribers() == 0) {
      return;
    }
    scene_.setTime(ros::Time::now().toSec() - *switched_on_);
    for (const Body& body : scene_.bodies()) {
      if (body.parts().front().surface == simulated_ers7::Surface::kBall) {
        Marker ball = partMarker(body, body.parts().front(), emptyMarker(0));
        lower(ball);
        ball_.publish(ball);
      }
    }
  }

  simulated_ers7::Scene scene_;
  std::optional<double> switched_on_;  ///< in seconds; may be below 0, because a stamp can have any value
  ros::Publisher room_;
  ros::Publisher ball_;
  ros::Subscriber state_;
  ros::Subscriber connection_;
  ros::Timer timer_;
};

constexpr char kHelp[] = R"(  rosrun aibo_driver aibo_room [__ns:=aibo] [_on_table:=true]

Shows the simulated robot's room in rviz. With ~on_table, the robot begins on the table.
)";

}  // namespace

int main(int argc, char** argv) {
  return aibo_driver::tools::run<Room>(argc, argv, "aibo_room", kHelp);
}
