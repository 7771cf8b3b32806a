// The driver under /use_sim_time, with a clock that jumps.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/CompressedImage.h>

#include <atomic>
#include <thread>

#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"

namespace {

using test_support::DriverProcess;
using test_support::SimulatedRobot;
using test_support::TopicListener;

using CompressedListener = TopicListener<sensor_msgs::CompressedImage>;

/// Publishes a time that can be set and runs at normal speed.
class SimulatedTime {
 public:
  SimulatedTime() : publisher_(ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 10)) {
    thread_ = std::thread([this] {
      while (!stopping_) {
        rosgraph_msgs::Clock message;
        message.clock = ros::Time(seconds_ = seconds_ + 0.01);
        publisher_.publish(message);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    });
  }
  ~SimulatedTime() {
    stopping_ = true;
    thread_.join();
  }

  void set(double seconds) { seconds_ = seconds; }

 private:
  ros::Publisher publisher_;
  std::atomic<double> seconds_{1000};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

TEST(SimulatedTime, PicturesAndDiagnosticsGoOnAfterAJump) {
  SimulatedTime time;
  const SimulatedRobot robot;
  CompressedListener pictures("/jumps/camera/image_raw/compressed");
  TopicListener<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  DriverProcess driver("/jumps", robot.port());
  ASSERT_FALSE(pictures.waitForCount(5).empty());
  for (const double seconds : {500.0, 100000.0, 1000.0}) {
    time.set(seconds);
    const auto at_the_new_time = [seconds](const auto& message) {
      return std::abs(message.header.stamp.toSec() - seconds) < 60;
    };
    pictures.clear();
    diagnostics.clear();
    EXPECT_TRUE(pictures.waitFor(at_the_new_time)) << "no picture with the new time after the jump to " << seconds;
    EXPECT_TRUE(diagnostics.waitFor(at_the_new_time)) << "no diagnostics after the jump to " << seconds;
  }
  EXPECT_TRUE(driver.isRunning());
}

}  // namespace
