#include "node/camera/raw_image_publisher.h"

#include <ros/console.h>
#include <ros/param.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace aibo_driver::node {
namespace {

constexpr double kWarnPeriod = 10.0;  // seconds

// image_transport reads this list when the topic is advertised. The user's entries are kept.
void disableCompressedPlugins(const std::string& resolved_topic) {
  const std::string parameter = resolved_topic + "/disable_pub_plugins";
  std::vector<std::string> disabled;
  ros::param::get(parameter, disabled);
  // For colour images, compressedDepth publishes nothing but errors.
  for (const char* plugin : {"image_transport/compressed", "image_transport/compressedDepth"}) {
    if (std::find(disabled.begin(), disabled.end(), plugin) == disabled.end()) {
      disabled.push_back(plugin);
    }
  }
  ros::param::set(parameter, disabled);
}

}  // namespace

RawImagePublisher::RawImagePublisher(const ros::NodeHandle& handle, const std::string& topic,
                                     std::function<void()> subscribers_changed) {
  disableCompressedPlugins(handle.resolveName(topic));
  image_transport::SubscriberStatusCallback on_change;
  if (subscribers_changed) {
    on_change = [subscribers_changed](const image_transport::SingleSubscriberPublisher&) { subscribers_changed(); };
  }
  publisher_ = image_transport::ImageTransport(handle).advertise(topic, 1, on_change, on_change);
  thread_ = std::thread(&RawImagePublisher::run, this);
}

RawImagePublisher::~RawImagePublisher() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();         // the thread may be publishing, so it has to end before the shutdown
  publisher_.shutdown();  // waits for a subscribers_changed that is running
}

void RawImagePublisher::publish(const sensor_msgs::CompressedImageConstPtr& picture) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    statistics_.skipped += waiting_ ? 1 : 0;
    waiting_ = picture;
  }
  changed_.notify_one();
}

bool RawImagePublisher::hasSubscribers() const {
  return publisher_.getNumSubscribers() > 0;
}

RawImagePublisher::Statistics RawImagePublisher::statistics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return statistics_;
}

void RawImagePublisher::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || waiting_; });
    if (stopping_) {
      return;
    }
    const sensor_msgs::CompressedImageConstPtr picture = std::move(waiting_);
    waiting_.reset();
    lock.unlock();
    decodeAndPublish(*picture);
    lock.lock();
  }
}

void RawImagePublisher::decodeAndPublish(const sensor_msgs::CompressedImage& picture) {
  try {
    camera::BgrImage decoded = camera::decodeJpeg(picture.data.data(), picture.data.size());
    const auto image = boost::make_shared<sensor_msgs::Image>();
    image->header = picture.header;
    image->width = static_cast<std::uint32_t>(decoded.width);
    image->height = static_cast<std::uint32_t>(decoded.height);
    image->encoding = sensor_msgs::image_encodings::BGR8;
    image->step = 3 * image->width;
    image->data = std::move(decoded.pixels);
    publisher_.publish(sensor_msgs::ImageConstPtr(image));
    const std::lock_guard<std::mutex> lock(mutex_);
    ++statistics_.published;
  } catch (const camera::DecodeException& error) {
    ROS_WARN_STREAM_THROTTLE_NAMED(kWarnPeriod, "decoder", "A picture was not decoded: " << error.what());
    const std::lock_guard<std::mutex> lock(mutex_);
    ++statistics_.decode_errors;
  }
}

}  // namespace aibo_driver::node
