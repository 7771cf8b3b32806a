// Makes a table for the colour detection from a part of a picture of the robot's camera, and prints it as YAML for
// load_color_table and the parameter color_tables.

#include <boost/program_options.hpp>
#include <cstdio>
#include <iostream>
#include <string>

#include "aibo_client/exceptions.h"
#include "camera/color_table_file.h"
#include "camera/jpeg_decoder.h"
#include "files/files.h"
#include "text/sentence.h"
#include "tools/color_table_maker.h"

namespace {

using aibo_client::InvalidArgumentException;
using aibo_driver::color_table::Region;
namespace options = boost::program_options;

constexpr std::size_t kLongestFile = 1 << 20;

Region parseRegion(const std::string& text) {
  Region region{};
  char end = 0;
  if (std::sscanf(text.c_str(), "%5d,%5d,%5d,%5d%c", &region.left, &region.top, &region.width, &region.height, &end) !=
      4) {
    throw InvalidArgumentException("--region is '" + text +
                                   "'; it has to be LEFT,TOP,WIDTH,HEIGHT in pixels, such as 100,80,12,12");
  }
  return region;
}

aibo_driver::camera::BgrImage loadPicture(const std::string& file) {
  const auto jpeg = aibo_driver::files::loadFile(file, kLongestFile);
  try {
    return aibo_driver::camera::decodeJpeg(jpeg.data(), jpeg.size());
  } catch (const aibo_driver::camera::DecodeException& error) {
    throw InvalidArgumentException("'" + file + "' is not a picture of the robot's camera: " + error.what());
  }
}

void makeTable(const options::variables_map& values) {
  const Region region = parseRegion(values["region"].as<std::string>());
  const int margin = values["margin"].as<int>();
  if (margin < 0 || margin > 127) {
    throw InvalidArgumentException("--margin is " + std::to_string(margin) + "; it must be 0..127");
  }
  const aibo_driver::camera::BgrImage picture = loadPicture(values["picture"].as<std::string>());
  const aibo_client::ColorTable table =
      aibo_driver::color_table::makeTable(picture, region, values["name"].as<std::string>(), margin);
  const auto coverage = aibo_driver::color_table::coverageOf(table, picture, region);
  std::fprintf(stderr, "The table contains %.1f %% of the region and %.1f %% of the rest of the picture.\n",
               100 * coverage.inside, 100 * coverage.outside);
  const std::string yaml = aibo_driver::camera::toYaml(table);
  aibo_driver::camera::parseColorTable(yaml, "the table");  // refuses a name with which the table could not be loaded
  if (values.count("output") == 0) {
    std::cout << yaml;
    return;
  }
  const auto& output = values["output"].as<std::string>();
  aibo_driver::files::replaceFile(output, yaml);
  std::fprintf(stderr, "It is in %s.\n", output.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  options::options_description all(
      "Makes a table for the colour detection from a part of a picture of the robot's camera.\n\n"
      "  rosrun aibo_driver aibo_color_table PICTURE.jpg --region LEFT,TOP,WIDTH,HEIGHT [OPTION...]\n\nOptions");
  all.add_options()("picture", options::value<std::string>()->required(), "a JPEG, such as take_picture saves")(
      "region", options::value<std::string>()->required(), "the part of the picture, in pixels: LEFT,TOP,WIDTH,HEIGHT")(
      "name", options::value<std::string>()->default_value("my_color"), "name of the table")(
      "margin", options::value<int>()->default_value(6), "by which the ranges of Cr and Cb are widened, 0..127")(
      "output", options::value<std::string>(), "file for the table; without it, the table is printed")(
      "help,h", "prints this text");
  options::positional_options_description picture;
  picture.add("picture", 1);
  try {
    options::variables_map values;
    options::store(options::command_line_parser(argc, argv).options(all).positional(picture).run(), values);
    if (values.count("help") > 0) {
      std::cout << all;
      return 0;
    }
    options::notify(values);
    makeTable(values);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "aibo_color_table: %s\n", aibo_driver::text::sentence(error.what()).c_str());
    return 1;
  }
}
