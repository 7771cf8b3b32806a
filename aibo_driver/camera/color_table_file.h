/// @file color_table_file.h
/// Tables of the colour detection as YAML, such as config/colors/pink_ball.yaml. A table has a name and ranges of Y, Cr
/// and Cb, each [lowest, highest] of 0..255. A range of Y begins at a multiple of 8 and ends one below a multiple of 8.
/// Where ranges of Y overlap, the last one counts. A brightness that is in no range has no colours.
#ifndef AIBO_DRIVER_CAMERA_COLOR_TABLE_FILE_H
#define AIBO_DRIVER_CAMERA_COLOR_TABLE_FILE_H

#include <string>

#include "aibo_client/colors.h"
#include "aibo_client/exceptions.h"

namespace aibo_driver::camera {

/// Thrown if a table cannot be used. The message says where and why.
class ColorTableException : public aibo_client::Exception {
 public:
  using Exception::Exception;
};

/// @param text a text in YAML
/// @param source the text's source for messages, such as the file's name
/// @throw ColorTableException the text contains no table
aibo_client::ColorTable parseColorTable(const std::string& text, const std::string& source);

/// @param file a path, or the name of a table in `folder`: pink_ball is FOLDER/pink_ball.yaml
/// @param folder the tables of this package
/// @throw ColorTableException the file cannot be read, or it contains no table
aibo_client::ColorTable loadColorTable(const std::string& file, const std::string& folder);

/// The table as YAML that parseColorTable() can read.
std::string toYaml(const aibo_client::ColorTable& table);

/// A colour that stands for the table: the middle of its ranges.
struct RgbColor {
  unsigned char red;
  unsigned char green;
  unsigned char blue;
};
RgbColor colorOf(const aibo_client::ColorTable& table);

}  // namespace aibo_driver::camera

#endif  // AIBO_DRIVER_CAMERA_COLOR_TABLE_FILE_H
