// What the driver publishes on the camera's topics, with which stamps, and pictures on request.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/ColorRegions.h>
#include <aibo_driver/TakePicture.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <std_msgs/Bool.h>

#include <fstream>

#include "ros/diagnostics_listener.h"
#include "ros/driver_user.h"
#include "support/good_calibration.h"
#include "support/temporary_folder.h"

namespace {

using sensor_msgs::CameraInfo;
using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::goodCalibration;
using test_support::kSafetyNet;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::HasSubstr;
using CompressedListener = TopicListener<sensor_msgs::CompressedImage>;
using CameraInfoListener = TopicListener<sensor_msgs::CameraInfo>;
using ImageListener = TopicListener<sensor_msgs::Image>;
using aibo_driver::TakePicture;
using test_support::DriverUser;

constexpr std::size_t kEnough = 30;  // pictures: about a second of them

TEST(Camera, PublishesTheRobotsOwnPicturesByteForByteOnceAndInOrder) {
  SimulatedRobot robot;
  test_support::RecordingProxy proxy(robot.port());
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
  const auto decoded = [&] {
    pictures.clear();
    EXPECT_GE(pictures.waitForCount(kEnough).size(), kEnough);
    return DiagnosticsListener::value(diagnostics.waitForNext("lazy/aibo_driver: stream"), "images decoded");
  };
  EXPECT_EQ(decoded(), "0");
  EXPECT_TRUE(ImageListener("/lazy/camera/image_raw").waitForNext());
  EXPECT_NE(decoded(), "0");
  EXPECT_TRUE(test_support::DriverUser::becomesTrue([&] { return decoded() == decoded(); })) << "and then no more";
}

// On a computer that has such a plugin. It would encode the pictures again, on the topic of the robot's own.
TEST(Camera, ForbidsImageTransportToPublishJpegs) {
  const std::string list = "/plugin/camera/image_raw/disable_pub_plugins";
  ros::param::set(list, std::vector<std::string>{"image_transport/theora", "image_transport/compressed"});
  const test_support::DriverUser user("/plugin");
  std::vector<std::string> disabled;
  ros::param::get(list, disabled);
  EXPECT_THAT(disabled, testing::ElementsAre("image_transport/theora", "image_transport/compressed",
                                             "image_transport/compressedDepth"));
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
  std::string stored() const { return folder_.read("camera.yaml"); }
  test_support::Process& driver() { return *driver_; }

  void restart() {
    driver_.reset();
    driver_ = std::make_unique<DriverProcess>(name_space_, robot_.port(), parameters_);
  }

  // The calibration that is published with the next picture; a message without numbers if there is none.
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
  EXPECT_NEAR(nominal.P[0], 191.9, 0.1);
  EXPECT_NO_THROW(user.driver().waitForOutput("camera_info holds the nominal calibration"));

  const auto answer = user.set(goodCalibration());
  EXPECT_TRUE(answer.success) << answer.status_message;
  EXPECT_THAT(answer.status_message, HasSubstr(user.file()));
  EXPECT_NO_THROW(user.driver().waitForOutput("208x160 is stored in " + user.file()));
  EXPECT_EQ(user.next().K, goodCalibration().K);

  user.restart();
  EXPECT_EQ(user.next().K, goodCalibration().K);
  EXPECT_NO_THROW(user.driver().waitForOutput("calibration is that in " + user.file()));
}

TEST(Calibration, ThatCannotBelongToTheCameraIsRefusedAndNotPublished) {
  CalibrationUser user("/calibration_refused");
  ASSERT_EQ(user.next().width, 208u);
  ASSERT_TRUE(user.set(goodCalibration()).success);
  const std::string stored = user.stored();
  CameraInfo other = goodCalibration();
  other.width = 200;
  EXPECT_THAT(user.set(other).status_message, HasSubstr("for pictures of 200x160, but the robot sends 208x160"));
  other.K[4] = 0;
  const auto refused = user.set(other);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.status_message, HasSubstr("The calibration stays as it was: fy of K is 0"));
  EXPECT_EQ(user.stored(), stored);
  EXPECT_EQ(user.next().K, goodCalibration().K);
  std::string text = stored;
  text.replace(text.find("208"), 3, "200");
  std::ofstream(user.file()) << text;
  user.restart();
  EXPECT_NEAR(user.next().K[0], 191.9, 0.1) << "the nominal one";
  EXPECT_NO_THROW(user.driver().waitForOutput("is for pictures of 200x160, but the robot sends"));
}

TEST(Camera, StateIsToldForTheFirstPictureOfEachConnection) {
  TopicListener<aibo_driver::CameraState> states("/each/camera/state");
  DriverUser user("/each", {test_support::kStreams});
  ASSERT_TRUE(states.waitForFirst());
  user.proxy.endConnections(test_support::Action::kClose);
  EXPECT_THAT(states.waitForCount(2), testing::SizeIs(2)) << "the robot's settings may be others";
}

TEST(Camera, OnDemandTheRobotStreamsOnlyWhileACameraTopicHasASubscriber) {
  SimulatedRobot robot;
  TopicListener<std_msgs::Bool> streaming("/demand/streaming");
  DriverProcess driver("/demand", robot.port());
  const auto becomes = [&streaming](bool on) {
    return streaming.waitFor([on](const std_msgs::Bool& message) { return static_cast<bool>(message.data) == on; });
  };
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

TEST(TakePicture, WithoutAStreamAnswersAPictureThatWasTakenAfterTheCall) {
  DriverUser user("/still", {"_stream_on_start:=false"});
  const ros::Time before = ros::Time::now();
  const auto answer = user.call<TakePicture>("take_picture");
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_GT(answer.image.header.stamp, before);
  EXPECT_EQ(answer.image.header.frame_id, "rex/camera_optical_frame");
  EXPECT_THAT(answer.message, HasSubstr("at quality 83"));
  EXPECT_THAT(user.proxy.picturesFromRobot(), testing::Contains(answer.image.data));
  ASSERT_THAT(user.proxy.requestsFromDriver("F"), testing::SizeIs(1));
  EXPECT_EQ(user.proxy.requestsFromDriver("F").front().id, 83);
}

// What is stamped with the time of the robot.
TEST(Stamps, HaveTheOffsetAndAreNotOfTheRobotIfTheUserDoesNotWantThat) {
  DiagnosticsListener diagnostics;
  CompressedListener pictures("/offset/camera/image_raw/compressed");
  TopicListener<sensor_msgs::JointState> states("/offset/joint_states");
  TopicListener<aibo_driver::ColorRegions> colors("/offset/color_regions");
  const ros::Time end = ros::Time::now() + ros::Duration(50);
  const DriverUser user("/offset", {"_time_offset:=60", "_use_robot_time:=false"});
  const auto is_later = [end](const auto& message) { return message.header.stamp > end; };
  EXPECT_TRUE(pictures.waitFor(is_later));
  EXPECT_TRUE(states.waitFor(is_later));
  EXPECT_TRUE(colors.waitFor(is_later));
  const auto stream = diagnostics.waitForNext("offset/aibo_driver: stream");
  EXPECT_EQ(DiagnosticsListener::value(stream, "timelines begun"), "0");
}

}  // namespace
