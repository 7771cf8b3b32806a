// Looking at points, and the lights that rviz shows.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/LedStates.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/LookAtResult.h>
#include <geometry_msgs/PointStamped.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <cmath>

#include "ros/joint_user.h"

namespace {

using aibo_driver::LookAtResult;
using geometry_msgs::PointStamped;
using test_support::JointUser;
using test_support::Process;
using test_support::TopicListener;
using ::testing::HasSubstr;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

PointStamped point(const std::string& frame, double x, double y, double z) {
  PointStamped message;
  message.header.frame_id = frame;
  message.point.x = x;
  message.point.y = y;
  message.point.z = z;
  return message;
}

/// A robot, its driver, and a node that turns its head to points. A node or a driver that stalls for half a second
/// drops a point, so each point is given again until it has had its effect.
class LookUser : public JointUser {
 public:
  explicit LookUser(const std::string& name_space, const std::string& prefix = "")
      : JointUser(name_space, {"_stream_on_start:=false", "_joint_speed_limit:=20", "_approach_speed:=17",
                               "_frame_prefix:=" + prefix}),
        prefix_(prefix.empty() ? "" : prefix + "/"),
        node_({AIBO_LOOK_AT, "__ns:=" + name_space, "_frame_prefix:=" + prefix}),
        results_(name_space + "/look_at_result") {}

  /// The node's result for a point, once it contains this text.
  LookAtResult lookAt(const PointStamped& where, const std::string& message) {
    LookAtResult said;
    EXPECT_TRUE(becomesTrue([&] {
      results_.clear();
      publish("look_at", where);
      const auto results = results_.waitForCount(1, std::chrono::seconds(5));
      said = results.empty() ? LookAtResult() : *results.front();
      return said.message.find(message) != std::string::npos;
    })) << said.message;
    return said;
  }

  /// Whether the head turns so that the middle of the picture shows a point.
  bool turnsTo(const PointStamped& where) {
    return becomesTrue([&] {
      const LookAtResult result = lookAt(where, "The head turns to the point.");
      EXPECT_TRUE(result.success && result.moves);
      EXPECT_EQ(result.header.frame_id, where.header.frame_id);
      return seesInItsMiddle(where, std::chrono::seconds(5));
    });
  }

  bool seesInItsMiddle(const PointStamped& where, std::chrono::seconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    do {
      joints.messages().waitForNext();
      const auto seen = inFrame("camera_optical_frame", where, ros::Time());
      if (seen && std::atan2(std::hypot(seen->x(), seen->y()), seen->z()) < 0.01) {
        return true;
      }
    } while (std::chrono::steady_clock::now() < end);
    return false;
  }

  /// Where a point was in this frame, if tf knows that.
  std::optional<Eigen::Vector3d> inFrame(const std::string& frame, const PointStamped& where, ros::Time time) {
    try {
      const auto transform = frames_.lookupTransform(prefix_ + frame, where.header.frame_id, time).transform;
      const Eigen::Quaterniond rotation(transform.rotation.w, transform.rotation.x, transform.rotation.y,
                                        transform.rotation.z);
      const Eigen::Vector3d way(transform.translation.x, transform.translation.y, transform.translation.z);
      return rotation * Eigen::Vector3d(where.point.x, where.point.y, where.point.z) + way;
    } catch (const tf2::TransformException&) {
      return std::nullopt;
    }
  }

 private:
  const std::string prefix_;
  Process node_;
  TopicListener<LookAtResult> results_;
  tf2_ros::Buffer frames_;
  const tf2_ros::TransformListener listener_{frames_};
};

TEST(LookAt, TurnsTheCameraToPointsInAnyFrame) {
  LookUser user("/left", "left");
  for (const PointStamped& where : {point("left/base_footprint", 0.6, 0.4, 0), point("left/base_link", 1, -1, 0.5),
                                    point("left/odom", 0.35, 0, 0.01)}) {
    EXPECT_TRUE(user.turnsTo(where)) << where.header.frame_id;
  }
}

// A click into a picture: the head may have moved since the picture was taken. tf forgets after 10 s, so a computer
// that is slow gets another chance.
TEST(LookAt, KnowsWhereTheCameraWasWhenItTookThePicture) {
  LookUser user("/look");
  EXPECT_TRUE(user.becomesTrue([&] {
    EXPECT_TRUE(user.turnsTo(point("base_link", 1, 0.5, 0.1)));
    PointStamped clicked = point("camera_optical_frame", 0.1, 0.05, 1);
    clicked.header.stamp = user.joints.messages().waitForNext()->header.stamp;
    EXPECT_TRUE(user.turnsTo(point("base_link", 1, -0.5, 0.1)));
    const auto place = user.inFrame("base_link", clicked, clicked.header.stamp);
    if (!place) {
      return false;
    }
    user.publish("look_at", clicked);
    return user.seesInItsMiddle(point("base_link", place->x(), place->y(), place->z()), std::chrono::seconds(5));
  }));
}

TEST(LookAt, TurnsAsFarAsItCanAndSaysSo) {
  LookUser user("/look");
  const LookAtResult result = user.lookAt(point("base_link", -1, 1, 0.1), "out of reach");
  EXPECT_FALSE(result.success);
  EXPECT_TRUE(result.moves);
  EXPECT_GT(result.error, 0.5);
  EXPECT_THAT(result.message, HasSubstr(" be " + std::to_string(std::lround(result.error * 180 / M_PI)) + " degrees"));
}

TEST(LookAt, SaysWhyItKnowsNoPlaceOfAPoint) {
  LookUser user("/look");
  const LookAtResult nowhere = user.lookAt(point("the_moon", 1, 0, 0), "tf does not know where frame 'the_moon'");
  EXPECT_FALSE(nowhere.success || nowhere.moves);
  EXPECT_TRUE(std::isnan(nowhere.error));
  user.lookAt(point("", 1, 0, 0), "it has no frame");
  user.lookAt(point("base_link", std::numeric_limits<double>::quiet_NaN(), 0, 0), "not a finite number");
  PointStamped old = point("base_footprint", 1, 0, 0);
  old.header.stamp = ros::Time(1);
  user.lookAt(old, "at the point's time");
}

TEST(Lights, ShowWhatShinesAndWhatIsTouched) {
  JointUser user("/lit");
  const Process node({AIBO_LIGHTS, "__ns:=/lit", "_frame_prefix:=port"});
  TopicListener<MarkerArray> markers("/lit/lights");
  aibo_driver::Leds leds;
  leds.names = {"back_front_color"};
  leds.intensities = {1.0F};
  user.publish("leds", leds);
  ASSERT_THAT(user.robot.type("press chin"), HasSubstr("ok"));
  const auto shines = [](const MarkerArray& array, const std::string& frame) {
    return std::any_of(array.markers.begin(), array.markers.end(), [&frame](const Marker& marker) {
      return marker.action == Marker::ADD && marker.header.frame_id == frame;
    });
  };
  EXPECT_TRUE(markers.waitFor([&shines](const MarkerArray& array) {
    return shines(array, "port/base_link") && shines(array, "port/mouth_link") && !shines(array, "port/head_tilt_link");
  }));
}

TEST(Lights, ListenOnlyWhileSomebodyListensToThem) {
  const Process node({AIBO_LIGHTS, "__ns:=/dark"});
  const ros::Publisher leds = ros::NodeHandle("/dark").advertise<aibo_driver::LedStates>("led_states", 1);
  {
    const TopicListener<MarkerArray> viewer("/dark/lights");
    EXPECT_TRUE(JointUser::becomesTrue([&leds] { return leds.getNumSubscribers() == 1; }));
  }
  EXPECT_TRUE(JointUser::becomesTrue([&leds] { return leds.getNumSubscribers() == 0; }));
}

class RoomTest : public ::testing::Test {
 protected:
  /// Publishes when the robot was switched on, and waits for a ball that has been swinging since then.
  bool swings(ros::Duration since_switched_on) {
    aibo_driver::CameraState state;
    state.header.stamp = ros::Time::now() - ros::Duration(2.2);  // it took long to arrive
    state.frame_number = static_cast<std::uint32_t>(since_switched_on.toSec() / 0.008);
    robot_.publish("camera/state", state);
    int in_a_row = 0;  // a ball that swings at another time is there for a moment, too
    return JointUser::becomesTrue([&] {
      const auto ball = balls_.waitForNext();
      const double seconds = (ros::Time::now() - state.header.stamp + since_switched_on).toSec();
      const double left = 0.16 * std::sin(2 * M_PI * seconds / 6.0);
      const bool is_there = ball && ball->pose.position.x == 0.85 && std::abs(ball->pose.position.y - left) < 0.05;
      in_a_row = is_there ? in_a_row + 1 : 0;
      return in_a_row == 8;
    });
  }

  const Process node_{{AIBO_ROOM, "__ns:=/furnished"}};
  TopicListener<Marker> balls_{"/furnished/room/ball"};
  test_support::TopicPublishers robot_{"/furnished"};
};

TEST_F(RoomTest, IsThatOfTheSimulatedRobot) {
  const auto shown = TopicListener<MarkerArray>("/furnished/room").waitForFirst();
  ASSERT_TRUE(shown && shown->markers.size() > 10) << "floor, bone, station, pole, cubes";
  EXPECT_EQ(shown->markers[0].header.frame_id, "odom");
  EXPECT_NEAR(shown->markers[1].pose.position.x, 0.64, 1e-9);
  const Process on_table({AIBO_ROOM, "__ns:=/on_table", "_on_table:=true"});
  const auto from_table = TopicListener<MarkerArray>("/on_table/room").waitForFirst();
  EXPECT_TRUE(from_table && from_table->markers[0].pose.position.z < -0.3) << "odom is on the table";
}

TEST_F(RoomTest, HasTheBallWhereItIsNowUntilTheConnectionIsLost) {
  const ros::SteadyTime begin = ros::SteadyTime::now();
  EXPECT_TRUE(swings(ros::Duration(1.5)));
  EXPECT_TRUE(swings(ros::Duration(604.5))) << "the robot was switched on at another time";
  EXPECT_LE(balls_.count(), 10 * (ros::SteadyTime::now() - begin).toSec() + 2);
  robot_.publish("connection", aibo_driver::Connection());
  EXPECT_TRUE(balls_.waitFor([](const Marker& ball) { return ball.action == Marker::DELETE; }));
}

}  // namespace
