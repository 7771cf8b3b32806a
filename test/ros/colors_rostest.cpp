// The robot's colour detection, through the driver.
#include <aibo_driver/ColorRegions.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include "node/camera/color_table_file.h"
#include "protocol/color_requests.h"
#include "support/ros/driver_user.h"
#include "support/temporary_folder.h"
#include "support/test_pictures.h"

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
  EXPECT_EQ(found->width, 208U);
  ASSERT_EQ(found->regions.size(), 1U);
  const aibo_driver::ColorRegion& ball = found->regions[0];
  EXPECT_EQ(ball.channel, 0);
  EXPECT_EQ(ball.name, "pink_ball");
  EXPECT_GE(ball.x, ball.box.x_offset);
  EXPECT_LE(ball.x, ball.box.x_offset + ball.box.width);
  EXPECT_LE(ball.pixels, ball.box.width * ball.box.height);

  const auto mask = MaskListener("/ball/color_mask").waitFor([](const sensor_msgs::Image& each) {
    return std::count(each.data.begin(), each.data.end(), 0) < 104 * 80 * 3 - 100;
  });
  ASSERT_TRUE(mask);
  EXPECT_EQ(mask->header.frame_id, "left/camera_optical_frame");
  EXPECT_EQ(mask->encoding, "rgb8");
  EXPECT_EQ(mask->data.size(), 104U * 80U * 3U);
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

// A picture of 104 x 80 with a red square, 20..39, and rows that are longer than they need to be.
sensor_msgs::Image paint(const std::string& encoding) {
  sensor_msgs::Image image;
  image.encoding = encoding;
  image.width = 104;
  image.height = 80;
  image.step = 3 * 104 + 5;
  image.data.assign(std::size_t{image.step} * image.height, 100);
  for (std::size_t y = 20; y < 40; ++y) {
    for (std::size_t x = 20; x < 40; ++x) {
      image.data[y * image.step + 3 * x + (encoding == "rgb8" ? 0 : 2)] = 250;
    }
  }
  return image;
}

class ColorTableTest : public ::testing::Test {
 protected:
  static std::vector<std::string> command(std::vector<std::string> words) {
    words.insert(words.begin(), AIBO_COLOR_TABLE);
    return words;
  }

  // What it prints, and how it ends.
  static std::string run(const std::vector<std::string>& words, int status) {
    test_support::Process process(command(words));
    EXPECT_EQ(process.waitForExit(test_support::kSafetyNet), status) << process.output();
    return process.output();
  }

  const test_support::TemporaryFolder folder_;
};

TEST_F(ColorTableTest, HoldsTheColorsOfAPartOfAPictureOfAnyEncoding) {
  ros::NodeHandle handle("/painted");
  aibo_client::ColorTable tables[2];
  for (const std::string encoding : {"rgb8", "bgr8"}) {
    const ros::Publisher painter = handle.advertise<sensor_msgs::Image>(encoding, 1, true);
    painter.publish(paint(encoding));
    const std::string file = folder_.path(encoding + ".yaml");
    EXPECT_THAT(
        run({"--topic", "/painted/" + encoding, "--region", "20,20,12,16", "--name", "red", "--output", file}, 0),
        testing::AllOf(testing::HasSubstr("contains 100.0 % of the region"), testing::HasSubstr("It is in " + file)));
    tables[encoding == "rgb8" ? 0 : 1] = aibo_driver::node::loadColorTable(file);
  }
  EXPECT_EQ(tables[0].name, "red");
  EXPECT_EQ(tables[0].segments, tables[1].segments);
}

TEST_F(ColorTableTest, IsPrintedForAPictureInAFile) {
  const test_pictures::Bytes jpeg = test_pictures::make();
  folder_.write("a.jpg", std::string(jpeg.begin(), jpeg.end()));
  const std::string output = run({"--file", folder_.path("a.jpg"), "--region", "10,10,20,20"}, 0);
  EXPECT_EQ(aibo_driver::node::parseColorTable(output.substr(output.find('\n') + 1), "a").name, "my_color") << output;
}

TEST_F(ColorTableTest, WhatCannotBeMadeIsExplained) {
  ros::NodeHandle handle("/painted");
  const auto show = [&handle](const char* topic, const sensor_msgs::Image& image) {
    ros::Publisher painter = handle.advertise<sensor_msgs::Image>(topic, 1, true);
    painter.publish(image);
    return painter;
  };
  sensor_msgs::Image torn = paint("rgb8");
  torn.data.pop_back();
  const ros::Publisher painters[] = {show("grey", paint("mono8")), show("torn", torn), show("whole", paint("rgb8"))};
  const std::tuple<std::vector<std::string>, int, const char*> rows[] = {
      {{}, 2, "LEFT,TOP,WIDTH,HEIGHT"},
      {{"--help"}, 0, "LEFT,TOP,WIDTH,HEIGHT"},
      {{"--region", "1,2,3"}, 1, "--region is '1,2,3'; it has to be"},
      {{"--region", "0,0,9,9", "--margin=128"}, 1, "it must be 0..127"},
      {{"--region", "0,0,9,9", "--topic", "/painted/grey"}, 1, "encoding mono8; it must be"},
      {{"--region", "0,0,9,9", "--topic", "/painted/torn"}, 1, "smaller than it says"},
      {{"--region", "0,0,9,9", "--topic", "/painted/whole", "--output", "/nowhere/a.yaml"}, 1, "cannot write /nowhere"},
      {{"--region", "0,0,9,9", "--topic", "/painted/nothing"}, 1, "no image came on /painted/nothing within 10 s"},
  };
  for (const auto& [words, status, text] : rows) {
    EXPECT_THAT(run(words, status), testing::HasSubstr(text));
  }
  test_support::Process without_master(command({"--region", "0,0,9,9"}), {{"ROS_MASTER_URI", "http://127.0.0.1:1"}});
  EXPECT_NO_THROW(without_master.waitForOutput("there is no ROS master", test_support::kSafetyNet));
}

}  // namespace
