#include "camera/color_table_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <vector>

#include "files/files.h"
#include "protocol/text.h"

namespace aibo_driver::camera {

using aibo_client::ColorRange;
using aibo_client::ColorTable;

namespace {

constexpr int kYPerSegment = 256 / aibo_client::kColorSegments;
// Enough for 32 ranges and comments. The limit also protects the stack, which yaml-cpp 0.6 needs for nested brackets.
constexpr std::size_t kLongestFile = 8192;

struct Range {
  int lowest;
  int highest;
};

/// True if the text can be shown in a message, in a log and on a terminal.
bool canBeShown(const std::string& text) {
  return text.size() <= 64 && protocol::isPlainText(text.data(), text.size());
}

std::string shown(const YAML::Node& node) {
  const std::string text = node ? YAML::Dump(node) : "missing";
  return canBeShown(text) ? text : "something else";
}

/// @param where the place for messages, for example "pink.yaml, range 2"
Range rangeIn(const YAML::Node& range, const std::string& key, const std::string& where) {
  const YAML::Node node = range[key];
  try {
    const auto ends = node ? node.as<std::vector<int>>() : std::vector<int>();
    if (ends.size() == 2 && ends[0] >= 0 && ends[0] <= ends[1] && ends[1] <= 255) {
      return {ends[0], ends[1]};
    }
  } catch (const YAML::Exception&) {
    // A number of this kind is refused below.
  }
  std::ostringstream text;
  text << where << ": " << key << " is " << shown(node)
       << "; it has to be [lowest, highest], two whole numbers of 0..255.";
  throw ColorTableException(text.str());
}

void addRange(const YAML::Node& node, const std::string& where, ColorTable* table) {
  if (!node.IsMap()) {
    throw ColorTableException(where +
                              ": it has to have y, cr and cb, as in {y: [0, 255], cr: [150, 230], cb: [120, "
                              "190]}.");
  }
  const Range y = rangeIn(node, "y", where);
  const Range cr = rangeIn(node, "cr", where);
  const Range cb = rangeIn(node, "cb", where);
  if (y.lowest % kYPerSegment != 0 || (y.highest + 1) % kYPerSegment != 0) {
    throw ColorTableException(
        where + ": y is [" + std::to_string(y.lowest) + ", " + std::to_string(y.highest) +
        "]; the camera divides it into steps of 8, so it has to begin at a multiple of 8 and to " +
        "end before one, such as [64, 127].");
  }
  for (int segment = y.lowest / kYPerSegment; segment <= y.highest / kYPerSegment; ++segment) {
    table->segments.at(static_cast<std::size_t>(segment)) = ColorRange{cr.lowest, cr.highest, cb.lowest, cb.highest};
  }
}

unsigned char toByte(double value) {
  return static_cast<unsigned char>(std::clamp(value, 0.0, 255.0));
}

}  // namespace

ColorTable parseColorTable(const std::string& text, const std::string& source) {
  if (text.size() > kLongestFile) {
    throw ColorTableException(source + ": it is too long for a colour table.");
  }
  YAML::Node file;
  try {
    const protocol::Text shown = protocol::textInFile(text.data(), text.size());
    file = YAML::Load(std::string(shown.begin, shown.size));
  } catch (const YAML::Exception& error) {  // the text of the exception may quote the file, which may be any file
    throw ColorTableException(source + ": it is not YAML: see its line " + std::to_string(error.mark.line + 1) + ".");
  }
  if (!file.IsMap() || !file["ranges"].IsSequence() || file["ranges"].size() == 0) {
    throw ColorTableException(source + ": it has no list of ranges, such as in config/colors/pink_ball.yaml.");
  }
  ColorTable table;
  const YAML::Node name = file["name"];
  table.name = name && name.IsScalar() ? name.as<std::string>() : "";
  if (table.name.empty() || !canBeShown(table.name)) {
    throw ColorTableException(source + ": it has to have a name of 1 to 64 bytes, without control characters.");
  }
  for (std::size_t i = 0; i < file["ranges"].size(); ++i) {
    addRange(file["ranges"][i], source + ", range " + std::to_string(i + 1), &table);
  }
  return table;
}

ColorTable loadColorTable(const std::string& file, const std::string& folder) {
  std::string path = file;
  if (file.find('/') == std::string::npos && file.find(".yaml") == std::string::npos) {
    path.insert(0, folder + "/").append(".yaml");
  }
  try {
    const std::vector<std::uint8_t> content = files::loadFile(path, kLongestFile);
    return parseColorTable(std::string(content.begin(), content.end()), path);
  } catch (const files::FileException& error) {
    throw ColorTableException(error.what());
  }
}

std::string toYaml(const ColorTable& table) {
  std::ostringstream text;
  text << "name: " << YAML::Dump(YAML::Node(table.name)) << "\nranges: [";
  const char* separator = "\n";
  for (std::size_t first = 0; first < table.segments.size();) {
    std::size_t end = first + 1;
    while (end < table.segments.size() && table.segments[end] == table.segments[first]) {
      ++end;
    }
    if (const std::optional<ColorRange>& range = table.segments[first]) {
      text << separator << "  {y: [" << first * kYPerSegment << ", " << end * kYPerSegment - 1 << "], cr: ["
           << range->cr_min << ", " << range->cr_max << "], cb: [" << range->cb_min << ", " << range->cb_max << "]}";
      separator = ",\n";
    }
    first = end;
  }
  text << "\n]\n";  // the last bracket shows whether the file was cut off
  return text.str();
}

RgbColor colorOf(const ColorTable& table) {
  double count = 0;
  double cr = 0;
  double cb = 0;
  for (const std::optional<ColorRange>& range : table.segments) {
    if (range) {
      cr += (range->cr_min + range->cr_max) / 2.0 - 128;
      cb += (range->cb_min + range->cb_max) / 2.0 - 128;
      ++count;
    }
  }
  constexpr double kBrightness = 160;  // bright enough to be seen beside black
  cr = count > 0 ? cr / count : 0;
  cb = count > 0 ? cb / count : 0;
  return {toByte(kBrightness + 1.402 * cr), toByte(kBrightness - 0.714 * cr - 0.344 * cb),
          toByte(kBrightness + 1.772 * cb)};
}

}  // namespace aibo_driver::camera
