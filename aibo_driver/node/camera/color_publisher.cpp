#include "node/camera/color_publisher.h"

#include "camera/camera_options.h"

namespace aibo_driver::node {
namespace {

constexpr camera::RgbColor kWhite = {255, 255, 255};
constexpr std::uint32_t kColorQueueSize = 5;  // the same size as for pictures

}  // namespace

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
