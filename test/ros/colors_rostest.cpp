// The robot's colour detection, through the driver.
#include <aibo_driver/ColorRegions.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include "protocol/color_requests.h"
#include "ros/driver_user.h"

namespace {

using aibo_driver::ColorRegions;

using RegionsListener = test_support::TopicListener<ColorRegions>;
using MaskListener = test_support::TopicListener<sensor_msgs::Image>;

// The ball of the simulated robot rolls to and fro before it.
TEST(Colors, TheBallIsFoundWithTheTableThatIsThereFromTheStart) {
  test_support::SimulatedRobot robot;
  test_support::DriverProcess driver("/ball", robot.port(), {"_stream_on_start:=false", "_frame_prefix:=left"});
  RegionsListener regions("/ball/color_regions");
  const auto found = regions.waitFor(
      [](const ColorRegions& message) { return !message.regions.empty() && message.regions[0].pixels > 100; });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->header.frame_id, "left/camera_optical_frame");
  EXPECT_EQ(found->regions[0].name, "pink_ball");

  const auto mask = MaskListener("/ball/color_mask").waitFor([](const sensor_msgs::Image& each) {
    return std::count(each.data.begin(), each.data.end(), 0) < 104 * 80 * 3 - 100;
  });
  ASSERT_TRUE(mask);
  EXPECT_EQ(mask->header.frame_id, "left/camera_optical_frame");
}

TEST(Colors, TheRobotDetectsAndSendsTheMaskOnlyWhileSomebodyWantsIt) {
  namespace version2 = protocol::version2;
  test_support::SimulatedRobot robot;
  const test_support::RecordingProxy proxy(robot.port());
  test_support::DriverProcess driver("/no_mask", proxy.port(), {"_color_rate:=10"});
  // Whether the last request is this one, leaving out those that load a table.
  const auto asks = [&proxy](int id, const std::vector<std::uint8_t>& settings) {
    return test_support::DriverUser::becomesTrue([&] {
      auto requests = proxy.requestsFromDriver("Z");
      while (!requests.empty() && requests.back().id == version2::COLORS_TABLE) {
        requests.pop_back();
      }
      return !requests.empty() && requests.back().id == id &&
             std::equal(settings.begin(), settings.end(), requests.back().payload.begin() + 1);
    });
  };
  {
    const RegionsListener regions("/no_mask/color_regions");
    EXPECT_TRUE(asks(version2::COLORS_ON, {3, 0})) << "every third image, without the mask";
    const MaskListener masks("/no_mask/color_mask");
    EXPECT_TRUE(asks(version2::COLORS_ON, {3, 1}));
  }
  EXPECT_TRUE(asks(version2::COLORS_OFF, {}));
}

}  // namespace
