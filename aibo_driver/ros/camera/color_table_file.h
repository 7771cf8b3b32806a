/// @file color_table_file.h
/// Tables of the colour detection as YAML, such as config/colors/pink_ball.yaml: a name, and ranges of Y (from a
/// multiple of 8 up to one less than a multiple of 8), Cr and Cb, each [lowest, highest] of 0..255. Where ranges of Y
/// overlap, the last one counts; brightnesses that are in none have no colours.
#ifndef AIBO_DRIVER_ROS_CAMERA_COLOR_TABLE_FILE_H
#define AIBO_DRIVER_ROS_CAMERA_COLOR_TABLE_FILE_H

#include <string>

#include "aibo_driver/colors.h"
#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {

/// A table cannot be used; the message says where and why.
class ColorTableException : public Exception {
 public:
  using Exception::Exception;
};

/// @param text YAML
/// @param source for messages, such as the file's name
/// @throw ColorTableException
ColorTable parseColorTable(const std::string& text, const std::string& source);

/// @param file a path, or the name of a table of this package: pink_ball is config/colors/pink_ball.yaml
/// @throw ColorTableException the file cannot be read, or is no table
ColorTable loadColorTable(const std::string& file);

/// The table as YAML, for parseColorTable().
std::string toYaml(const ColorTable& table);

/// A colour that stands for the table: the middle of its ranges.
struct RgbColor {
  unsigned char red;
  unsigned char green;
  unsigned char blue;
};
RgbColor colorOf(const ColorTable& table);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_COLOR_TABLE_FILE_H
