#include "node/camera/color_publisher.h"

#include <sensor_msgs/image_encodings.h>

#include <cstddef>
#include <cstdint>

#include "camera/camera_options.h"

namespace aibo_driver::node {
namespace {

constexpr camera::RgbColor kWhite = {255, 255, 255};
constexpr std::uint32_t kColorQueueSize = 5;  // the same size as for pictures

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

ColorPublisher::ColorPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                               robot_time::RobotClock* robot_clock,
                               const std::function<void(const aibo_client::ColorDetection&)>& detect)
    : frame_id_(parameters.frame(parameters.frame_id)), stamper_(robot_clock, parameters.time_offset) {
  channel_colors_.fill(kWhite);
  ros::NodeHandle topics(handle);
  const ros::SubscriberStatusCallback on_change =
      [this, detect,
       every_nth_image = camera::everyNthImageOf(parameters.color_rate)](const ros::SingleSubscriberPublisher&) {
        const bool with_mask = mask_.getNumSubscribers() > 0;
        detect({with_mask || regions_.getNumSubscribers() > 0, every_nth_image, with_mask});
      };
  regions_ = topics.advertise<ColorRegions>("color_regions", kColorQueueSize, on_change, on_change);
  mask_ = topics.advertise<sensor_msgs::Image>("color_mask", kColorQueueSize, on_change, on_change);
}

void ColorPublisher::setTable(int channel, const aibo_client::ColorTablePtr& table) {
  const std::lock_guard<std::mutex> lock(mutex_);
  channel_colors_.at(static_cast<std::size_t>(channel)) = table ? camera::colorOf(*table) : kWhite;
}

void ColorPublisher::publish(const aibo_client::DetectedColors& colors) {
  std_msgs::Header header;
  header.stamp = stamper_.stamp(colors);
  header.frame_id = frame_id_;
  if (regions_.getNumSubscribers() > 0) {
    regions_.publish(toRegions(colors, header));
  }
  if (!colors.mask.empty() && mask_.getNumSubscribers() > 0) {
    ChannelColors channels;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      channels = channel_colors_;
    }
    mask_.publish(toMask(colors, channels, header));
  }
}

}  // namespace aibo_driver::node
