// Prints the rate and the latency of the pictures once a second, as a subscriber gets them. It also prints whether
// somebody has stopped the robot.
//
// Start it in the driver's namespace. The root namespace means /aibo.
// Parameters:
//   ~seconds                how long to run after the first picture; 0, the default: until stopped
//   ~first_picture_timeout  seconds to wait for the first picture before it gives up and returns 1; 0: for ever.
//                           The default is ~seconds

#include <aibo_driver/Connection.h>
#include <aibo_driver/RobotState.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "node/node.h"
#include "text/number.h"
#include "text/plain_text.h"
#include "tools/node_process.h"
#include "tools/picture_figures.h"

namespace aibo_driver::tools {
namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr double kLongest = 100000;          // s; more than a day
constexpr std::size_t kMostArrivals = 1000;  // in a second; a robot does not send more

nanoseconds sinceEpoch(const ros::Time& time) {
  return nanoseconds(time.toNSec());
}

class Monitor {
 public:
  explicit Monitor(const ros::NodeHandle& private_handle)
      : seconds_(node::readNumber(private_handle, "seconds", 0, kLongest)),
        first_picture_timeout_(node::readNumber(private_handle, "first_picture_timeout", seconds_, kLongest)) {
    pictures_ = node_.subscribe("camera/image_raw/compressed", 100, &Monitor::onPicture, this,
                                ros::TransportHints().tcpNoDelay());
    connection_ = node_.subscribe("connection", 1, &Monitor::onConnection, this);
    states_ = node_.subscribe("robot_state", 1, &Monitor::onRobotState, this);
    timer_ = node_.createSteadyTimer(ros::WallDuration(1.0), &Monitor::onTimer, this);
  }

  bool sawPictures() const { return first_picture_time_.has_value(); }

 private:
  struct Arrival {
    sensor_msgs::CompressedImageConstPtr picture;
    nanoseconds time;
  };

  void onPicture(const ros::MessageEvent<sensor_msgs::CompressedImage const>& event) {
    if (arrivals_.size() < kMostArrivals) {
      arrivals_.push_back({event.getConstMessage(), sinceEpoch(event.getReceiptTime())});
    }
    publisher_ = event.getPublisherName();
  }

  void onConnection(const Connection& connection) { connection_text_ = text::plainLine(connection.text, 1000); }

  void onRobotState(const RobotState& state) {
    stop_text_ = state.stopped != 0 ? "   stopped by " + text::plainLine(state.stopped_by) + ", until release" : "";
  }

  void onTimer(const ros::SteadyTimerEvent&) {
    const auto now = steady_clock::now();
    if (!first_picture_time_ && !arrivals_.empty()) {
      first_picture_time_ = now;  // the present second is not a whole one
      arrivals_.clear();
      driverLoad(now - last_report_);
    } else {
      report(now - last_report_);
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

  void report(nanoseconds elapsed) {
    PictureFigures figures;
    for (const Arrival& arrival : std::exchange(arrivals_, {})) {
      figures.add(arrival.picture->data.size(), arrival.time - sinceEpoch(arrival.picture->header.stamp));
    }
    const std::string driver_load = driverLoad(elapsed);
    if (figures.empty()) {
      std::printf("no pictures: %s%s\n", connection_text_.c_str(), stop_text_.c_str());
    } else {
      std::printf("%s   driver: %s of one processor%s\n", figures.words(elapsed).c_str(), driver_load.c_str(),
                  stop_text_.c_str());
    }
    if (std::fflush(stdout) != 0) {
      ros::shutdown();  // nobody reads the output any more
    }
  }

  // The share of one processor that the driver has used since the last call.
  std::string driverLoad(nanoseconds elapsed) {
    if (publisher_ != driver_name_) {
      driver_name_ = publisher_;
      driver_process_ = processOfNode(publisher_);
      driver_time_.reset();
    }
    const auto used = driver_process_ ? processorTime(*driver_process_) : std::nullopt;
    if (!used) {
      driver_name_.clear();  // the next call looks again, because a driver may be started again under its name
    }
    const auto used_before = std::exchange(driver_time_, used);
    if (!used || !used_before) {
      return "unknown share";
    }
    const double share = std::chrono::duration<double>(*used - *used_before) / std::chrono::duration<double>(elapsed);
    return text::decimal(100.0 * share, 1) + " %";
  }

  const double seconds_;
  const double first_picture_timeout_;
  ros::NodeHandle node_ = node::inDriverNamespace(ros::NodeHandle(), "aibo");
  ros::Subscriber pictures_;
  ros::Subscriber connection_;
  ros::Subscriber states_;
  ros::SteadyTimer timer_;

  const steady_clock::time_point start_ = steady_clock::now();
  steady_clock::time_point last_report_ = start_;
  std::optional<steady_clock::time_point> first_picture_time_;
  std::vector<Arrival> arrivals_;
  std::string connection_text_ = "no driver in namespace " + node_.getNamespace() + " yet";

  std::string stop_text_;  ///< empty while the robot may move

  std::string publisher_;
  std::string driver_name_;
  std::optional<pid_t> driver_process_;
  std::optional<nanoseconds> driver_time_;
};

}  // namespace
}  // namespace aibo_driver::tools

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_monitor", ros::init_options::AnonymousName);
  try {
    aibo_driver::tools::Monitor monitor(ros::NodeHandle("~"));
    ros::spin();
    return monitor.sawPictures() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "aibo_monitor: %s\n", error.what());
    return 1;
  }
}
