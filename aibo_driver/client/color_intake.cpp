#include "client/color_intake.h"

#include <algorithm>
#include <utility>

#include "aibo_client/jpeg_inspector.h"
#include "client/fault.h"
#include "protocol/color_requests.h"

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

DetectedRegion regionOf(const version2::ColorRegion& region, const std::string& name) {
  constexpr double kScale = version2::COLOR_CENTROID_SCALE;
  return {region.channel, name,       region.pixels, region.x / kScale, region.y / kScale,
          region.left,    region.top, region.width,  region.height};
}

/// True if the region does not contradict itself in a plane of this size: its box is in the plane, its pixels fit into
/// the box, and their centroid is in the box.
bool isPossible(const DetectedRegion& region, int width, int height) {
  constexpr double kRounding = 0.1;  // the robot rounds to 64ths of a pixel
  if (region.pixels == 0) {
    return region.width == 0 && region.height == 0;
  }
  const auto is_in = [](double value, int first, int count) {
    return first - kRounding <= value && value <= first + count - 1 + kRounding;
  };
  return region.width >= 1 && region.height >= 1 && region.left + region.width <= width &&
         region.top + region.height <= height && region.pixels <= static_cast<unsigned>(region.width * region.height) &&
         is_in(region.x, region.left, region.width) && is_in(region.y, region.top, region.height);
}

}  // namespace

void ColorIntake::receive(const unsigned char* payload, std::size_t size, const ColorTables& tables,
                          std::chrono::steady_clock::time_point arrival) {
  const auto regions = decoded<version2::ColorRegions>(payload, size, "colours");
  if (!detection_.on) {
    return;  // the message was on its way when the detection was switched off
  }
  DetectedColors colors;
  colors.frame_number = regions.frame_number;
  colors.image_count = regions.image_count;
  colors.arrival = arrival;
  colors.connection_number = context_.number;
  colors.width = regions.width;
  colors.height = regions.height;
  if (colors.width < 1 || colors.width > kLargestPictureWidth || colors.height < 1 ||
      colors.height > kLargestPictureHeight) {
    return complain("a plane of " + std::to_string(colors.width) + "x" + std::to_string(colors.height) + " pixels");
  }
  for (std::size_t i = 0; i < regions.count; ++i) {
    if (const ColorTablePtr& table = tables.at(regions.regions[i].channel)) {
      colors.regions.push_back(regionOf(regions.regions[i], table->name));
    }
  }
  if (regions.has_plane) {
    colors.mask.resize(static_cast<std::size_t>(colors.width) * static_cast<std::size_t>(colors.height));
    expectGood(version2::unpackColorPlane(regions.plane, regions.plane_size, colors.mask.size(), colors.mask.data()),
               "colours");
  }
  dropImpossible(&colors);
  newest_ = std::move(colors);
}

void ColorIntake::deliver() {
  if (const std::optional<DetectedColors> colors = std::exchange(newest_, std::nullopt)) {
    context_.notifier.tell(&Callbacks::on_colors, "on_colors", *colors);
  }
}

void ColorIntake::dropImpossible(DetectedColors* colors) {
  std::vector<DetectedRegion>& regions = colors->regions;
  const auto is_impossible = [&](const DetectedRegion& region) {
    if (isPossible(region, colors->width, colors->height)) {
      return false;
    }
    complain(std::to_string(region.pixels) + " pixels of " + region.name + " in a box of " +
             std::to_string(region.width) + "x" + std::to_string(region.height));
    return true;
  };
  regions.erase(std::remove_if(regions.begin(), regions.end(), is_impossible), regions.end());
}

void ColorIntake::complain(const std::string& problem) {
  ++context_.counters.impossible_values;
  context_.warnOnce("colours", "sent impossible colours, which are dropped: " + problem);
}

}  // namespace aibo_client
