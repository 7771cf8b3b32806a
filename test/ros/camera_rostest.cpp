// What the driver publishes on the camera's topics.

#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "support/good_calibration.h"
#include "support/proxy/recording_proxy.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"
#include "support/temporary_folder.h"

namespace {

using sensor_msgs::CameraInfo;
using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::goodCalibration;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::RecordingProxy;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using CompressedListener = TopicListener<sensor_msgs::CompressedImage>;
using CameraInfoListener = TopicListener<sensor_msgs::CameraInfo>;
using ImageListener = TopicListener<sensor_msgs::Image>;

constexpr std::size_t kEnough = 30;  // pictures: about a second of them

TEST(Camera, PublishesTheRobotsOwnPicturesByteForByteOnceAndInOrder) {
  SimulatedRobot robot;
  RecordingProxy proxy(robot.port());
  CompressedListener pictures("/bytes/camera/image_raw/compressed");
  DriverProcess driver("/bytes", proxy.port(), {test_support::kByTcp});
  const auto published = pictures.waitForCount(kEnough);
  ASSERT_GE(published.size(), kEnough);
  const std::vector<std::vector<std::uint8_t>> sent = proxy.picturesFromRobot();
  auto next = sent.begin();
  for (const sensor_msgs::CompressedImageConstPtr& picture : published) {
    const auto found = std::find(next, sent.end(), picture->data);
    ASSERT_NE(found, sent.end()) << "a picture that the robot did not send, or not in this order";
    next = found + 1;
    EXPECT_EQ(picture->format, "bgr8; jpeg compressed bgr8");
  }
}

TEST(Camera, AllMessagesOfAPictureHaveTheSameHeaderAndStampsIncrease) {
  SimulatedRobot robot;
  CompressedListener pictures("/stamps/camera/image_raw/compressed");
  CameraInfoListener camera_infos("/stamps/camera/camera_info");
  ImageListener images("/stamps/camera/image_raw");
  DriverProcess driver("/stamps", robot.port(), {"_frame_id:=aibo_eye", "_frame_prefix:=left", "_resolution:=104x80"});
  ASSERT_TRUE(images.waitForNext());
  images.clear();
  const auto decoded = images.waitForCount(kEnough);
  ASSERT_GE(decoded.size(), kEnough);
  ros::Time last;
  for (const sensor_msgs::ImageConstPtr& image : decoded) {
    EXPECT_GT(image->header.stamp, last);
    last = image->header.stamp;
    EXPECT_EQ(image->header.frame_id, "left/aibo_eye");
    EXPECT_EQ(image->encoding, "bgr8");
    EXPECT_EQ(image->data.size(), 3u * 104u * 80u);
    const auto same_header = [&image](const auto& message) {
      return message.header.stamp == image->header.stamp && message.header.frame_id == image->header.frame_id;
    };
    EXPECT_TRUE(pictures.waitFor(same_header));
    EXPECT_TRUE(camera_infos.waitFor(same_header));
  }
}

TEST(Camera, AllTopicsOfTheImageAreRemappedWithIt) {
  SimulatedRobot robot;
  ImageListener images("/remapped/eye/picture");
  CompressedListener pictures("/remapped/eye/picture/compressed");
  CameraInfoListener camera_infos("/remapped/eye/camera_info");
  DriverProcess driver("/remapped", robot.port(), {"camera/image_raw:=eye/picture"});
  EXPECT_FALSE(images.waitForCount(1).empty());
  EXPECT_FALSE(pictures.waitForCount(1).empty());
  EXPECT_FALSE(camera_infos.waitForCount(1).empty());
}

TEST(Camera, ImagesAreDecodedOnlyWhileTheyHaveSubscribers) {
  SimulatedRobot robot;
  CompressedListener pictures("/lazy/camera/image_raw/compressed");
  DiagnosticsListener diagnostics;
  DriverProcess driver("/lazy", robot.port());
  const auto decoded = [](const diagnostic_msgs::DiagnosticStatus& status) {
    return DiagnosticsListener::value(status, "images decoded");
  };
  const std::string stream = "lazy/aibo_driver: stream";

  ASSERT_GE(pictures.waitForCount(kEnough).size(), kEnough);
  EXPECT_EQ(decoded(diagnostics.waitForNext(stream)), "0");
  {
    ImageListener images("/lazy/camera/image_raw");
    ASSERT_GE(images.waitForCount(3).size(), 3u);
  }
  // The driver learns of the unsubscription a little later than we do.
  std::string before;
  std::string after = "0";
  for (int i = 0; i < 30 && after != before; ++i) {
    before = after;
    pictures.clear();
    ASSERT_GE(pictures.waitForCount(kEnough).size(), kEnough);
    after = decoded(diagnostics.waitForNext(stream));
  }
  EXPECT_EQ(after, before);
  EXPECT_NE(after, "0");
}

TEST(Camera, NobodyElsePublishesJpegsIfImageTransportHasACompressedPlugin) {
  SimulatedRobot robot;
  CompressedListener pictures("/plugin/camera/image_raw/compressed");
  ImageListener images("/plugin/camera/image_raw");
  const char* packages = std::getenv("ROS_PACKAGE_PATH");
  ASSERT_NE(packages, nullptr);
  const std::string list = "/plugin/camera/image_raw/disable_pub_plugins";
  ros::param::set(list, std::vector<std::string>{"image_transport/theora", "image_transport/compressed"});
  DriverProcess driver("/plugin", robot.port(), {},
                       {{"ROS_PACKAGE_PATH", std::string(COMPRESSED_PLUGIN_PACKAGE) + ":" + packages}});
  ASSERT_FALSE(images.waitForCount(kEnough).empty());
  std::vector<std::string> disabled;
  ros::param::get(list, disabled);
  EXPECT_THAT(disabled,
              ElementsAre("image_transport/theora", "image_transport/compressed", "image_transport/compressedDepth"));
  for (const sensor_msgs::CompressedImageConstPtr& picture : pictures.waitForCount(kEnough)) {
    ASSERT_EQ(picture->format, "bgr8; jpeg compressed bgr8");
  }
}

std::string contentOf(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// A driver that has its calibration in a file of its own.
class CalibrationUser {
 public:
  explicit CalibrationUser(const std::string& name_space, const std::vector<std::string>& parameters = {})
      : name_space_(name_space), camera_infos_(name_space + "/camera/camera_info"), parameters_(parameters) {
    parameters_.push_back("_camera_info_url:=file://" + file());
    restart();
  }

  std::string file() const { return folder_.path("camera.yaml").string(); }
  Process& driver() { return *driver_; }

  void restart() {
    driver_.reset();
    driver_ = std::make_unique<DriverProcess>(name_space_, robot_.port(), parameters_);
  }

  // What is published with the next picture that is taken; a message without numbers if nothing is.
  CameraInfo next() {
    const auto is_new = [now = ros::Time::now()](const CameraInfo& info) { return info.header.stamp > now; };
    const auto info = camera_infos_.waitFor(is_new);
    return info ? *info : CameraInfo();
  }

  sensor_msgs::SetCameraInfo::Response set(const CameraInfo& info) {
    sensor_msgs::SetCameraInfo call;
    call.request.camera_info = info;
    const std::string service = name_space_ + "/camera/set_camera_info";
    EXPECT_TRUE(ros::service::waitForService(service, ros::Duration(60)));
    EXPECT_TRUE(ros::service::call(service, call));
    return call.response;
  }

 private:
  const std::string name_space_;
  test_support::TemporaryFolder folder_;
  SimulatedRobot robot_;
  CameraInfoListener camera_infos_;
  std::vector<std::string> parameters_;
  std::unique_ptr<DriverProcess> driver_;
};

TEST(Calibration, IsTheNominalOneUntilOneIsStoredAndTheLogSaysWhich) {
  CalibrationUser user("/calibration");
  const CameraInfo nominal = user.next();
  EXPECT_EQ(nominal.width, 208u);
  EXPECT_EQ(nominal.height, 160u);
  EXPECT_NEAR(nominal.K[0], 191.9, 0.1);
  EXPECT_NEAR(nominal.P[0], 191.9, 0.1);
  EXPECT_NO_THROW(user.driver().waitForOutput("camera_info holds the nominal calibration", kSafetyNet));

  const auto answer = user.set(goodCalibration());
  EXPECT_TRUE(answer.success) << answer.status_message;
  EXPECT_THAT(answer.status_message, HasSubstr(user.file()));
  EXPECT_NO_THROW(user.driver().waitForOutput("208x160 is stored in " + user.file(), kSafetyNet));
  EXPECT_EQ(user.next().K, goodCalibration().K);

  user.restart();
  EXPECT_EQ(user.next().K, goodCalibration().K);
  EXPECT_NO_THROW(user.driver().waitForOutput("calibration is that in " + user.file(), kSafetyNet));
}

TEST(Calibration, ThatCannotBelongToTheCameraIsRefusedAndNotPublished) {
  const std::tuple<const char*, const char*, const char*> rows[] = {
      // in the file of a good one, what is replaced by what, and what the log says
      {"208", "200", "is for pictures of 200x160, but the robot sends 208x160"},
      {"plumb_bob", "plumb", "is left out: the distortion model is not"},
  };
  for (const auto& [good, wrong, complaint] : rows) {
    CalibrationUser user("/calibration_file");
    ASSERT_TRUE(user.set(goodCalibration()).success);
    std::string text = contentOf(user.file());
    text.replace(text.find(good), std::string(good).size(), wrong);
    std::ofstream(user.file()) << text;
    user.restart();
    EXPECT_NEAR(user.next().K[0], 191.9, 0.1) << "the nominal one";
    EXPECT_NO_THROW(user.driver().waitForOutput(complaint, kSafetyNet));
  }
  CalibrationUser user("/calibration_service");
  ASSERT_EQ(user.next().width, 208u);
  CameraInfo info = goodCalibration();
  info.width = 200;
  const auto refused = user.set(info);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.status_message, HasSubstr("for pictures of 200x160, but the robot sends 208x160"));
  EXPECT_NEAR(user.next().K[0], 191.9, 0.1);
}

TEST(Camera, OnDemandTheRobotStreamsOnlyWhileACameraTopicHasASubscriber) {
  SimulatedRobot robot;
  TopicListener<std_msgs::Bool> streaming("/demand/streaming");
  DiagnosticsListener diagnostics;
  DriverProcess driver("/demand", robot.port(), {"_stream_on_demand:=true"});
  const auto becomes = [&streaming](bool on) {
    return streaming.waitFor([on](const std_msgs::Bool& message) { return static_cast<bool>(message.data) == on; });
  };
  const auto idle = diagnostics.waitFor("demand/aibo_driver: stream", [](const auto& status) {
    return status.message.find("idle: no camera topic has a subscriber") == 0;
  });
  EXPECT_EQ(idle.level, diagnostic_msgs::DiagnosticStatus::OK);
  const auto is_heard = [&](const auto& listen) {
    streaming.clear();
    {
      const auto listener = listen();
      EXPECT_TRUE(becomes(true));
      streaming.clear();
    }
    EXPECT_TRUE(becomes(false));
  };
  const std::string camera = "/demand/camera/";
  is_heard([&] { return std::make_unique<ImageListener>(camera + "image_raw"); });
  is_heard([&] { return std::make_unique<CompressedListener>(camera + "image_raw/compressed"); });
  is_heard([&] { return std::make_unique<CameraInfoListener>(camera + "camera_info"); });
}

}  // namespace
