// Recordings, played again by aibo_playback.

#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/RobotState.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <csignal>

#include "ros/joint_user.h"
#include "support/temporary_folder.h"
#include "tools/playback/recording.h"

namespace {

using aibo_driver::Connection;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::TopicListener;

const ros::Time kBegin(1'032'146'825, 900'000'000);
constexpr double kSpeed = 0.1;   // m/s
constexpr double kPeriod = 0.1;  // s, between two measurements

/// A bag of a robot that walks ahead.
class WalkBag {
 public:
  WalkBag(const std::string& path, std::string name_space, const std::string& frame_prefix = "")
      : bag_(path, rosbag::bagmode::Write), name_space_(std::move(name_space)), frame_prefix_(frame_prefix) {}

  void connect(std::uint8_t state = Connection::CONNECTED, const std::string& text = "connected to anna") {
    Connection connection;
    connection.state = state;
    connection.text = text;
    connection.robot = "ERS-7";
    write("connection", connection, "1");
  }

  /// As a driver of another version, which has started twice.
  void connectAsOfOld() {
    const std::string md5sum(32, '1');
    write("connection", Connection(), "1", md5sum);
    write("link_quality", aibo_driver::LinkQuality(), "0", md5sum);
    write("link_quality", aibo_driver::LinkQuality(), "1", md5sum);
  }

  void report(const std::string& stopped_by) {
    aibo_driver::RobotState state;
    state.stopped_by = stopped_by;
    write("robot_state", state, "1");
  }

  void walk(double seconds) {
    for (double end = time_ + seconds; time_ < end - kPeriod / 2; time_ += kPeriod) {
      write("imu/data_raw", imu());
      write("joint_states", joints());
      write("joint_command", joints(0.4));
      write("odom", odom());
      write("camera/image_raw/compressed", headed<sensor_msgs::CompressedImage>("camera_optical_frame"));
      write("camera/camera_info", headed<sensor_msgs::CameraInfo>("camera_optical_frame"));
      write("cmd_vel", geometry_msgs::Twist());
    }
  }

 private:
  template <typename Message>
  Message headed(const std::string& frame) const {
    Message message;
    message.header.stamp = kBegin + ros::Duration(time_) - ros::Duration(0.02);  // it took time to arrive
    message.header.frame_id = frame_prefix_ + frame;
    return message;
  }

  sensor_msgs::Imu imu() const {
    auto imu = headed<sensor_msgs::Imu>("imu_link");
    imu.linear_acceleration.z = 9.81;
    return imu;
  }

  sensor_msgs::JointState joints(double position = 0) const {
    auto joints = headed<sensor_msgs::JointState>("");
    for (const char* leg : {"left_front_", "left_hind_", "right_front_", "right_hind_"}) {
      for (const char* joint : {"rotator", "elevator", "knee"}) {
        joints.name.push_back(std::string(leg) + joint);
        joints.position.push_back(position);
      }
    }
    return joints;
  }

  nav_msgs::Odometry odom() const {
    auto odom = headed<nav_msgs::Odometry>("odom");
    odom.pose.pose.position.x = kSpeed * time_;
    odom.pose.pose.orientation.w = 1;
    return odom;
  }

  template <typename Message>
  void write(const std::string& topic, const Message& message, const std::string& latching = "0",
             const std::string& md5sum = ros::message_traits::MD5Sum<Message>::value()) {
    bag_.write(name_space_ + "/" + topic, kBegin + ros::Duration(time_), message,
               boost::make_shared<ros::M_string>(
                   ros::M_string{{"type", ros::message_traits::datatype(message)},
                                 {"md5sum", md5sum},
                                 {"message_definition", ros::message_traits::definition(message)},
                                 {"latching", latching}}));
  }

  rosbag::Bag bag_;
  std::string name_space_;
  std::string frame_prefix_;
  double time_ = 0;
};

class PlaybackTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name).string(); }

  std::string recordAWalk(double seconds = 3) const {
    WalkBag bag(path("walk.bag"), "/aibo");
    bag.connect();
    bag.report("/anna");
    bag.walk(seconds);
    return path("walk.bag");
  }

  static std::vector<std::string> command(const std::string& bag, const std::string& name_space,
                                          std::vector<std::string> parameters) {
    parameters.insert(parameters.begin(), {AIBO_PLAYBACK, "__ns:=" + name_space, "_bag:=" + bag});
    return parameters;
  }

  // What it says when it cannot play.
  std::string complaintAbout(const std::string& bag, const std::vector<std::string>& parameters = {}) {
    // In a namespace of its own, because the master keeps parameters.
    Process playback(command(bag, "/complaints" + std::to_string(++complaints_), parameters));
    EXPECT_EQ(playback.waitForExit(kSafetyNet), EXIT_FAILURE);
    return playback.output();
  }

 private:
  test_support::TemporaryFolder folder_;
  int complaints_ = 0;
};

TEST_F(PlaybackTest, LooksAsIfTheRobotWereHere) {
  TopicListener<sensor_msgs::JointState> joints("/walks/joint_states");
  TopicListener<sensor_msgs::CompressedImage> pictures("/walks/camera/image_raw/compressed");
  TopicListener<tf2_msgs::TFMessage> tf("/walks/tf");
  TopicListener<Connection> connection("/walks/connection");
  Process playback(command(recordAWalk(), "/walks", {}));
  EXPECT_EQ(playback.waitForExit(kSafetyNet), EXIT_SUCCESS) << playback.output();

  // All has arrived, except perhaps the first messages, before all of these listeners were connected.
  const auto played = joints.waitForCount(0);
  ASSERT_GT(played.size(), 20u);
  const auto& end = played.back()->header.stamp;
  EXPECT_NEAR((end - played[0]->header.stamp).toSec(), kPeriod * static_cast<double>(played.size() - 1), 1e-6);
  EXPECT_LT(std::abs((ros::Time::now() - end).toSec()), 60);
  ASSERT_GT(pictures.count(), 20u);

  const auto last = tf.waitFor([&](const tf2_msgs::TFMessage& message) {
    return !message.transforms.empty() && message.transforms[0].header.stamp == end;
  });
  ASSERT_TRUE(last && last->transforms.size() == 2);
  EXPECT_EQ(last->transforms[0].child_frame_id, "base_footprint");
  EXPECT_NEAR(last->transforms[0].transform.translation.x, 2.8 * kSpeed, 1e-6) << "the odom before these joints";
  EXPECT_EQ(last->transforms[1].child_frame_id, "base_link");
  EXPECT_GT(last->transforms[1].transform.translation.z, 0.05);
  for (const auto& each : tf.waitForCount(0)) {
    EXPECT_EQ(each->transforms.at(1).transform, last->transforms[1].transform) << "commands are no measurements";
  }

  EXPECT_TRUE(connection.waitFor([](const Connection& message) {
    return message.state == Connection::PLAYBACK && message.robot == "ERS-7" &&
           message.text == "playback of walk.bag, 0:02 of 0:02";
  }));
}

TEST_F(PlaybackTest, BeginsWhenSomebodyWatchesAtTheTimeThatIsAskedFor) {
  {
    WalkBag bag(path("left.bag"), "/team/left", "left/");
    bag.connect();
    bag.report("/anna");
    bag.walk(1);
    bag.report("/bert");
    bag.walk(2);
  }
  TopicListener<nav_msgs::Odometry> odom("/other/odom");
  TopicListener<aibo_driver::RobotState> state("/other/robot_state");
  TopicListener<tf2_msgs::TFMessage> tf("/other/tf");
  Process playback(command(path("left.bag"), "/other", {"_start:=2", "_frame_prefix:=left", "_wait:=3600"}));
  EXPECT_EQ(playback.waitForExit(std::chrono::milliseconds(1500)), std::nullopt) << "nobody watches yet";
  const TopicListener<Connection> connection("/other/connection");
  EXPECT_EQ(playback.waitForExit(kSafetyNet), EXIT_SUCCESS) << playback.output();
  EXPECT_NEAR(odom.waitForCount(1).front()->pose.pose.position.x, 2 * kSpeed, 1e-6);
  EXPECT_EQ(state.waitForCount(1).front()->stopped_by, "/bert") << "what was latched then";
  EXPECT_TRUE(tf.waitFor([](const tf2_msgs::TFMessage& message) {
    return message.transforms.size() == 2 && message.transforms[1].child_frame_id == "left/base_link";
  }));
}

TEST_F(PlaybackTest, PausesAndRepeatsAtItsRate) {
  TopicListener<nav_msgs::Odometry> odom("/again/odom");
  TopicListener<Connection> connection("/again/connection");
  Process playback(command(recordAWalk(1), "/again", {"_loop:=true", "_rate:=2"}));
  const auto pause = [](bool pauses) {
    std_srvs::SetBool call;
    call.request.data = static_cast<std::uint8_t>(pauses);
    const std::string service = "/again/aibo_playback/pause_playback";
    EXPECT_TRUE(ros::service::waitForService(service, ros::Duration(60)) && ros::service::call(service, call));
    EXPECT_TRUE(call.response.success) << call.response.message;
  };
  ASSERT_GE(odom.waitForCount(15).size(), 15U) << "a second round";
  pause(true);
  EXPECT_TRUE(connection.waitFor(
      [](const Connection& message) { return message.text.find("of 0:00, paused") != std::string::npos; }));
  EXPECT_FALSE(odom.waitForNext(std::chrono::seconds(1)) && odom.waitForNext(std::chrono::seconds(1)))
      << "one may have been under way";
  const std::size_t played = odom.count();
  const ros::Time resumed = ros::Time::now();
  pause(false);
  const auto all = odom.waitForCount(played + 1);
  ASSERT_GT(all.size(), played);
  EXPECT_GT(all[played]->header.stamp + ros::Duration(0.5), resumed) << "the time of the pause is left out";
  EXPECT_NEAR((all[1]->header.stamp - all[0]->header.stamp).toSec(), kPeriod / 2, 1e-6) << "twice as fast";
}

TEST_F(PlaybackTest, WhatCannotBePlayedIsExplained) {
  rosbag::Bag(path("empty.bag"), rosbag::bagmode::Write).close();
  {
    rosbag::Bag other(path("other.bag"), rosbag::bagmode::Write);
    other.write("/turtle/cmd_vel", kBegin, geometry_msgs::Twist());
    rosbag::Bag both(path("both.bag"), rosbag::bagmode::Write);
    both.write("/left/joint_states", kBegin, sensor_msgs::JointState());
    both.write("/team/right/connection", kBegin, Connection());
  }
  WalkBag(path("left.bag"), "/left", "left/").walk(1);
  const std::string whole = recordAWalk(60);
  std::filesystem::copy_file(whole, path("cut.bag"));
  std::filesystem::resize_file(path("cut.bag"), std::filesystem::file_size(whole) / 2);
  WalkBag unfinished(path("night.bag.active"), "/aibo");
  unfinished.walk(60);
  std::filesystem::copy_file(path("night.bag.active"), path("night.bag"));
  const std::tuple<const char*, std::vector<std::string>, std::string> rows[] = {
      {"none.bag", {}, "none.bag cannot be read as a bag: Error opening file"},
      {"cut.bag", {}, "cut.bag cannot be read as a bag"},
      {"night.bag", {}, "Repair it with: rosbag reindex " + path("night.bag")},
      {"empty.bag", {}, "empty.bag is empty"},
      {"other.bag", {}, "has no robot, but only the topics /turtle/cmd_vel"},
      {"both.bag", {}, "several robots: /left, /team/right. Choose one, such as recorded_ns:=left."},
      {"left.bag", {}, "play it with frame_prefix:=left"},
      {"left.bag", {"_recorded_ns:=/right"}, "no robot in /right, but in /left"},
      {"left.bag", {"_frame_prefix:=left", "_start:=5"}, "start is 5"},
      {"left.bag", {"_rate:=nan"}, "rate is nan; it must be a number, 0.01..100."},
      {"left.bag", {"_loop:=1"}, "loop is 1; it must be true or false"},
      {"walk.bag", {"_frame_prefix:=left"}, "play it with frame_prefix:=none."},
  };
  for (const auto& [bag, parameters, complaint] : rows) {
    EXPECT_THAT(complaintAbout(path(bag), parameters), testing::HasSubstr(complaint)) << bag;
  }
}

TEST_F(PlaybackTest, ARecordingHasTheTopicsOfOneRobotAndNoneThatMovesOne) {
  {
    rosbag::Bag bag(path("two.bag"), rosbag::bagmode::Write);
    for (const char* topic : {"/left/camera/image_raw", "/left/camera/image_raw/compressed", "/left/joint_states",
                              "/lefty/joint_states", "/left/cmd_vel", "/left/joint_command", "/right/connection",
                              "/right/camera/image_raw", "/diagnostics", "/tf"}) {
      bag.write(topic, kBegin, geometry_msgs::Twist());
    }
  }
  const auto topics = [this](const std::string& robot) {
    std::vector<std::string> names;
    aibo_driver::tools::Recording recording(path("two.bag"), robot);
    for (const rosbag::ConnectionInfo* connection : recording.messages().getConnections()) {
      names.push_back(connection->topic);
    }
    return names;
  };
  EXPECT_THAT(topics("/left"), ::testing::UnorderedElementsAre("/diagnostics", "/left/joint_states",
                                                               "/left/camera/image_raw/compressed"));
  EXPECT_THAT(topics("/right"),
              ::testing::UnorderedElementsAre("/diagnostics", "/right/connection", "/right/camera/image_raw"))
      << "it has no other pictures";
  EXPECT_EQ(aibo_driver::tools::Recording(path("two.bag"), "/left").topics().at("/diagnostics"), "diagnostics")
      << "in the namespace of the playback";
}

TEST_F(PlaybackTest, TopicsOfAnotherVersionAreNamedOnceAndLeftOut) {
  TopicListener<aibo_driver::LinkQuality> link("/newer/link_quality");
  TopicListener<nav_msgs::Odometry> odom("/newer/odom");
  {
    WalkBag bag(path("old.bag"), "/aibo");
    bag.connectAsOfOld();
    bag.walk(1);
  }
  Process playback(command(path("old.bag"), "/newer", {}));
  EXPECT_EQ(playback.waitForExit(kSafetyNet), EXIT_SUCCESS);
  const std::string output = playback.output();
  const std::string what = "old.bag is from another version of aibo_driver";
  EXPECT_THAT(output, testing::HasSubstr("left out: connection, link_quality."));
  EXPECT_EQ(output.find(what), output.rfind(what)) << output;
  EXPECT_THAT(output, Not(testing::HasSubstr("wants topic"))) << "roscpp's complaint for each subscriber";
  EXPECT_FALSE(odom.waitForCount(1).empty());
}

TEST_F(PlaybackTest, DamageIsSaidWhereItIs) {
  const std::string whole = recordAWalk(60);
  {
    std::fstream file(whole, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(std::filesystem::file_size(whole) / 4));
    file << std::string(20'000, '\xff');
  }
  Process playback(command(whole, "/damaged", {"_wait:=0", "_rate:=100"}));
  EXPECT_EQ(playback.waitForExit(kSafetyNet), EXIT_FAILURE);
  EXPECT_THAT(playback.output(), testing::HasSubstr("walk.bag is damaged at 0:"));
}

// So a robot that runs while `rosbag play` plays it does not obey it.
TEST_F(PlaybackTest, ABagOfRecordLaunchHasNoNameThatARobotKnows) {
  test_support::JointUser user("/lives");
  TopicListener<nav_msgs::Odometry> odom("/lives/odom");
  Process record({"roslaunch", RECORD_LAUNCH, "ns:=lives", "prefix:=" + path("walk")});
  const ros::Publisher& steering = user.publisherOf<geometry_msgs::Twist>("cmd_vel");
  EXPECT_TRUE(user.becomesTrue([&steering] { return steering.getNumSubscribers() == 2; }));
  EXPECT_TRUE(user.becomesTrue([] {
    Process node({"rosnode", "info", "/lives/record"});
    node.waitForExit(kSafetyNet);
    return node.output().find("topic: /lives/odom") != std::string::npos;  // in the list of its connections
  }));
  user.steer(0.1);
  EXPECT_TRUE(odom.waitFor([](const nav_msgs::Odometry& each) { return each.pose.pose.position.x > 0.05; }));
  user.letGo();
  record.signal(SIGINT);
  ASSERT_TRUE(record.waitForExit(kSafetyNet)) << record.output();
  std::filesystem::rename(*std::filesystem::directory_iterator(path("")), path("walk.bag"));

  rosbag::Bag bag(path("walk.bag"));
  const auto playable = aibo_driver::tools::Recording(path("walk.bag"), "").topics();
  std::set<std::string> inputs;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
    EXPECT_EQ(connection->topic.rfind("/recorded/", 0), 0U) << connection->topic;
    if (playable.count(connection->topic) == 0) {
      inputs.insert(connection->topic);
    }
  }
  EXPECT_EQ(inputs, std::set<std::string>{"/recorded/lives/cmd_vel"});
}

TEST_F(PlaybackTest, IsNotPlayedWhereADriverRuns) {
  const ros::Publisher driver = ros::NodeHandle("/drives").advertise<Connection>("connection", 1);
  Process playback(command(recordAWalk(), "/drives", {}));
  EXPECT_EQ(playback.waitForExit(kSafetyNet), EXIT_FAILURE);
  EXPECT_THAT(playback.output(), testing::HasSubstr("There is a driver in the namespace /drives already"));
}

}  // namespace
