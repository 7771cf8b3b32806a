// The services for pictures. test/unit/driver has what they answer in all other cases.

#include <aibo_driver/TakePicture.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>

#include <chrono>
#include <future>

#include "support/ros/driver_user.h"

namespace {

using aibo_driver::TakePicture;
using test_support::DriverUser;
using test_support::kSafetyNet;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std_srvs::SetBool::Response setStreaming(DriverUser& user, bool on) {
  std_srvs::SetBool::Request request;
  request.data = on;
  return user.call<std_srvs::SetBool>("set_streaming", request);
}

TEST(TakePicture, WithoutAStreamAnswersAPictureThatWasTakenAfterTheCall) {
  DriverUser user("/still", {"_stream_on_start:=false"});
  const ros::Time before = ros::Time::now();
  const auto answer = user.call<TakePicture>("take_picture");
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_GT(answer.image.header.stamp, before);
  EXPECT_EQ(answer.image.header.frame_id, "rex/camera_optical_frame");
  EXPECT_THAT(answer.message, HasSubstr("at quality 83"));
  EXPECT_THAT(user.proxy.picturesFromRobot(), Contains(answer.image.data));
  ASSERT_THAT(user.proxy.requestsFromDriver("F"), SizeIs(1));
  EXPECT_EQ(user.proxy.requestsFromDriver("F").front().id, 83);
}

TEST(TakePicture, FromASilentRobotEndsWithItsTimeoutAndDelaysNobodyElse) {
  DriverUser user("/silent", {"_stream_on_start:=false", "_take_picture_timeout:=10", "_read_timeout:=60"});
  user.proxy.setMute(true);
  auto waiting = std::async(std::launch::async, [&user] { return user.call<TakePicture>("take_picture"); });
  ASSERT_TRUE(user.proxy.waitForRequest("F", kSafetyNet));
  auto second = std::async(std::launch::async, [&user] { return user.call<TakePicture>("take_picture"); });
  EXPECT_TRUE(setStreaming(user, true).success);
  EXPECT_TRUE(user.proxy.waitForRequest("W", kSafetyNet));
  constexpr std::chrono::milliseconds kLook{2};
  while (user.proxy.requestsFromDriver("F").size() < 2 && waiting.wait_for(kLook) == std::future_status::timeout) {
  }
  dynamic_reconfigure::Reconfigure::Request settings;
  settings.config.doubles.resize(1);
  settings.config.doubles[0].name = "telemetry_rate";
  user.call<dynamic_reconfigure::Reconfigure>("aibo_driver/set_parameters", settings);
  EXPECT_EQ(waiting.wait_for(std::chrono::seconds(0)), std::future_status::timeout) << "the others had to wait";
  ASSERT_EQ(waiting.wait_for(kSafetyNet), std::future_status::ready);
  const TakePicture::Response answer = waiting.get();
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("There is no picture"));
  EXPECT_FALSE(second.get().success);
}

}  // namespace
