/// @file log_listener.h
#ifndef TEST_SUPPORT_ROS_LOG_LISTENER_H
#define TEST_SUPPORT_ROS_LOG_LISTENER_H

#include <ros/console.h>

#include <string>
#include <vector>

namespace test_support {

/// Keeps what is logged. It stays registered, because Debian 11's rosconsole crashes when a listener goes.
class LogListener : public ros::console::LogAppender {
 public:
  LogListener() { ros::console::register_appender(this); }

  void log(ros::console::Level /*level*/, const char* text, const char* /*file*/, const char* /*function*/,
           int /*line*/) override {
    texts.emplace_back(text);
  }

  std::vector<std::string> texts;
};

/// Has what is logged from now on.
inline const LogListener& listenToLog() {
  static auto* const listener = new LogListener;
  listener->texts.clear();
  return *listener;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_LOG_LISTENER_H
