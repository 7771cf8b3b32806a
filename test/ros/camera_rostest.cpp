// What the driver publishes on the camera's topics.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/ColorRegions.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
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
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using CompressedListener = TopicListener<sensor_msgs::CompressedImage>;
using CameraInfoListener = TopicListener<sensor_msgs::CameraInfo>;
using ImageListener = TopicListener<sensor_msgs::Image>;

constexpr std::size_t kEnough = 30;  // pictures: about a second of them

template <typename Message>
void ignore(const boost::shared_ptr<const Message>&) {}

template <typename Message>
ros::Subscriber subscribeAndIgnore(const std::string& topic) {
  return ros::NodeHandle().subscribe<Message>(topic, 1, &ignore<Message>);
}

// A gap is not a fault while this computer is too busy to run driver and test: then the newest picture wins. So one
// second of the first half minute must be without a gap, and in all of it every picture must be one that the robot has
// sent, once and in order.
TEST(Camera, PublishedPicturesAreTheRobotsOwnByteForByteAndWithoutAGap) {
  SimulatedRobot robot;
  RecordingProxy proxy(robot.port());
  CompressedListener pictures("/bytes/camera/image_raw/compressed");
  DriverProcess driver("/bytes", proxy.port(), {test_support::kByTcp});
  std::size_t without_gap = 0;
  for (std::size_t count = kEnough; without_gap < kEnough && count <= 30 * kEnough; count += kEnough) {
    const auto published = pictures.waitForCount(count);
    ASSERT_GE(published.size(), count);
    const std::vector<std::vector<std::uint8_t>> sent = proxy.picturesFromRobot();
    without_gap = 0;
    auto next = sent.begin();
    for (const sensor_msgs::CompressedImageConstPtr& picture : published) {
      const auto found = std::find(next, sent.end(), picture->data);
      ASSERT_NE(found, sent.end()) << "a picture that the robot did not send, or not in this order";
      without_gap = found == next ? without_gap + 1 : 1;
      next = found + 1;
      EXPECT_EQ(picture->format, "bgr8; jpeg compressed bgr8");
      if (without_gap == kEnough) {
        break;
      }
    }
  }
  EXPECT_GE(without_gap, kEnough);
}

TEST(Camera, AllMessagesOfAPictureHaveTheSameHeaderAndStampsIncrease) {
  SimulatedRobot robot;
  CompressedListener pictures("/stamps/camera/image_raw/compressed");
  CameraInfoListener camera_infos("/stamps/camera/camera_info");
  ImageListener images("/stamps/camera/image_raw");
  TopicListener<aibo_driver::CameraState> states("/stamps/camera/state");
  const ros::Time begin = ros::Time::now();
  DriverProcess driver("/stamps", robot.port(), {"_frame_id:=aibo_eye", "_frame_prefix:=left"});
  ASSERT_TRUE(images.waitFor([](const sensor_msgs::Image&) { return true; }));
  images.clear();
  const auto decoded = images.waitForCount(kEnough);
  ASSERT_GE(decoded.size(), kEnough);
  const ros::Time end = ros::Time::now();

  const auto state = states.waitForCount(1);
  ASSERT_FALSE(state.empty());
  EXPECT_EQ(state[0]->header.frame_id, "left/aibo_eye");
  EXPECT_GE(state[0]->header.stamp, begin);
  EXPECT_LE(state[0]->header.stamp, end);

  ros::Time last;
  for (const sensor_msgs::ImageConstPtr& image : decoded) {
    EXPECT_GT(image->header.stamp, last);
    EXPECT_GE(image->header.stamp, begin);
    EXPECT_LE(image->header.stamp, end);
    last = image->header.stamp;
    EXPECT_EQ(image->header.frame_id, "left/aibo_eye");
    const auto same_header = [&image](const auto& message) {
      return message.header.stamp == image->header.stamp && message.header.frame_id == image->header.frame_id;
    };
    ASSERT_TRUE(pictures.waitFor(same_header));
    ASSERT_TRUE(camera_infos.waitFor(same_header));
  }
}

TEST(Camera, TheTimeOffsetIsAddedToTheStamps) {
  SimulatedRobot robot;
  CompressedListener pictures("/offset/camera/image_raw/compressed");
  TopicListener<sensor_msgs::JointState> joints("/offset/joint_states");
  TopicListener<aibo_driver::ColorRegions> colors("/offset/color_regions");
  DriverProcess driver("/offset", robot.port(), {"_time_offset:=30"});
  const auto published = pictures.waitForCount(1);
  ASSERT_FALSE(published.empty());
  EXPECT_GT(published.front()->header.stamp, ros::Time::now());
  const auto measured = joints.waitForNext();
  EXPECT_TRUE(measured && measured->header.stamp > ros::Time::now());
  const auto detected = colors.waitForNext();
  EXPECT_TRUE(detected && detected->header.stamp > ros::Time::now());
}

TEST(Camera, ImagesAreBgrOfThePicturesSize) {
  SimulatedRobot robot;
  ImageListener images("/image/camera/image_raw");
  DriverProcess driver("/image", robot.port(), {"_resolution:=104x80"});
  const auto decoded = images.waitForCount(1);
  ASSERT_FALSE(decoded.empty());
  const sensor_msgs::Image& image = *decoded.front();
  EXPECT_EQ(image.encoding, "bgr8");
  EXPECT_EQ(image.width, 104u);
  EXPECT_EQ(image.height, 80u);
  EXPECT_EQ(image.step, 3u * 104u);
  EXPECT_EQ(image.data.size(), 3u * 104u * 80u);
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

TEST(Calibration, OfAnotherSizeIsScaledIfItFitsAndElseRefused) {
  CalibrationUser user("/calibration_size");
  ASSERT_EQ(user.next().width, 208u);
  CameraInfo info = goodCalibration();
  info.width = 200;
  const auto refused = user.set(info);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.status_message, HasSubstr("for pictures of 200x160, but the robot sends 208x160"));
  EXPECT_NO_THROW(user.driver().waitForOutput("WARN.*set_camera_info was refused. .*pictures of 200x160", kSafetyNet));
  EXPECT_NEAR(user.next().K[0], 191.9, 0.1) << "the nominal one stays";
  info.width = 832;
  info.height = 640;
  EXPECT_THAT(user.set(info).status_message, HasSubstr("the camera has no pictures of 832x640"));
  info = goodCalibration();
  info.K[0] = 0;
  const auto empty = user.set(info);
  EXPECT_FALSE(empty.success);
  EXPECT_THAT(empty.status_message, HasSubstr("it is empty"));

  info = goodCalibration();
  info.width = 104;
  info.height = 80;
  EXPECT_TRUE(user.set(info).success);
  const CameraInfo scaled = user.next();
  EXPECT_EQ(scaled.width, 208u);
  EXPECT_EQ(scaled.height, 160u);
  EXPECT_DOUBLE_EQ(scaled.K[0], 2 * info.K[0]);
  EXPECT_TRUE(user.set(goodCalibration()).success);
  EXPECT_EQ(user.next().K, goodCalibration().K) << "it replaces the other one";
  info.width = 200;
  EXPECT_FALSE(user.set(info).success);
  EXPECT_EQ(user.next().K, goodCalibration().K) << "it stays";
}

TEST(Calibration, InAFileThatDoesNotFitThePicturesIsNotPublished) {
  CalibrationUser user("/calibration_file");
  ASSERT_TRUE(user.set(goodCalibration()).success);
  std::string text = contentOf(user.file());
  text.replace(text.find("208"), 3, "200");
  std::ofstream(user.file()) << text;
  user.restart();
  const CameraInfo info = user.next();
  EXPECT_EQ(info.width, 208u);
  EXPECT_NEAR(info.K[0], 191.9, 0.1);
  const std::string misfit = "is for pictures of 200x160, but the robot sends 208x160";
  EXPECT_NO_THROW(user.driver().waitForOutput(misfit, kSafetyNet));
  for (int i = 0; i < 3; ++i) {
    user.next();
  }
  const std::string output = user.driver().output();
  EXPECT_EQ(output.find(misfit, output.find(misfit) + 1), std::string::npos) << "it is logged once";
}

TEST(Calibration, InAFileThatIsDamagedIsNotPublished) {
  CalibrationUser user("/calibration_damaged");
  ASSERT_TRUE(user.set(goodCalibration()).success);
  std::string text = contentOf(user.file());
  text.replace(text.find("plumb_bob"), 9, "plumb");
  std::ofstream(user.file()) << text;
  user.restart();
  EXPECT_NEAR(user.next().K[0], 191.9, 0.1);
  EXPECT_NO_THROW(user.driver().waitForOutput("is left out: the distortion model is not", kSafetyNet));
}

TEST(Calibration, ThatCannotBeStoredIsNotUsed) {
  CalibrationUser user("/calibration_unstored");
  ASSERT_EQ(user.next().width, 208u);
  ASSERT_TRUE(std::filesystem::create_directory(user.file())) << "in the place of the file";
  const auto refused = user.set(goodCalibration());
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.status_message, HasSubstr("stays as it was"));
  EXPECT_NEAR(user.next().K[0], 191.9, 0.1) << "the nominal one stays";
}

TEST(Calibration, OfTwoRobotsIsInTwoFilesAlsoIfTheyAreNotThere) {
  const test_support::TemporaryFolder home;
  for (const std::string name_space : {"/one", "/two"}) {
    DriverProcess driver(name_space, 1, {}, {{"ROS_HOME", home.path().string()}});
    sensor_msgs::SetCameraInfo call;
    call.request.camera_info = goodCalibration();
    call.request.camera_info.K[0] = name_space == "/one" ? 190.0 : 200.0;
    const std::string service = name_space + "/camera/set_camera_info";
    ASSERT_TRUE(ros::service::waitForService(service, ros::Duration(60)));
    ASSERT_TRUE(ros::service::call(service, call));
    EXPECT_TRUE(call.response.success) << call.response.status_message;
  }
  EXPECT_THAT(contentOf(home.path("camera_info/one.yaml").string()),
              AllOf(HasSubstr("190"), HasSubstr("camera_name: one")));
  EXPECT_THAT(contentOf(home.path("camera_info/two.yaml").string()), HasSubstr("200"));
}

TEST(Calibration, MustFitThePicturesThatComeWhetherAnybodyListensOrNot) {
  const test_support::TemporaryFolder folder;
  SimulatedRobot robot;
  robot.kill();
  DriverProcess driver("/unheard", robot.port(), {"_camera_info_url:=file://" + folder.path("camera.yaml").string()});
  sensor_msgs::SetCameraInfo call;
  call.request.camera_info = goodCalibration();
  call.request.camera_info.width = 320;
  call.request.camera_info.height = 240;
  const std::string service = "/unheard/camera/set_camera_info";
  ASSERT_TRUE(ros::service::waitForService(service, ros::Duration(60)));
  ASSERT_TRUE(ros::service::call(service, call));
  EXPECT_TRUE(call.response.success) << "nobody knows yet what the robot sends";
  robot.restart();
  EXPECT_NO_THROW(driver.waitForOutput("WARN.*is for pictures of 320x240, but the robot sends 208x160", kSafetyNet));
  ASSERT_TRUE(ros::service::call(service, call));
  EXPECT_FALSE(call.response.success);
  EXPECT_THAT(call.response.status_message, HasSubstr("the robot sends 208x160"));
}

TEST(Camera, OnDemandTheRobotStreamsOnlyWhileThereIsASubscriber) {
  SimulatedRobot robot;
  TopicListener<std_msgs::Bool> streaming("/demand/streaming");
  DiagnosticsListener diagnostics;
  DriverProcess driver("/demand", robot.port(), {"_stream_on_demand:=true"});
  const auto is = [](bool value) {
    return [value](const std_msgs::Bool& message) { return static_cast<bool>(message.data) == value; };
  };
  const auto is_idle = [](const diagnostic_msgs::DiagnosticStatus& status) {
    return status.level == diagnostic_msgs::DiagnosticStatus::OK &&
           status.message.find("idle: no camera topic has a subscriber") == 0;
  };
  // While the robot is connected and there is no subscriber.
  EXPECT_NE(diagnostics
                .waitFor("demand/aibo_driver: connection",
                         [](const auto& status) { return status.level == diagnostic_msgs::DiagnosticStatus::OK; })
                .name,
            "");
  EXPECT_NE(diagnostics.waitFor("demand/aibo_driver: stream", is_idle).name, "");
  EXPECT_FALSE(streaming.waitFor(is(true), std::chrono::milliseconds(0)));
  const std::string camera = "/demand/camera/";
  const std::vector<std::function<ros::Subscriber()>> subscriptions = {
      [&] { return subscribeAndIgnore<sensor_msgs::Image>(camera + "image_raw"); },
      [&] { return subscribeAndIgnore<sensor_msgs::CompressedImage>(camera + "image_raw/compressed"); },
      [&] { return subscribeAndIgnore<sensor_msgs::CameraInfo>(camera + "camera_info"); }};
  for (const auto& subscribe : subscriptions) {
    streaming.clear();
    ros::Subscriber subscriber = subscribe();
    EXPECT_TRUE(streaming.waitFor(is(true)));
    streaming.clear();
    subscriber.shutdown();
    EXPECT_TRUE(streaming.waitFor(is(false)));
  }
}

}  // namespace
