#include "simulator/ers7/camera/photo_show.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "simulator/ers7/camera/photograph.h"

namespace simulated_ers7 {
namespace {

std::vector<std::filesystem::path> photographsIn(const std::string& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.is_regular_file() && isPhotographName(entry.path())) {
      files.push_back(entry.path());
    }
  }
  if (error) {
    throw PhotographError("cannot open the folder of pictures " + folder + ": " + error.message());
  }
  if (files.empty()) {
    throw PhotographError("no picture in the folder " + folder + ": it needs files that end in .jpg, .jpeg or .ppm");
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

PhotoShow::PhotoShow(const std::string& folder, double seconds_per_picture)
    : seconds_per_picture_(seconds_per_picture) {
  if (!(seconds_per_picture > 0)) {
    throw PhotographError("a picture must be shown for more than 0 seconds, not " +
                          std::to_string(seconds_per_picture));
  }
  for (const auto& file : photographsIn(folder)) {
    pictures_.push_back(readPhotograph(file));
  }
}

const YCrCbImage& PhotoShow::picture(double seconds, longword /*image_number*/, const CameraSettings& /*settings*/) {
  const auto turn = static_cast<std::uint64_t>(seconds / seconds_per_picture_);
  return pictures_[static_cast<std::size_t>(turn % pictures_.size())];
}

}  // namespace simulated_ers7
