// Looking at points, and the lights that rviz shows.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/ColorRegions.h>
#include <aibo_driver/Connection.h>
#include <aibo_driver/LedStates.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/LookAtResult.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/Touch.h>
#include <geometry_msgs/PointStamped.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "support/ros/joint_user.h"

namespace {

using aibo_driver::LookAtResult;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using geometry_msgs::PointStamped;
using test_support::JointUser;
using test_support::kQuick;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::TopicListener;
using test_support::TopicPublishers;
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

std::vector<std::string> quickWith(const std::string& parameter = "_frame_prefix:=") {
  std::vector<std::string> parameters = kQuick;
  parameters.push_back(parameter);
  return parameters;
}

// A robot, its driver, and a node that turns its head to points.
class LookTest : public ::testing::Test {
 protected:
  LookAtResult lookAt(const PointStamped& where) {
    results_.clear();
    user_.publisherOf<PointStamped>("look_at").publish(where);
    const auto results = results_.waitForCount(1);
    return results.empty() ? LookAtResult() : *results.front();
  }

  // Waits until the middle of the picture shows a point.
  bool seesInItsMiddle(const PointStamped& where) {
    const auto end = std::chrono::steady_clock::now() + kSafetyNet;
    do {
      user_.joints.messages().waitForNext();
      try {
        const auto transform =
            frames_.lookupTransform("camera_optical_frame", where.header.frame_id, ros::Time()).transform;
        const Eigen::Quaterniond rotation(transform.rotation.w, transform.rotation.x, transform.rotation.y,
                                          transform.rotation.z);
        const Eigen::Vector3d way(transform.translation.x, transform.translation.y, transform.translation.z);
        const Eigen::Vector3d seen = rotation * Eigen::Vector3d(where.point.x, where.point.y, where.point.z) + way;
        if (std::atan2(std::hypot(seen.x(), seen.y()), seen.z()) < 0.01) {
          return true;
        }
      } catch (const tf2::TransformException&) {  // the frames have only begun
      }
    } while (std::chrono::steady_clock::now() < end);
    return false;
  }

  JointUser user_{"/look", quickWith()};
  Process node_{{AIBO_LOOK_AT, "__ns:=/look"}};
  TopicListener<LookAtResult> results_{"/look/look_at_result"};
  tf2_ros::Buffer frames_;
  const tf2_ros::TransformListener listener_{frames_};
};

TEST_F(LookTest, TurnsTheCameraToPointsInAnyFrame) {
  for (const PointStamped& where :
       {point("base_footprint", 0.6, 0.4, 0), point("base_link", 1, -1, 0.5), point("odom", 0.35, 0, 0.01)}) {
    const LookAtResult result = lookAt(where);
    EXPECT_TRUE(result.success && result.moves) << result.message;
    EXPECT_EQ(result.message, "The head turns to the point.");
    EXPECT_LT(result.error, 0.0015);
    EXPECT_EQ(result.header.frame_id, where.header.frame_id);
    EXPECT_TRUE(seesInItsMiddle(where)) << where.header.frame_id;
  }
}

// A click into a picture: the head may have moved since the picture was taken.
TEST_F(LookTest, KnowsWhereTheCameraWasWhenItTookThePicture) {
  ASSERT_TRUE(lookAt(point("base_link", 1, 1, 0.1)).success);
  ASSERT_TRUE(seesInItsMiddle(point("base_link", 1, 1, 0.1)));
  PointStamped clicked = point("camera_optical_frame", 0.1, 0.05, 1);
  clicked.header.stamp = user_.joints.messages().waitForNext()->header.stamp;
  PointStamped in_body = point("base_link", 0, 0, 0);
  ASSERT_TRUE(lookAt(point("base_link", 1, -1, 0.1)).success);
  ASSERT_TRUE(seesInItsMiddle(point("base_link", 1, -1, 0.1)));
  const auto transform = frames_.lookupTransform("base_link", "camera_optical_frame", clicked.header.stamp).transform;
  const Eigen::Quaterniond rotation(transform.rotation.w, transform.rotation.x, transform.rotation.y,
                                    transform.rotation.z);
  const Eigen::Vector3d place = rotation * Eigen::Vector3d(0.1, 0.05, 1);
  in_body.point.x = place.x() + transform.translation.x;
  in_body.point.y = place.y() + transform.translation.y;
  in_body.point.z = place.z() + transform.translation.z;
  TopicListener<MotionState> motion("/look/motion_state");
  const LookAtResult result = lookAt(clicked);
  EXPECT_TRUE(result.success);
  EXPECT_EQ(result.header.stamp, clicked.header.stamp) << "the program that clicked recognises its answer by it";
  EXPECT_TRUE(motion.waitFor([](const MotionState& state) {
    return !state.movements.empty() && state.movements[0].kind == Movement::LOOK_AT &&
           state.movements[0].source == "/look/aibo_look_at";
  })) << "it is told from other commands";
  EXPECT_TRUE(seesInItsMiddle(in_body));
}

TEST_F(LookTest, TurnsAsFarAsItCanAndSaysSo) {
  ASSERT_TRUE(seesInItsMiddle(point("camera_optical_frame", 0, 0, 1))) << "there are frames";
  const LookAtResult result = lookAt(point("base_link", -1, 1, 0.1));
  EXPECT_FALSE(result.success);
  EXPECT_TRUE(result.moves);
  EXPECT_GT(result.error, 0.5);
  EXPECT_THAT(result.message, HasSubstr("out of reach"));
  EXPECT_THAT(result.message, HasSubstr(" be " + std::to_string(std::lround(result.error * 180 / M_PI)) + " degrees"));
  EXPECT_TRUE(user_.waitForPanBeyond(1.5)) << "to its limit";
  node_.waitForOutput("WARN.*out of reach", kSafetyNet);
  const auto reaches = [this](double left, double up) {  // degrees
    const Eigen::Vector3d way = Eigen::AngleAxisd(left * M_PI / 180, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(-up * M_PI / 180, Eigen::Vector3d::UnitY()) *
                                Eigen::Vector3d(100, 0, 0);
    return static_cast<bool>(lookAt(point("base_link", way.x(), way.y(), way.z())).success);
  };
  EXPECT_TRUE(reaches(87, 0) && reaches(-87, 0) && reaches(0, 44) && reaches(0, -69));
  EXPECT_FALSE(reaches(90, 0) || reaches(-90, 0) || reaches(0, 47) || reaches(0, -72)) << "the message says 88, 70, 45";
}

TEST_F(LookTest, SaysWhyItDoesNotTurn) {
  ASSERT_TRUE(seesInItsMiddle(point("camera_optical_frame", 0, 0, 1)));
  const LookAtResult nowhere = lookAt(point("the_moon", 1, 0, 0));
  EXPECT_FALSE(nowhere.success || nowhere.moves);
  EXPECT_TRUE(std::isnan(nowhere.error));
  EXPECT_THAT(nowhere.message, HasSubstr("tf does not know where frame 'the_moon'"));
  EXPECT_THAT(lookAt(point("", 1, 0, 0)).message, HasSubstr("it has no frame"));
  EXPECT_THAT(lookAt(point("base_link", std::numeric_limits<double>::quiet_NaN(), 0, 0)).message,
              HasSubstr("not a finite number"));
  EXPECT_TRUE(lookAt(point("/base_link", 1, 0, 0)).success) << "as old programs call frames";
  PointStamped old = point("base_footprint", 1, 0, 0);
  old.header.stamp = ros::Time(1);
  EXPECT_THAT(lookAt(old).message, HasSubstr("at the point's time"));
}

TEST(LookOfAFleet, IsThatOfTheRobotInTheNamespace) {
  JointUser user("/left", quickWith("_frame_prefix:=left"));
  const Process node({AIBO_LOOK_AT, "__ns:=/left", "_frame_prefix:=left"});
  TopicListener<LookAtResult> results("/left/look_at_result");
  TopicListener<Marker> floor("/left/look_at_floor");
  user.publish("look_at", point("left/base_footprint", 0.5, 0.5, 0.2));
  ASSERT_FALSE(results.waitForCount(1).empty());
  const auto result = results.waitForCount(1).front();
  EXPECT_TRUE(result->success) << result->message;
  EXPECT_TRUE(user.waitForPanBeyond(0.6));
  ASSERT_FALSE(floor.waitForCount(1).empty());
  const Marker& drawn = *floor.waitForCount(1).front();
  EXPECT_EQ(drawn.header.frame_id, "left/base_footprint");
  EXPECT_EQ(drawn.type, Marker::CUBE);
  EXPECT_TRUE(drawn.frame_locked) << "it moves with the robot";
  EXPECT_LE(drawn.pose.position.z + drawn.scale.z / 2, 0);
  EXPECT_GT(std::min(drawn.scale.x, drawn.scale.y), 1);
  EXPECT_TRUE(drawn.color.a > 0 && drawn.color.a < 0.1F) << "hardly visible";
}

TEST(LookWithoutADriver, SaysThatNobodyListens) {
  const Process node({AIBO_LOOK_AT, "__ns:=/nobody"});
  TopicListener<LookAtResult> results("/nobody/look_at_result");
  TopicPublishers user("/nobody");
  user.publish("look_at", point("base_link", 1, 0, 0));
  ASSERT_FALSE(results.waitForCount(1).empty());
  EXPECT_THAT(results.waitForCount(1).front()->message, HasSubstr("nobody listens on /nobody/joint_command"));
}

// What the robot reports of a ball with a width of 20 pixels.
aibo_driver::ColorRegions ballAt(float x, float y, int pixels = 300) {
  aibo_driver::ColorRegions regions;
  regions.header.frame_id = "camera_optical_frame";
  regions.header.stamp = ros::Time(7);
  regions.width = 208;
  regions.height = 160;
  regions.regions.resize(2);
  regions.regions[0].name = "blue_bone";
  regions.regions[0].pixels = 1000;
  regions.regions[1].name = "pink_ball";
  regions.regions[1].pixels = static_cast<std::uint32_t>(pixels);
  regions.regions[1].x = x;
  regions.regions[1].y = y;
  regions.regions[1].box.width = 20;
  regions.regions[1].box.height = 18;
  return regions;
}

TEST(BallFollowerExample, LooksAtTheBallWhileItSeesIt) {
  TopicListener<PointStamped> points("/ball/look_at");
  Process node({BALL_FOLLOWER, "__ns:=/ball"});
  TopicPublishers robot("/ball");
  std::vector<PointStamped::ConstPtr> seen;
  for (int i = 0; i < 100 && seen.empty(); ++i) {  // the first ones may come before this program is connected
    robot.publish("color_regions", ballAt(155.5F, 31.5F));
    seen = points.waitForCount(1, std::chrono::milliseconds(kSafetyNet) / 100);
  }
  ASSERT_FALSE(seen.empty());
  const PointStamped point = *seen.front();
  EXPECT_EQ(point.header.frame_id, "camera_optical_frame");
  EXPECT_EQ(point.header.stamp, ros::Time(7)) << "where the camera was then";
  const double distance = 0.085 * 192 / 20;
  EXPECT_NEAR(point.point.z, distance, 1e-3);
  EXPECT_NEAR(point.point.x, distance * 52 / 192, 1e-3);
  EXPECT_NEAR(point.point.y, -distance * 48 / 192, 1e-3);
  robot.publish("color_regions", ballAt(200, 10, 0));
  node.waitForOutput("There is the ball[^T]*The ball is out of sight", kSafetyNet);
  for (const auto& each : {ballAt(200, 10, 5), ballAt(104, 80), ballAt(10, 79.5F)}) {
    robot.publish("color_regions", each);
  }
  const auto is_last = [](const PointStamped& each) { return each.point.x < 0; };
  ASSERT_TRUE(points.waitFor(is_last));
  for (const auto& each : points.waitForCount(1)) {
    EXPECT_TRUE(is_last(*each) || each->point == point.point)
        << "nothing for no ball, for a speck, and for one in the middle";
  }
}

TEST(BallFollowerExample, LooksAtWhatItIsToldToFind) {
  Process misled({BALL_FOLLOWER, "__ns:=/misled", "_fewest_pixels:=many"});
  misled.waitForOutput("misled/ball_follower/fewest_pixels is the text 'many'", kSafetyNet);
  TopicListener<PointStamped> points("/bone/look_at");
  const Process node({BALL_FOLLOWER, "__ns:=/bone", "_name:=blue_bone", "_fewest_pixels:=1000"});
  TopicPublishers robot("/bone");
  aibo_driver::ColorRegions regions = ballAt(155.5F, 31.5F);
  for (int i = 0; i < 100 && points.count() == 0; ++i) {
    regions.regions[0].pixels = 999;
    regions.regions[0].box.height = 10;
    robot.publish("color_regions", regions);
    regions.regions[0].pixels = 1000;
    regions.regions[0].box.height = 40;
    robot.publish("color_regions", regions);
    points.waitForCount(1, std::chrono::milliseconds(kSafetyNet) / 100);
  }
  ASSERT_GT(points.count(), 0U);
  EXPECT_NEAR(points.waitForCount(1).front()->point.z, 0.085 * 192 / 40, 1e-3) << "as long as it is high";
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
  user.robot.kill();
  EXPECT_TRUE(markers.waitFor([&shines](const MarkerArray& array) {
    return !shines(array, "port/base_link") && shines(array, "port/mouth_link");
  })) << "no LED is known to shine without a connection";
}

TEST(Lights, ListenOnlyWhileSomebodyListensToThem) {
  const Process node({AIBO_LIGHTS, "__ns:=/dark"});
  ros::NodeHandle handle("/dark");
  const ros::Publisher leds = handle.advertise<aibo_driver::LedStates>("led_states", 1);
  const ros::Publisher touch = handle.advertise<aibo_driver::Touch>("touch", 1);
  const auto listens = [&](std::uint32_t count) {
    const auto end = std::chrono::steady_clock::now() + kSafetyNet;
    const auto is_so = [&] { return leds.getNumSubscribers() == count && touch.getNumSubscribers() == count; };
    while (!is_so() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return is_so();
  };
  for (int i = 0; i < 2; ++i) {
    {
      const TopicListener<MarkerArray> viewer("/dark/lights");
      EXPECT_TRUE(listens(1));
    }
    EXPECT_TRUE(listens(0));
  }
}

TEST(Room, IsShownWithTheBallWhereItIsNow) {
  const Process node({AIBO_ROOM, "__ns:=/furnished"});
  TopicListener<MarkerArray> rooms("/furnished/room");
  TopicListener<Marker> balls("/furnished/room/ball");
  ASSERT_FALSE(rooms.waitForCount(1).empty());
  const auto room = rooms.waitForCount(1).front();
  ASSERT_GT(room->markers.size(), 10U) << "floor, bone, station, pole, cubes";
  const Marker& floor = room->markers.front();
  EXPECT_EQ(floor.header.frame_id, "odom");
  ASSERT_EQ(floor.points.size(), floor.colors.size());
  EXPECT_TRUE(std::any_of(floor.colors.begin(), floor.colors.end(), [](const auto& color) { return color.r > 0.8F; }))
      << "a white line";
  double area = 0;
  for (std::size_t i = 0; i + 2 < floor.points.size(); i += 3) {
    const auto* corner = &floor.points[i];
    area += ((corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) -
             (corner[2].x - corner[0].x) * (corner[1].y - corner[0].y)) /
            2;
  }
  EXPECT_NEAR(area, 4.8 * 4 + 3.2 * 2.5, 1e-6) << "the room and its carpet, all triangles seen from above";
  EXPECT_LT(floor.points.front().z, floor.points.back().z) << "the carpet lies on the floor";
  EXPECT_LT(floor.points.back().z, 0) << "below the feet";

  EXPECT_EQ(floor.pose.position.z, 0);
  for (std::size_t i = 0; i < room->markers.size(); ++i) {
    const auto& turn = room->markers[i].pose.orientation;
    EXPECT_EQ(room->markers[i].id, static_cast<int>(i));
    EXPECT_EQ(room->markers[i].ns, "room") << "as rviz calls it";
    EXPECT_NEAR(Eigen::Quaterniond(turn.w, turn.x, turn.y, turn.z).norm(), 1, 1e-9) << i;
  }
  const Marker& bone = room->markers[1];
  EXPECT_EQ(bone.type, Marker::CYLINDER);
  EXPECT_NEAR(bone.pose.position.x, 0.64, 1e-9);
  EXPECT_NEAR(bone.pose.position.y, -0.13, 1e-9);
  EXPECT_NEAR(bone.scale.z, 0.104, 1e-9);
  EXPECT_NEAR(bone.color.r, 0.893, 0.02);
  EXPECT_NEAR(bone.color.g, 0.409, 0.02);
  EXPECT_NEAR(bone.color.b, 0.542, 0.02);
  EXPECT_EQ(bone.color.a, 1);
  const auto& turn = bone.pose.orientation;
  const Eigen::Vector3d along = Eigen::Quaterniond(turn.w, turn.x, turn.y, turn.z) * Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(along.isApprox(Eigen::Vector3d(std::cos(1.0), std::sin(1.0), 0))) << along.transpose();
  const auto back = std::find_if(room->markers.begin(), room->markers.end(),
                                 [](const Marker& marker) { return std::abs(marker.scale.x - 0.056) < 1e-9; });
  ASSERT_NE(back, room->markers.end()) << "the station's";
  EXPECT_EQ(back->type, Marker::CUBE);
  EXPECT_NEAR(back->pose.position.x, 1.42 + 0.12 * std::cos(0.45), 1e-9);
  EXPECT_NEAR(back->pose.position.y, 0.42 + 0.12 * std::sin(0.45), 1e-9);
  EXPECT_NEAR(back->pose.position.z, 0.060, 1e-9);
  EXPECT_NEAR(back->scale.y, 0.17, 1e-9);
  EXPECT_NEAR(back->scale.z, 0.072, 1e-9);
  EXPECT_NEAR(back->pose.orientation.z, std::sin(0.225), 1e-9);
  EXPECT_NEAR(back->pose.orientation.w, std::cos(0.225), 1e-9);
  const Process on_table({AIBO_ROOM, "__ns:=/on_table", "_on_table:=true"});
  TopicListener<MarkerArray> from_table("/on_table/room");
  ASSERT_FALSE(from_table.waitForCount(1).empty());
  EXPECT_LT(from_table.waitForCount(1).front()->markers.front().pose.position.z, -0.3) << "odom is on the table";

  TopicPublishers robot("/furnished");
  aibo_driver::CameraState state;
  const auto swing = [&](ros::Duration since_switched_on) {
    state.header.stamp = ros::Time::now() - ros::Duration(2.2);  // it took long to arrive
    state.frame_number = static_cast<std::uint32_t>(since_switched_on.toSec() / 0.008);
    robot.publish("camera/state", state);
    const auto is_there = [&](const Marker& ball) {
      const double seconds = (ros::Time::now() - state.header.stamp + since_switched_on).toSec();
      return std::abs(ball.pose.position.y - 0.16 * std::sin(2 * M_PI * seconds / 6.0)) < 0.02 &&
             ball.pose.position.x == 0.85 && std::abs(ball.pose.position.z - 0.0425) < 1e-9;
    };
    int in_a_row = 0;  // a ball that swings at another time is there for a moment, too
    const auto end = std::chrono::steady_clock::now() + test_support::kSafetyNet;
    while (in_a_row < 4 && std::chrono::steady_clock::now() < end) {
      const auto ball = balls.waitForNext();
      in_a_row = ball && is_there(*ball) ? in_a_row + 1 : 0;
    }
    return in_a_row == 4;
  };
  EXPECT_TRUE(swing(ros::Duration(1.5)));
  TopicPublishers robot_on_table("/on_table");
  robot_on_table.publish("camera/state", state);
  TopicListener<Marker> ball_below("/on_table/room/ball");
  const auto below = ball_below.waitForNext();
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->pose.position.z, from_table.waitForCount(1).front()->markers.front().pose.position.z + 0.0425,
              1e-9)
      << "the ball is on the floor";
  EXPECT_TRUE(swing(ros::Duration(604.5))) << "the robot was switched on at another time";

  const auto is_gone = [](const Marker& ball) { return ball.action == Marker::DELETE; };
  aibo_driver::Connection connection;
  connection.state = aibo_driver::Connection::CONNECTED;
  robot.publish("connection", connection);
  balls.clear();
  balls.waitForCount(3);
  EXPECT_FALSE(balls.waitFor(is_gone, std::chrono::milliseconds(0))) << "nothing has been lost";
  connection.state = aibo_driver::Connection::DISCONNECTED;
  robot.publish("connection", connection);
  ASSERT_TRUE(balls.waitFor(is_gone));
  state.frame_number = 0;  // that of a robot of version 1
  robot.publish("camera/state", state);
  balls.clear();
  EXPECT_TRUE(balls.waitForCount(1, std::chrono::milliseconds(300)).empty()) << "nobody knows where it is";
  EXPECT_TRUE(swing(ros::Duration(2.9))) << "the robot has started again";
  balls.clear();
  robot.publish("connection", connection);
  EXPECT_TRUE(balls.waitFor(is_gone)) << "and is lost again";
}

}  // namespace
