// The answers of the driver's services.

#include <aibo_driver/TakePicture.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <std_msgs/Bool.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <string>
#include <vector>

#include "aibo_driver/Connection.h"
#include "support/proxy/recording_proxy.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"
#include "support/temporary_folder.h"

namespace {

using aibo_driver::Connection;
using aibo_driver::TakePicture;
using test_support::DriverProcess;
using test_support::kSafetyNet;
using test_support::RecordingProxy;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

TakePicture::Response takePicture(const std::string& name_space, std::uint8_t quality,
                                  const std::string& save_to = "") {
  TakePicture service;
  service.request.quality = quality;
  service.request.save_to = save_to;
  EXPECT_TRUE(ros::service::call(name_space + "/take_picture", service)) << "the call itself failed";
  return service.response;
}

std_srvs::SetBool::Response setStreaming(const std::string& name_space, bool on) {
  std_srvs::SetBool service;
  service.request.data = on;
  EXPECT_TRUE(ros::service::call(name_space + "/set_streaming", service)) << "the call itself failed";
  return service.response;
}

std_srvs::Trigger::Response toggleStreaming(const std::string& name_space) {
  std_srvs::Trigger service;
  EXPECT_TRUE(ros::service::call(name_space + "/toggle_streaming", service)) << "the call itself failed";
  return service.response;
}

// Robot, proxy and driver, connected with each other.
struct ConnectedDriver {
  explicit ConnectedDriver(const std::string& name_space, const std::vector<std::string>& parameters = {},
                           const std::vector<std::string>& robot_options = {})
      : robot(robot_options),
        proxy(robot.port()),
        streaming(name_space + "/streaming"),
        connection(name_space + "/connection"),
        pictures(name_space + "/camera/image_raw/compressed"),
        driver(name_space, proxy.port(), parameters) {
    EXPECT_TRUE(waitForConnection(Connection::CONNECTED));
  }

  bool waitForConnection(std::uint8_t state) {
    return connection.waitFor([state](const Connection& message) { return message.state == state; }) != nullptr;
  }

  bool waitForStreaming(bool on) {
    return streaming.waitFor([on](const std_msgs::Bool& message) { return static_cast<bool>(message.data) == on; }) !=
           nullptr;
  }

  // The qualities in the driver's requests of this kind.
  std::vector<int> qualities(const std::string& kind) const {
    std::vector<int> result;
    for (const test_support::Request& request : proxy.requestsFromDriver(kind)) {
      result.push_back(request.id);
    }
    return result;
  }

  SimulatedRobot robot;
  RecordingProxy proxy;
  TopicListener<std_msgs::Bool> streaming;
  TopicListener<Connection> connection;
  TopicListener<sensor_msgs::CompressedImage> pictures;
  DriverProcess driver;
};

std::vector<std::uint8_t> readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(TakePicture, WithoutAStreamAnswersAPictureThatWasTakenAfterTheCall) {
  ConnectedDriver connected("/still", {"_stream_on_start:=false"});
  const ros::Time before = ros::Time::now();
  const TakePicture::Response answer = takePicture("/still", 0);
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_GT(answer.image.header.stamp, before);
  EXPECT_EQ(answer.image.header.frame_id, "camera_optical_frame");
  EXPECT_THAT(answer.message, HasSubstr("at quality 85"));
  EXPECT_THAT(connected.proxy.picturesFromRobot(), Contains(answer.image.data));
  EXPECT_THAT(connected.qualities("F"), ElementsAre(85));
}

TEST(TakePicture, UsesTheQualityAskedFor) {
  ConnectedDriver connected("/quality", {"_stream_on_start:=false", "_jpeg_quality:=50"});
  const std::size_t of_driver = takePicture("/quality", 0).image.data.size();
  const std::size_t low = takePicture("/quality", 10).image.data.size();
  const std::size_t high = takePicture("/quality", 100).image.data.size();
  const TakePicture::Response above = takePicture("/quality", 255);
  EXPECT_LT(low, of_driver);
  EXPECT_LT(of_driver, high);
  ASSERT_TRUE(above.success) << above.message;
  EXPECT_THAT(above.message, HasSubstr("quality 100"));
  EXPECT_THAT(connected.qualities("F"), ElementsAre(50, 10, 100, 100));
}

TEST(TakePicture, IsPublishedOnTheCameraTopicsToo) {
  ConnectedDriver connected("/published", {"_stream_on_start:=false"});
  TopicListener<sensor_msgs::CameraInfo> camera_infos("/published/camera/camera_info");
  // A picture that is taken before the subscription is complete does not reach it: then take another one.
  TakePicture::Response answer;
  const auto same = [&answer](const auto& message) { return message.header.stamp == answer.image.header.stamp; };
  bool published = false;
  for (int i = 0; i < 100 && !published; ++i) {
    answer = takePicture("/published", 0);
    const std::chrono::milliseconds patience(100);
    published = connected.pictures.waitFor(same, patience) && camera_infos.waitFor(same, patience);
  }
  EXPECT_TRUE(published);
}

TEST(TakePicture, DuringTheStreamHasItsOwnQuality) {
  ConnectedDriver connected("/own");
  ASSERT_FALSE(connected.pictures.waitForCount(1).empty());
  const TakePicture::Response answer = takePicture("/own", 20);
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_THAT(answer.message, HasSubstr("at quality 20"));
  EXPECT_THAT(connected.qualities("F"), ElementsAre(20));
}

TEST(TakePicture, DuringTheStreamOfAnOldServerAnswersTheStreamsNextPictureAndSaysSo) {
  ConnectedDriver connected("/during", {}, {"--protocol-version", "1"});
  ASSERT_FALSE(connected.pictures.waitForCount(1).empty());
  const ros::Time before = ros::Time::now();
  const TakePicture::Response answer = takePicture("/during", 20);
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_GT(answer.image.header.stamp, before);
  EXPECT_THAT(answer.message, HasSubstr("from the running stream"));
  EXPECT_THAT(answer.message, HasSubstr("quality 85"));
  const auto published = connected.pictures.waitFor(
      [&answer](const auto& message) { return message.header.stamp == answer.image.header.stamp; });
  ASSERT_TRUE(published);
  EXPECT_EQ(published->data, answer.image.data);
  EXPECT_THAT(connected.proxy.bytesFromDriver(), Not(HasSubstr("F")));
}

TEST(TakePicture, SavesTheSameBytes) {
  namespace fs = std::filesystem;
  const test_support::TemporaryFolder folder;
  const fs::path file = fs::canonical(folder.path()) / "picture.jpg";
  ConnectedDriver connected("/saved", {"_picture_folder:=" + folder.path().string()});
  const TakePicture::Response answer = takePicture("/saved", 0, "picture.jpg");
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_THAT(answer.message, HasSubstr("Saved to '" + file.string() + "'"));
  EXPECT_EQ(readFile(file), answer.image.data);
}

TEST(TakePicture, WithTheRobotGoneSaysWhyAndWhatToCheck) {
  ConnectedDriver connected("/gone", {"_take_picture_timeout:=20"});
  connected.connection.clear();
  connected.robot.kill();
  ASSERT_TRUE(connected.waitForConnection(Connection::DISCONNECTED));
  const auto begin = std::chrono::steady_clock::now();
  const TakePicture::Response answer = takePicture("/gone", 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("There is no picture"));
  EXPECT_THAT(answer.message, HasSubstr(std::to_string(connected.proxy.port())));
  EXPECT_TRUE(answer.image.data.empty());
}

TEST(TakePicture, FromASilentRobotEndsWithItsTimeoutAndDelaysNobodyElse) {
  ConnectedDriver connected("/silent", {"_stream_on_start:=false", "_take_picture_timeout:=4", "_read_timeout:=60"});
  connected.proxy.setMute(true);
  std::future<TakePicture::Response> waiting = std::async(std::launch::async, [] { return takePicture("/silent", 0); });
  ASSERT_TRUE(connected.proxy.waitForRequest("F", kSafetyNet));
  EXPECT_TRUE(setStreaming("/silent", false).success);
  EXPECT_EQ(waiting.wait_for(std::chrono::seconds(0)), std::future_status::timeout) << "set_streaming had to wait";
  ASSERT_EQ(waiting.wait_for(kSafetyNet), std::future_status::ready);
  const TakePicture::Response answer = waiting.get();
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("There is no picture"));
}

TEST(SetStreaming, TwiceTheSameSendsTheRobotNothingTheSecondTime) {
  ConnectedDriver connected("/twice", {"_stream_on_start:=false"});
  EXPECT_TRUE(setStreaming("/twice", true).success);
  ASSERT_TRUE(connected.waitForStreaming(true));
  EXPECT_TRUE(setStreaming("/twice", true).success);
  connected.pictures.clear();
  ASSERT_GE(connected.pictures.waitForCount(10).size(), 10u);
  EXPECT_THAT(connected.qualities("W"), ElementsAre(85));

  connected.streaming.clear();
  EXPECT_TRUE(setStreaming("/twice", false).success);
  ASSERT_TRUE(connected.waitForStreaming(false));
  EXPECT_TRUE(setStreaming("/twice", false).success);
  ASSERT_TRUE(takePicture("/twice", 0).success);
  EXPECT_THAT(connected.qualities("W"), SizeIs(2));
  EXPECT_THAT(connected.qualities("F"), SizeIs(1));
}

TEST(SetStreaming, WithTheRobotGoneSaysSoAndStreamsWhenItIsBack) {
  ConnectedDriver connected("/wish", {"_stream_on_start:=false"});
  connected.connection.clear();
  connected.robot.kill();
  ASSERT_TRUE(connected.waitForConnection(Connection::DISCONNECTED));
  const std_srvs::SetBool::Response answer = setStreaming("/wish", true);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("the robot does not answer yet"));
  connected.robot.restart();
  EXPECT_FALSE(connected.pictures.waitForCount(1).empty());
}

TEST(ToggleStreaming, ReportsTheNewState) {
  ConnectedDriver connected("/toggle");
  ASSERT_TRUE(connected.waitForStreaming(true));
  const std_srvs::Trigger::Response off = toggleStreaming("/toggle");
  EXPECT_TRUE(off.success);
  EXPECT_THAT(off.message, HasSubstr("off"));
  EXPECT_TRUE(connected.waitForStreaming(false));
  connected.pictures.clear();
  const std_srvs::Trigger::Response on = toggleStreaming("/toggle");
  EXPECT_TRUE(on.success);
  EXPECT_THAT(on.message, HasSubstr("on"));
  EXPECT_FALSE(connected.pictures.waitForCount(1).empty());
}

}  // namespace
