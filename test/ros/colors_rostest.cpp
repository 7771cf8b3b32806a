// The robot's colour detection, through the driver.
#include <aibo_driver/ColorRegions.h>
#include <aibo_driver/LoadColorTable.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

#include "support/proxy/fault_proxy.h"
#include "support/proxy/recording_proxy.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"

namespace {

using aibo_driver::ColorRegion;
using aibo_driver::ColorRegions;
using aibo_driver::LoadColorTable;
using test_support::DriverProcess;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::HasSubstr;

using RegionsListener = TopicListener<ColorRegions>;
using MaskListener = TopicListener<sensor_msgs::Image>;

// The ball of the simulated robot, which rolls to and fro before it.
bool showsBall(const ColorRegions& message) {
  return !message.regions.empty() && message.regions[0].pixels > 100;
}

LoadColorTable::Response load(const std::string& name_space, int channel, const std::string& file,
                              const std::string& table = "") {
  LoadColorTable call;
  call.request.channel = static_cast<std::uint8_t>(channel);
  call.request.file = file;
  call.request.table = table;
  const std::string service = name_space + "/load_color_table";
  EXPECT_TRUE(ros::service::waitForService(service, ros::Duration(20)) && ros::service::call(service, call));
  return call.response;
}

TEST(Colors, TheBallIsFoundWithTheTableThatIsThereFromTheStart) {
  SimulatedRobot robot;
  DriverProcess driver("/ball", robot.port(), {"_stream_on_start:=false"});
  RegionsListener regions("/ball/color_regions");
  const auto found = regions.waitFor(showsBall);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->header.frame_id, "camera_optical_frame");
  EXPECT_LT((ros::Time::now() - found->header.stamp).toSec(), 2.0);
  EXPECT_EQ(found->width, 208U);
  EXPECT_EQ(found->height, 160U);
  ASSERT_EQ(found->regions.size(), 1U);
  const ColorRegion& ball = found->regions[0];
  EXPECT_EQ(ball.channel, 0);
  EXPECT_EQ(ball.name, "pink_ball");
  EXPECT_GE(ball.x, ball.box.x_offset);
  EXPECT_LE(ball.x, ball.box.x_offset + ball.box.width);
  EXPECT_LE(ball.pixels, ball.box.width * ball.box.height);
}

TEST(Colors, TheMaskHasThePixels) {
  SimulatedRobot robot;
  DriverProcess driver("/mask", robot.port());
  MaskListener masks("/mask/color_mask");
  const auto found = masks.waitFor([](const sensor_msgs::Image& mask) {
    return mask.data.size() == 104 * 80 * 3 && std::count(mask.data.begin(), mask.data.end(), 0) < 104 * 80 * 3 - 100;
  });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->encoding, "rgb8");
  EXPECT_EQ(found->width, 104U);
}

TEST(Colors, TheRobotSendsTheMaskOnlyWhileSomebodyWantsIt) {
  SimulatedRobot robot;
  const test_support::RecordingProxy proxy(robot.port());
  DriverProcess driver("/no_mask", proxy.port());
  const auto sends_mask = [&proxy](bool wanted) {
    const auto end = std::chrono::steady_clock::now() + test_support::kSafetyNet;
    const auto is_on = [](const auto& request) { return request.id == 1; };
    while (std::chrono::steady_clock::now() < end) {
      const auto requests = proxy.requestsFromDriver("Z");
      const auto last = std::find_if(requests.rbegin(), requests.rend(), is_on);
      if (last != requests.rend() && (last->payload.at(2) != 0) == wanted) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  };
  RegionsListener regions("/no_mask/color_regions");
  EXPECT_TRUE(sends_mask(false));
  for (int i = 0; i < 2; ++i) {
    {
      const MaskListener masks("/no_mask/color_mask");
      EXPECT_TRUE(sends_mask(true));
    }
    EXPECT_TRUE(sends_mask(false));
  }
}

TEST(Colors, ATableIsLoadedWhileTheDriverRunsAndAgainAfterAReconnect) {
  SimulatedRobot robot;
  test_support::FaultProxy proxy(robot.port());
  DriverProcess driver("/load", proxy.port(), {"_color_tables:="});
  RegionsListener regions("/load/color_regions");
  ASSERT_TRUE(regions.waitFor([](const ColorRegions& message) { return message.regions.empty(); }));
  EXPECT_FALSE(load("/load", 0, "", "nonsense").success);
  EXPECT_THAT(load("/load", 7, "pink_ball").message, HasSubstr("no channel 7"));
  ASSERT_TRUE(load("/load", 3, "pink_ball").success);
  const auto has_channel3 = [](const ColorRegions& message) {
    return message.regions.size() == 1 && message.regions[0].channel == 3;
  };
  ASSERT_TRUE(regions.waitFor(has_channel3));
  proxy.endConnections(test_support::Action::kReset);
  regions.clear();
  EXPECT_TRUE(regions.waitFor(has_channel3));
  EXPECT_TRUE(load("/load", 3, "").success);
  EXPECT_TRUE(regions.waitFor([](const ColorRegions& message) { return message.regions.empty(); }));
}

}  // namespace
