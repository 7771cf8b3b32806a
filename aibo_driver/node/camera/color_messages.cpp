#include "node/camera/color_messages.h"

#include <sensor_msgs/image_encodings.h>

#include <cstdint>

namespace aibo_driver::node {
namespace {

// In each direction, one pixel of the plane covers this many pixels of the picture.
constexpr unsigned kScale = 2;

std::uint32_t scaled(int value) {
  return kScale * static_cast<std::uint32_t>(value);
}

// Converts a position in the plane to one in the picture. Position 0 is the middle of the first pixel in both.
float scaledPosition(double value) {
  return static_cast<float>(kScale * (value + 0.5) - 0.5);
}

std::size_t lowestChannel(unsigned pixel) {
  std::size_t channel = 0;
  while ((pixel >> channel & 1U) == 0) {
    ++channel;
  }
  return channel;
}

}  // namespace

ColorRegions toRegions(const aibo_client::DetectedColors& colors, const std_msgs::Header& header) {
  ColorRegions message;
  message.header = header;
  message.frame_number = colors.frame_number;
  message.image_count = colors.image_count;
  message.width = scaled(colors.width);
  message.height = scaled(colors.height);
  for (const aibo_client::DetectedRegion& detected : colors.regions) {
    ColorRegion& region = message.regions.emplace_back();
    region.channel = static_cast<std::uint8_t>(detected.channel);
    region.name = detected.name;
    region.pixels = kScale * kScale * detected.pixels;
    if (detected.pixels > 0) {
      region.x = scaledPosition(detected.x);
      region.y = scaledPosition(detected.y);
      region.box.x_offset = scaled(detected.left);
      region.box.y_offset = scaled(detected.top);
      region.box.width = scaled(detected.width);
      region.box.height = scaled(detected.height);
    }
  }
  return message;
}

sensor_msgs::Image toMask(const aibo_client::DetectedColors& colors, const ChannelColors& channels,
                          const std_msgs::Header& header) {
  sensor_msgs::Image image;
  image.header = header;
  image.width = static_cast<std::uint32_t>(colors.width);
  image.height = static_cast<std::uint32_t>(colors.height);
  image.encoding = sensor_msgs::image_encodings::RGB8;
  image.step = 3 * image.width;
  image.data.resize(3 * colors.mask.size());
  for (std::size_t i = 0; i < colors.mask.size(); ++i) {
    if (colors.mask[i] != 0) {
      const camera::RgbColor& color = channels.at(lowestChannel(colors.mask[i]));
      image.data[3 * i] = color.red;
      image.data[3 * i + 1] = color.green;
      image.data[3 * i + 2] = color.blue;
    }
  }
  return image;
}

}  // namespace aibo_driver::node
