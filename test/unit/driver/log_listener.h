/// @file log_listener.h
#ifndef TEST_UNIT_DRIVER_LOG_LISTENER_H
#define TEST_UNIT_DRIVER_LOG_LISTENER_H

#include <ros/console.h>

#include <string>
#include <vector>

namespace test_support {

struct LogListener : public ros::console::LogAppender {
  LogListener() { ros::console::register_appender(this); }
  void log(ros::console::Level /*level*/, const char* text, const char* /*file*/, const char* /*function*/,
           int /*line*/) override {
    texts.emplace_back(text);
  }
  std::vector<std::string> texts;
};

/// Has what is logged from now on.
inline const std::vector<std::string>& listenToLog() {
  // It stays registered, because Debian 11's rosconsole crashes when a listener goes.
  static auto* const listener = new LogListener;
  listener->texts.clear();
  return listener->texts;
}

}  // namespace test_support

#endif  // TEST_UNIT_DRIVER_LOG_LISTENER_H
