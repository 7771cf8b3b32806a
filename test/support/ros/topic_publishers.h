/// @file topic_publishers.h
#ifndef TEST_SUPPORT_ROS_TOPIC_PUBLISHERS_H
#define TEST_SUPPORT_ROS_TOPIC_PUBLISHERS_H

#include <ros/node_handle.h>

#include <map>
#include <string>

#include "support/ros/topic_listener.h"

namespace test_support {

/// Publishes on topics of a driver. Before the first message on a topic, waits until the driver has subscribed.
class TopicPublishers {
 public:
  explicit TopicPublishers(const std::string& name_space) : name_space_(name_space) {}

  template <typename Message>
  void publish(const std::string& topic, const Message& message) {
    publisherOf<Message>(topic).publish(message);
  }

  /// A publisher to which the driver has subscribed.
  template <typename Message>
  ros::Publisher& publisherOf(const std::string& topic) {
    ros::Publisher& publisher = publishers_[topic];
    if (!publisher) {
      publisher = ros::NodeHandle().advertise<Message>(name_space_ + "/" + topic, 100);
      eventually([&] { return publisher.getNumSubscribers() > 0; });
    }
    return publisher;
  }

 protected:
  const std::string name_space_;

 private:
  std::map<std::string, ros::Publisher> publishers_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_TOPIC_PUBLISHERS_H
