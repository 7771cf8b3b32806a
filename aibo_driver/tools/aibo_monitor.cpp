#include <aibo_driver/Connection.h>
#include <aibo_driver/RobotState.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "node/node.h"
#include "text/plain_text.h"
#include "tools/program.h"

namespace {

using aibo_driver::text::plainLine;
using std::chrono::steady_clock;

constexpr double kLongest = 100000;  // s; more than a day

// How many pictures came in a period, and how late.
struct Figures {
  std::size_t pictures = 0;
  std::size_t bytes = 0;
  double latencies = 0;  // s, the sum
  double worst = 0;      // s

  void add(std::size_t size, double latency) {
    ++pictures;
    bytes += size;
    latencies += latency;
    worst = std::max(worst, latency);
  }

  void print(double seconds, const std::string& stop) const {
    const auto count = static_cast<double>(pictures);
    std::printf("%5.1f pictures/s %6.1f KB/s   stamp to topic: %.1f ms (worst %.1f)%s\n", count / seconds,
                static_cast<double>(bytes) / 1000 / seconds, 1000 * latencies / count, 1000 * worst, stop.c_str());
  }
};

class Monitor {
 public:
  explicit Monitor(const ros::NodeHandle& private_handle)
      : seconds_(aibo_driver::node::readNumber(private_handle, "seconds", 0, kLongest)),
        first_picture_timeout_(
            aibo_driver::node::readNumber(private_handle, "first_picture_timeout", seconds_, kLongest)) {
    pictures_ = node_.subscribe("camera/image_raw/compressed", 100, &Monitor::onPicture, this,
                                ros::TransportHints().tcpNoDelay());
    connection_ = node_.subscribe("connection", 1, &Monitor::onConnection, this);
    states_ = node_.subscribe("robot_state", 1, &Monitor::onRobotState, this);
    timer_ = node_.createSteadyTimer(ros::WallDuration(1.0), &Monitor::onTimer, this);
  }

  bool sawPictures() const { return first_picture_time_.has_value(); }

 private:
  void onPicture(const ros::MessageEvent<const sensor_msgs::CompressedImage>& event) {
    const auto& picture = event.getMessage();
    figures_.add(picture->data.size(), (event.getReceiptTime() - picture->header.stamp).toSec());
  }

  void onConnection(const aibo_driver::Connection& connection) { connection_text_ = plainLine(connection.text, 1000); }

  void onRobotState(const aibo_driver::RobotState& state) {
    stop_text_ = state.stopped != 0 ? "   stopped by " + plainLine(state.stopped_by) + ", until release" : "";
  }

  void onTimer(const ros::SteadyTimerEvent&) {
    const auto now = steady_clock::now();
    const Figures figures = std::exchange(figures_, {});
    if (!first_picture_time_ && figures.pictures > 0) {
      first_picture_time_ = now;  // the present second has begun without pictures
    } else {
      report(figures, std::chrono::duration<double>(now - last_report_).count());
    }
    last_report_ = now;
    if (isOver(now)) {
      if (!first_picture_time_) {
        std::fprintf(stderr, "aibo_monitor: no picture came within %g s\n", first_picture_timeout_);
      }
      ros::shutdown();
    }
  }

  bool isOver(steady_clock::time_point now) const {
    const auto longer_than = [now](steady_clock::time_point begin, double limit) {
      return limit > 0 && std::chrono::duration<double>(now - begin).count() >= limit - 0.5;
    };
    return first_picture_time_ ? longer_than(*first_picture_time_, seconds_)
                               : longer_than(start_, first_picture_timeout_);
  }

  void report(const Figures& figures, double seconds) const {
    if (figures.pictures == 0) {
      std::printf("no pictures: %s%s\n", connection_text_.c_str(), stop_text_.c_str());
    } else {
      figures.print(seconds, stop_text_);
    }
    if (std::fflush(stdout) != 0) {
      ros::shutdown();  // nobody reads the output any more
    }
  }

  const double seconds_;
  const double first_picture_timeout_;
  ros::NodeHandle node_ = aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo");
  ros::Subscriber pictures_;
  ros::Subscriber connection_;
  ros::Subscriber states_;
  ros::SteadyTimer timer_;

  const steady_clock::time_point start_ = steady_clock::now();
  steady_clock::time_point last_report_ = start_;
  std::optional<steady_clock::time_point> first_picture_time_;
  Figures figures_;  ///< the figures of the present second
  std::string connection_text_ = "no driver in namespace " + node_.getNamespace() + " yet";

  std::string stop_text_;  ///< empty while the robot may move
};

constexpr char kHelp[] = R"(  rosrun aibo_driver aibo_monitor [__ns:=aibo] [_seconds:=S] [_first_picture_timeout:=S]

Prints the rate and the latency of the pictures once a second, as a subscriber gets them, and who has stopped the robot.

  ~seconds                how long to run after the first picture; 0, the default: until stopped
  ~first_picture_timeout  seconds to wait for the first picture, before it gives up and returns 1; 0: for ever.
                          The default is ~seconds
)";

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::tools::init(argc, argv, "aibo_monitor", kHelp, ros::init_options::AnonymousName);
  try {
    Monitor monitor(ros::NodeHandle("~"));
    ros::spin();
    return monitor.sawPictures() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "aibo_monitor: %s\n", error.what());
    return 1;
  }
}
