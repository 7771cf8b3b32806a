// Makes a table for the colour detection from a part of a picture, and prints it as YAML for load_color_table and the
// parameter color_tables. The picture is the next one of an image topic, or a JPEG of the robot's camera.

#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/camera/color_table_file.h"
#include "node/camera/jpeg_decoder.h"
#include "node/node.h"
#include "tools/color_table_maker.h"

namespace {

using aibo_client::InvalidArgumentException;
using aibo_driver::color_table::Region;
using aibo_driver::node::BgrImage;
namespace options = boost::program_options;

constexpr double kLongestWait = 10;  // s, to wait for a picture
constexpr std::size_t kLongestFile = 1 << 20;

Region parseRegion(const std::string& text) {
  Region region{};
  char end = 0;
  if (std::sscanf(text.c_str(), "%d,%d,%d,%d%c", &region.left, &region.top, &region.width, &region.height, &end) != 4) {
    throw InvalidArgumentException("--region is '" + text +
                                   "'; it has to be LEFT,TOP,WIDTH,HEIGHT in pixels, such as 100,80,12,12");
  }
  return region;
}

BgrImage bgrOf(const sensor_msgs::Image& image) {
  const bool is_bgr = image.encoding == sensor_msgs::image_encodings::BGR8;
  if (!is_bgr && image.encoding != sensor_msgs::image_encodings::RGB8) {
    throw InvalidArgumentException("the images have the encoding " + image.encoding + "; it must be bgr8 or rgb8");
  }
  if (image.step < 3 * image.width || image.data.size() < std::size_t{image.step} * image.height) {
    throw InvalidArgumentException("the image is smaller than it says");
  }
  BgrImage bgr{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  for (std::size_t y = 0; y < image.height; ++y) {
    const auto row = image.data.begin() + static_cast<std::ptrdiff_t>(y * image.step);
    bgr.pixels.insert(bgr.pixels.end(), row, row + 3 * static_cast<std::ptrdiff_t>(image.width));
  }
  for (std::size_t i = 0; !is_bgr && i < bgr.pixels.size(); i += 3) {
    std::swap(bgr.pixels[i], bgr.pixels[i + 2]);
  }
  return bgr;
}

BgrImage pictureOfTopic(const std::string& topic, int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_color_table", ros::init_options::AnonymousName);
  if (!ros::master::check()) {
    throw InvalidArgumentException("there is no ROS master; is the driver running? --file takes a JPEG instead");
  }
  ros::NodeHandle handle;
  const auto image = ros::topic::waitForMessage<sensor_msgs::Image>(topic, handle, ros::Duration(kLongestWait));
  if (!image) {
    throw InvalidArgumentException("no image came on " + topic + " within 10 s; rostopic list shows the topics");
  }
  return bgrOf(*image);
}

BgrImage pictureOfFile(const std::string& file) {
  const auto jpeg = aibo_driver::files::loadFile(file, kLongestFile);
  return aibo_driver::node::decodeJpeg(jpeg.data(), jpeg.size());
}

int makeTable(const options::variables_map& values, int argc, char** argv) {
  const Region region = parseRegion(values["region"].as<std::string>());
  const int margin = values["margin"].as<int>();
  if (margin < 0 || margin > 127) {
    throw InvalidArgumentException("--margin is " + std::to_string(margin) + "; it must be 0..127");
  }
  const BgrImage picture = values.count("file") > 0 ? pictureOfFile(values["file"].as<std::string>())
                                                    : pictureOfTopic(values["topic"].as<std::string>(), argc, argv);
  const aibo_client::ColorTable table =
      aibo_driver::color_table::makeTable(picture, region, values["name"].as<std::string>(), margin);
  const auto coverage = aibo_driver::color_table::coverageOf(table, picture, region);
  std::fprintf(stderr, "The table contains %.1f %% of the region and %.1f %% of the rest of the picture.\n",
               100 * coverage.inside, 100 * coverage.outside);
  if (values.count("output") == 0) {
    std::cout << aibo_driver::node::toYaml(table);
    return 0;
  }
  const auto& output = values["output"].as<std::string>();
  std::ofstream file(output);
  if (!(file << aibo_driver::node::toYaml(table) << std::flush)) {
    throw InvalidArgumentException("cannot write " + output + "; does its folder exist, and may you write there?");
  }
  std::fprintf(stderr, "It is in %s.\n", output.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  options::options_description all(
      "Makes a table for the colour detection from a part of a picture.\n\n"
      "  rosrun aibo_driver aibo_color_table --region LEFT,TOP,WIDTH,HEIGHT [OPTION...]\n\nOptions");
  all.add_options()("region", options::value<std::string>(),
                    "the part of the picture, in pixels: LEFT,TOP,WIDTH,HEIGHT")(
      "topic", options::value<std::string>()->default_value("/aibo/camera/image_raw"), "topic of the images")(
      "file", options::value<std::string>(), "a JPEG of the robot's camera, instead of the topic")(
      "name", options::value<std::string>()->default_value("my_color"), "name of the table")(
      "margin", options::value<int>()->default_value(6), "by which the ranges of Cr and Cb are widened, 0..127")(
      "output", options::value<std::string>(), "file for the table; without it, the table is printed")(
      "help,h", "prints this text");
  try {
    options::variables_map values;
    options::store(options::parse_command_line(argc, argv, all), values);
    if (values.count("help") > 0 || values.count("region") == 0) {
      (values.count("help") > 0 ? std::cout : std::cerr) << all;
      return values.count("help") > 0 ? 0 : 2;
    }
    return makeTable(values, argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "aibo_color_table: %s.\n", error.what());
    return 1;
  }
}
