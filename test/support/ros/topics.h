/// @file topics.h
#ifndef TEST_SUPPORT_ROS_TOPICS_H
#define TEST_SUPPORT_ROS_TOPICS_H

#include <ros/node_handle.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "support/safety_net.h"

namespace test_support {

/// Subscribes to a topic, keeps all messages, and lets tests wait for them.
template <typename Message>
class TopicListener {
 public:
  using ConstPtr = boost::shared_ptr<const Message>;

  explicit TopicListener(const std::string& topic) {
    subscriber_ = ros::NodeHandle().subscribe<Message>(topic, 1000, [this](const ConstPtr& message) {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        messages_.push_back(message);
      }
      changed_.notify_all();
    });
  }

  ~TopicListener() { subscriber_.shutdown(); }

  /// Waits until there are this many messages.
  /// @return all messages; fewer than `count` if they did not come in time
  std::vector<ConstPtr> waitForCount(std::size_t count, std::chrono::milliseconds timeout = kSafetyNet) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, timeout, [this, count] { return messages_.size() >= count; });
    return messages_;
  }

  /// Waits for a message that fulfils the condition, among those so far and new ones.
  /// @return null if it did not come in time
  template <typename Condition>
  ConstPtr waitFor(Condition condition, std::chrono::milliseconds timeout = kSafetyNet) {
    ConstPtr found;
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, timeout, [this, &condition, &found] {
      for (const ConstPtr& message : messages_) {
        if (condition(*message)) {
          found = message;
          return true;
        }
      }
      return false;
    });
    return found;
  }

  /// Waits for the first message; one that has come already counts, such as that of a latched topic.
  ConstPtr waitForFirst() {
    return waitFor([](const Message&) { return true; });
  }

  /// Waits for a message that comes after this call.
  ConstPtr waitForNext(std::chrono::milliseconds timeout = kSafetyNet) {
    const std::size_t before = count();
    const std::vector<ConstPtr> messages = waitForCount(before + 1, timeout);
    return messages.size() > before ? messages[before] : nullptr;
  }

  std::size_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.size();
  }

  /// Forgets all messages.
  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.clear();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<ConstPtr> messages_;
  ros::Subscriber subscriber_;
};

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

#endif  // TEST_SUPPORT_ROS_TOPICS_H
