// The robot's body except its joints: sensors, LEDs and ears, and motions.

#include <aibo_driver/Connection.h>
#include <aibo_driver/DeleteMotion.h>
#include <aibo_driver/DeletePicture.h>
#include <aibo_driver/Ears.h>
#include <aibo_driver/FetchPicture.h>
#include <aibo_driver/LedStates.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/ListPictures.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/StopMotion.h>
#include <aibo_driver/TakePictureOnRobot.h>
#include <aibo_driver/Touch.h>
#include <aibo_driver/UploadMotion.h>
#include <gmock/gmock.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Range.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "node/body/body_pose.h"
#include "protocol/walk_requests.h"
#include "robot_model/robot_model.h"
#include "support/memory_stick.h"
#include "support/ros/driver_user.h"
#include "support/ros/joint_listener.h"
#include "support/ros/topic_listener.h"
#include "support/scripted_server.h"
#include "support/simulated_robot.h"

namespace {

using aibo_driver::Connection;
using aibo_driver::DeleteMotion;
using aibo_driver::DeletePicture;
using aibo_driver::Ears;
using aibo_driver::FetchPicture;
using aibo_driver::Leds;
using aibo_driver::LedStates;
using aibo_driver::ListMotions;
using aibo_driver::ListPictures;
using aibo_driver::PlayMotion;
using aibo_driver::StopMotion;
using aibo_driver::TakePictureOnRobot;
using aibo_driver::Touch;
using aibo_driver::UploadMotion;
using sensor_msgs::BatteryState;
using sensor_msgs::Imu;
using sensor_msgs::Range;
using test_support::DriverProcess;
using test_support::DriverUser;
using test_support::JointListener;
using test_support::MemoryStick;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

// All tests share a master, and this topic has the same name for all drivers.
std::string ownTf(const std::string& name_space) {
  return "/tf:=" + name_space + "/tf";
}

// Of a joint of a leg, in microradian.
int angleOf(std::size_t joint) {
  return 100000 + 20000 * static_cast<int>(joint * 7 % 12);
}

class BodyUser : public DriverUser {
 public:
  explicit BodyUser(const std::string& name_space, const std::vector<std::string>& robot_options = {})
      : DriverUser(name_space, {"_stream_on_start:=false", ownTf(name_space)}, robot_options) {}

  PlayMotion::Response play(const std::string& name, int repetitions) {
    PlayMotion::Request request;
    request.name = name;
    request.repetitions = static_cast<std::uint16_t>(repetitions);
    return call<PlayMotion>("play_motion", request);
  }

  StopMotion::Response stopMotion(const std::string& name) {
    StopMotion::Request request;
    request.name = name;
    return call<StopMotion>("stop_motion", request);
  }
};

TEST(RangeFinders, ArePublishedWithFrameAndRange) {
  const BodyUser user("/ranges");
  for (const std::string name : {"near", "far", "chest"}) {
    TopicListener<Range> ranges("/ranges/range/" + name);
    const auto messages = ranges.waitForCount(10);
    ASSERT_GE(messages.size(), 10u) << name;
    ros::Time last;
    for (const auto& message : messages) {
      EXPECT_EQ(message->header.frame_id, "rex/range_" + name + "_link");
      EXPECT_EQ(message->radiation_type, Range::INFRARED);
      EXPECT_TRUE(std::isinf(message->range) ||
                  (message->range >= message->min_range && message->range <= message->max_range))
          << message->range;
      EXPECT_GT(message->header.stamp, last);
      last = message->header.stamp;
    }
  }
}

TEST(Acceleration, OfARobotThatLiesStillPointsUpwards) {
  const BodyUser user("/imu");
  TopicListener<Imu> accelerations("/imu/imu/data_raw");
  const auto message = accelerations.waitForNext();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->header.frame_id, "rex/imu_link");
  const auto& acceleration = message->linear_acceleration;
  EXPECT_NEAR(std::hypot(acceleration.x, acceleration.y, acceleration.z), 9.81, 0.3);
  EXPECT_GT(acceleration.z, 8);
  EXPECT_EQ(message->orientation_covariance[0], -1);
  EXPECT_EQ(message->angular_velocity_covariance[0], -1);
}

// The transforms from base_footprint to base_link.
class Footprints {
 public:
  explicit Footprints(const std::string& name_space) : listener_(name_space + "/tf") {}

  /// Waits for one with a height and a pitch between these limits.
  bool waitFor(double lowest, double highest, double lowest_pitch, double highest_pitch) {
    return listener_.waitFor([=](const tf2_msgs::TFMessage& message) {
      const geometry_msgs::TransformStamped& each = message.transforms.front();
      const auto& rotation = each.transform.rotation;
      const double height = each.transform.translation.z;
      const double pitch = std::asin(2 * (rotation.w * rotation.y - rotation.z * rotation.x)) * 180 / M_PI;
      return each.header.frame_id == "rex/base_footprint" && each.child_frame_id == "rex/base_link" &&
             height > lowest && height < highest && pitch > lowest_pitch && pitch < highest_pitch;
    }) != nullptr;
  }

  bool waitFor(const ros::Time& stamp) {
    return listener_.waitFor([&stamp](const tf2_msgs::TFMessage& message) {
      const geometry_msgs::TransformStamped& each = message.transforms.front();
      return each.child_frame_id == "rex/base_link" && each.header.stamp == stamp;
    }) != nullptr;
  }

  std::size_t count() const { return listener_.count(); }

 private:
  TopicListener<tf2_msgs::TFMessage> listener_;
};

TEST(Footprint, OfARobotThatStandsAndThenSitsIsUnderItsFeet) {
  Footprints footprints("/footprint");
  BodyUser user("/footprint");
  EXPECT_TRUE(footprints.waitFor(0.12, 0.15, -3, 3));
  EXPECT_TRUE(user.play("sit", 1).success);
  EXPECT_TRUE(footprints.waitFor(0.08, 0.13, -28, -22)) << "leaning back by 25 degrees";
  JointListener joints("/footprint");
  const auto measured = joints.messages().waitForNext();
  EXPECT_TRUE(measured && footprints.waitFor(measured->header.stamp)) << "it has the time of the joints";
}

// It first lies level, and nobody listens. Then it tilts for one measurement. Each joint of its legs has another angle.
TEST(Footprint, IsSmoothedFromTheFirstMessageThatAListenerGets) {
  namespace version2 = protocol::version2;
  test_support::ScriptedServer server;
  const DriverProcess driver("/late", server.port(), {"_stream_on_start:=false", ownTf("/late")});
  test_support::ScriptedPeer robot = server.accept();
  robot.agreeToTelemetry("F J T S E");
  unsigned frame = 0xFFFFFFFE;
  const auto tell = [&](const std::vector<version2::TelemetryEntry>& entries) {
    robot.send(version2_frames::makeFrame('t', 0, version2_frames::makeTelemetry(++frame, entries)));
  };
  const robot_model::RobotModel& ers7 = *robot_model::findRobotModel("ERS-7");
  const auto lie = [&](double forward, double up) {
    std::vector<version2::TelemetryEntry> entries;
    const std::pair<const char*, double> accelerations[] = {
        {"front_back", -forward}, {"right_left", 0}, {"up_down", -up}};
    for (const auto& [axis, value] : accelerations) {
      const int sensor = robot_model::findSensorByName(ers7, (std::string("acceleration_") + axis).c_str());
      entries.push_back({version2::GROUP_SENSOR, ers7.sensors[sensor].identifier, static_cast<int>(1e6 * value)});
    }
    for (std::size_t i = 0; i < 12; ++i) {
      const int joint = robot_model::findJointByName(ers7, aibo_driver::node::legJointName(i / 3, i % 3).c_str());
      entries.push_back({version2::GROUP_JOINT, ers7.joints[joint].identifier, angleOf(i)});
    }
    tell(entries);
  };
  lie(0, 9.8);
  const unsigned begin = frame;
  TopicListener<tf2_msgs::TFMessage> transforms("/late/tf");
  do {  // until the driver knows its listener
    tell({{'W', version2::WALK_FORWARD, 0}, {'W', version2::WALK_LEFT, 0}, {'W', version2::WALK_TURN, 0}});
  } while (transforms.waitForCount(1, std::chrono::milliseconds(300)).empty());
  lie(7, 7);
  const auto found = transforms.waitFor(
      [](const tf2_msgs::TFMessage& each) { return each.transforms[0].child_frame_id == "base_link"; });
  ASSERT_TRUE(found);
  aibo_driver::node::BodyPose pose;
  geometry_msgs::Vector3 up;
  up.z = 9.8;
  pose.accelerate(up, ros::Time(1));
  up.x = up.z = 7;
  pose.accelerate(up, ros::Time(1 + 0.008 * (frame - begin)));
  std::array<robot_model::LegAngles, 4> legs{};
  for (std::size_t leg = 0; leg < 4; ++leg) {
    legs[leg] = {angleOf(3 * leg) / 1e6, angleOf(3 * leg + 1) / 1e6, angleOf(3 * leg + 2) / 1e6};
  }
  const geometry_msgs::Transform expected = pose.above(legs);
  const geometry_msgs::Transform& is = found->transforms[0].transform;
  EXPECT_NEAR(is.translation.z, expected.translation.z, 0.001);
  EXPECT_NEAR(is.rotation.x, expected.rotation.x, 0.005);
  EXPECT_NEAR(is.rotation.y, expected.rotation.y, 0.005);
}

TEST(Footprint, IsNotPublishedIfItIsNotWanted) {
  SimulatedRobot robot;
  Footprints footprints("/no_footprint");
  TopicListener<Imu> accelerations("/no_footprint/imu/data_raw");
  TopicListener<nav_msgs::Odometry> odom("/no_footprint/odom");
  DriverProcess driver("/no_footprint", robot.port(),
                       {"_publish_footprint:=false", "_publish_odom_tf:=false", ownTf("/no_footprint")});
  ASSERT_GE(accelerations.waitForCount(30).size(), 30u);
  ASSERT_TRUE(odom.waitForNext());
  EXPECT_EQ(footprints.count(), 0u) << "neither the footprint nor the odometry";
}

TEST(TouchTopic, FollowsWhatIsPressed) {
  const BodyUser user("/touch");
  TopicListener<Touch> touch("/touch/touch");
  const auto first = touch.waitForNext();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->header.frame_id, "rex/base_link");
  ASSERT_THAT(user.robot.type("press chin"), HasSubstr("ok"));
  EXPECT_TRUE(touch.waitFor([](const Touch& message) { return message.chin && !message.back_rear; }));
  ASSERT_THAT(user.robot.type("press back_rear"), HasSubstr("ok"));
  EXPECT_TRUE(touch.waitFor(
      [](const Touch& message) { return message.chin && message.back_rear && message.back_rear_strength > 14; }));
  ASSERT_THAT(user.robot.type("release chin"), HasSubstr("ok"));
  EXPECT_TRUE(touch.waitFor([](const Touch& message) { return !message.chin && message.back_rear; }));
}

TEST(BatteryTopic, SaysHowFullItIs) {
  const BodyUser user("/battery");
  TopicListener<BatteryState> battery("/battery/battery");
  const auto full = battery.waitForNext();
  ASSERT_TRUE(full);
  EXPECT_EQ(full->header.frame_id, "rex/base_link");
  EXPECT_GT(full->percentage, 0.9);
  EXPECT_TRUE(std::isnan(full->voltage));
  ASSERT_THAT(user.robot.type("battery 40"), HasSubstr("ok"));
  EXPECT_TRUE(battery.waitFor([](const BatteryState& message) { return std::abs(message.percentage - 0.4) < 0.02; }));
}

TEST(Sensors, AreSilentWithoutARobotAndThenPublishOnlyNewValues) {
  BodyUser user("/silent");
  TopicListener<Touch> touch("/silent/touch");
  ASSERT_THAT(user.robot.type("press chin"), HasSubstr("ok"));
  ASSERT_TRUE(touch.waitFor([](const Touch& message) { return message.chin != 0; }));
  user.loseRobot();
  touch.clear();
  user.connection.clear();
  user.robot.restart();
  ASSERT_TRUE(touch.waitForNext());
  for (const auto& message : touch.waitForCount(5)) {
    EXPECT_FALSE(message->chin) << "this robot's chin was never pressed";
  }
  ASSERT_TRUE(user.waitForConnection(Connection::CONNECTED));
}

// The first LEDs of the table are those of the head, the seventh is face_1.
bool areAll(const LedStates& states, float intensity) {
  return std::all_of(states.intensities.begin(), states.intensities.end(),
                     [=](float each) { return each == intensity || (std::isnan(each) && std::isnan(intensity)); });
}

TEST(LedStatesTopic, FollowsWhatTheRobotAcceptedAndTheConnection) {
  BodyUser user("/led_states");
  TopicListener<LedStates> states("/led_states/led_states");
  ASSERT_TRUE(states.waitFor([](const LedStates& each) { return areAll(each, 0); })) << "they are off at first";
  Leds message;
  message.names = {"face_1", "wireless"};
  message.intensities = {0.2F};
  message.mode = Leds::MODE_B;
  user.publish("leds", message);
  const auto shown = states.waitFor([](const LedStates& each) { return each.intensities.at(5) == 1; });
  ASSERT_TRUE(shown);
  EXPECT_LT(std::abs((ros::Time::now() - shown->header.stamp).toSec()), 20);
  EXPECT_EQ(shown->names.at(6), "face_1");
  EXPECT_FLOAT_EQ(shown->intensities.at(6), 0.2F);
  EXPECT_EQ(shown->modes.at(6), LedStates::MODE_B);
  EXPECT_EQ(shown->modes.at(5), LedStates::MODE_A) << "this one has no modes";
  TopicListener<LedStates> late("/led_states/led_states");
  ASSERT_FALSE(late.waitForCount(1).empty()) << "it is latched";
  user.robot.kill();
  ASSERT_TRUE(states.waitFor([](const LedStates& each) { return areAll(each, NAN); }));
  user.robot.restart();
  EXPECT_TRUE(states.waitFor([](const LedStates& each) { return areAll(each, 0); }));
}

TEST(Expression, IsDroppedWithoutARobotAndNotSentLater) {
  BodyUser user("/dropped_expression");
  user.publisherOf<Leds>("leds");
  user.publisherOf<Ears>("ears");
  user.loseRobot();
  Leds leds;
  leds.names = {"face"};
  leds.intensities = {1.0F};
  user.publish("leds", leds);
  user.publish("ears", Ears());
  user.waitForWarning("A command to the LEDs was dropped");
  user.waitForWarning("A command to the ears was dropped");
  user.connection.clear();
  user.robot.restart();
  ASSERT_TRUE(user.waitForConnection(Connection::CONNECTED));
  TopicListener<Touch> touch("/dropped_expression/touch");
  ASSERT_TRUE(touch.waitForNext());
  EXPECT_THAT(user.proxy.requestsFromDriver("LK"), SizeIs(0));
}

// How far any joint moves from where it was, in radians.
bool moves(JointListener& joints) {
  joints.messages().clear();
  const auto first = joints.messages().waitForNext();
  return first && joints.messages().waitFor([&first](const sensor_msgs::JointState& message) {
    for (std::size_t i = 0; i < message.position.size(); ++i) {
      if (std::abs(message.position[i] - first->position.at(i)) > 0.1) {
        return true;
      }
    }
    return false;
  });
}

TEST(PlayMotionService, PlaysEachMotionOfTheRobotAndStopsIt) {
  BodyUser user("/play");
  JointListener joints("/play");
  const auto list = user.call<ListMotions>("list_motions");
  ASSERT_TRUE(list.success) << list.message;
  ASSERT_THAT(list.names, Contains("NOD.MTN"));
  for (const std::string& name : list.names) {
    const auto played = user.play(name, 100);
    EXPECT_TRUE(played.success) << played.message;
    EXPECT_TRUE(moves(joints)) << name;
    const auto stopped = user.stopMotion(name);
    EXPECT_TRUE(stopped.success) << stopped.message;
    EXPECT_TRUE(joints.messages().waitFor([](const sensor_msgs::JointState& message) {
      return std::all_of(message.velocity.begin(), message.velocity.end(),
                         [](double velocity) { return std::abs(velocity) < 0.05; });
    })) << name;
  }
}

TEST(MotionFiles, AreUploadedPlayedAndDeletedIfTheRobotAllowsIt) {
  const MemoryStick stick("ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\n");
  BodyUser user("/upload", {"--memory-stick", stick.path()});
  UploadMotion::Request upload;
  upload.file = stick.path("OPEN-R/MW/DATA/P/WAG.MTN");
  upload.name = "mine";
  const auto uploaded = user.call<UploadMotion>("upload_motion", upload);
  ASSERT_TRUE(uploaded.success) << uploaded.message;
  EXPECT_THAT(user.call<ListMotions>("list_motions").names, Contains("MINE.MTN"));
  JointListener joints("/upload");
  EXPECT_TRUE(user.play("mine", 5).success);
  EXPECT_TRUE(moves(joints));
  EXPECT_TRUE(user.stopMotion("").success);
  DeleteMotion::Request request;
  request.name = "mine";
  const auto deleted = user.call<DeleteMotion>("delete_motion", request);
  EXPECT_TRUE(deleted.success) << deleted.message;
  EXPECT_THAT(user.call<ListMotions>("list_motions").names, Not(Contains("MINE.MTN")));
}

TEST(StickPictures, AreTakenListedFetchedAndDeletedIfTheRobotAllowsIt) {
  const MemoryStick stick("ALLOW_PICTURES=yes\nALLOW_DELETE=yes\n");
  BodyUser user("/stick", {"--memory-stick", stick.path()});
  const auto taken = user.call<TakePictureOnRobot>("take_picture_on_robot");
  ASSERT_TRUE(taken.success) << taken.message;
  EXPECT_EQ(taken.name, "AIBO0001.JPG");
  EXPECT_THAT(user.call<ListPictures>("list_pictures").names, ElementsAre("AIBO0001.JPG"));
  FetchPicture::Request fetch;
  fetch.name = "aibo0001";
  const auto fetched = user.call<FetchPicture>("fetch_picture", fetch);
  ASSERT_TRUE(fetched.success) << fetched.message;
  std::ifstream file(stick.path("OPEN-R/MW/DATA/P/AIBO0001.JPG"), std::ios::binary);
  const std::vector<std::uint8_t> content{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(fetched.image.data, content);
  DeletePicture::Request request;
  request.name = "aibo0001";
  const auto deleted = user.call<DeletePicture>("delete_picture", request);
  EXPECT_TRUE(deleted.success) << deleted.message;
  EXPECT_THAT(user.call<ListPictures>("list_pictures").names, SizeIs(0));
}

TEST(StickPictures, SayWhatIsWrongWithTheStick) {
  const MemoryStick stick("ALLOW_PICTURES=yes\n");
  BodyUser user("/bad_stick", {"--memory-stick", stick.path()});
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"full", "the memory stick is full"}, {"locked", "is write-protected"}, {"out", "there is no memory stick"}};
  for (const auto& [state, reason] : faults) {
    ASSERT_THAT(user.robot.type("stick " + state), HasSubstr("ok"));
    const auto refused = user.call<TakePictureOnRobot>("take_picture_on_robot");
    EXPECT_FALSE(refused.success);
    EXPECT_THAT(refused.message, HasSubstr(reason));
  }
}

TEST(Robot, RebootsAndShutsDownIfItsSettingsAllowIt) {
  const MemoryStick stick("ALLOW_SHUT_DOWN=yes\nALLOW_REBOOT=yes\n");
  BodyUser user("/power", {"--memory-stick", stick.path()});
  user.connection.clear();
  const auto rebooted = user.call<std_srvs::Trigger>("reboot");
  EXPECT_TRUE(rebooted.success) << rebooted.message;
  EXPECT_TRUE(user.waitForConnection(Connection::DISCONNECTED));
  ASSERT_TRUE(user.waitForConnection(Connection::CONNECTED));
  user.connection.clear();
  const auto shut_down = user.call<std_srvs::Trigger>("shut_down");
  EXPECT_TRUE(shut_down.success) << shut_down.message;
  EXPECT_TRUE(user.waitForConnection(Connection::DISCONNECTED));
}

// Such a server sends one sensor after the other.
TEST(TouchTopic, OfAVersion1ServerHasWhatCameBeforeAnybodyListened) {
  const BodyUser user("/touch_before", {"--protocol-version", "1"});
  ASSERT_THAT(user.robot.type("press chin"), HasSubstr("ok"));
  ASSERT_GE(TopicListener<Range>("/touch_before/range/chest").waitForCount(3).size(), 3u) << "it has sent them all";
  const auto first = TopicListener<Touch>("/touch_before/touch").waitForNext();
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->chin);
}

TEST(Body, OfARobotWithAVersion1ServerWorksToo) {
  BodyUser user("/version_1", {"--protocol-version", "1"});
  TopicListener<Range> ranges("/version_1/range/chest");
  TopicListener<Imu> accelerations("/version_1/imu/data_raw");
  TopicListener<Touch> touch("/version_1/touch");
  TopicListener<LedStates> leds("/version_1/led_states");
  EXPECT_TRUE(leds.waitFor([](const LedStates& each) { return areAll(each, NAN); })) << "it does not say what is lit";
  EXPECT_TRUE(ranges.waitForNext());
  const auto acceleration = accelerations.waitForNext();
  ASSERT_TRUE(acceleration);
  EXPECT_GT(acceleration->linear_acceleration.z, 8);
  ASSERT_THAT(user.robot.type("press chin"), HasSubstr("ok"));
  EXPECT_TRUE(touch.waitFor([](const Touch& message) { return message.chin != 0; }));
  const auto played = user.play("nod", 1);
  EXPECT_TRUE(played.success) << played.message;
  const auto missing = user.play("fly", 1);
  EXPECT_FALSE(missing.success);
  EXPECT_THAT(user.driver.output(), Not(HasSubstr("ends early"))) << "no version 1 server says how a motion ends";
  EXPECT_FALSE(user.call<ListMotions>("list_motions").success) << "no version 1 server lists them";
  const auto taken = user.call<TakePictureOnRobot>("take_picture_on_robot");
  EXPECT_FALSE(taken.success);
  EXPECT_THAT(taken.message, HasSubstr("version 1"));
}

}  // namespace
