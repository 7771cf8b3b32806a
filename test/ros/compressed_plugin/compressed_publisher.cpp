#include <image_transport/simple_publisher_plugin.h>
#include <sensor_msgs/CompressedImage.h>

#include <pluginlib/class_list_macros.hpp>
#include <string>

namespace test_support {

/// Stands in for compressed_image_transport, which Debian does not have and ROS Noetic has: it publishes a message of
/// its own on TOPIC/compressed for every image on TOPIC.
class CompressedPublisher : public image_transport::SimplePublisherPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressed"; }

 protected:
  void publish(const sensor_msgs::Image& image, const PublishFn& publish_function) const override {
    sensor_msgs::CompressedImage message;
    message.header = image.header;
    message.format = "encoded a second time";
    publish_function(message);
  }
};

}  // namespace test_support

PLUGINLIB_EXPORT_CLASS(test_support::CompressedPublisher, image_transport::PublisherPlugin)
