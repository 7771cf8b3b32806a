/// @file fake_driver.h
#ifndef TEST_ROS_FAKE_DRIVER_H
#define TEST_ROS_FAKE_DRIVER_H

#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <vector>

namespace test_support {

/// The part of a driver that programs see which steer or move the robot.
class FakeDriver {
 public:
  /// @param before_release called before a call of release is answered
  explicit FakeDriver(
      const std::string& name_space, const std::function<void()>& before_release = [] {})
      : handle_(name_space) {
    constexpr bool kLatched = true;
    state_ = handle_.advertise<aibo_driver::RobotState>("robot_state", 1, kLatched);
    motion_ = handle_.advertise<aibo_driver::MotionState>("motion_state", 10, kLatched);
    mask_ = handle_.advertise<sensor_msgs::Image>("color_mask", 1);
    release_ = serve("release", [this, before_release] {
      before_release();
      release();
    });
    stop_ = serve("stop", [this] { stop("/caller"); });
    move({});
    release();
    // Not a ros::Timer: one of its callbacks can come after the destructor has stopped it.
    senses_ = std::async(std::launch::async, [this, end = end_.get_future()] {
      constexpr std::chrono::milliseconds kPeriod{50};
      while (end.wait_for(kPeriod) == std::future_status::timeout) {
        sense();
      }
    });
  }

  ~FakeDriver() {
    end_.set_value();
    senses_.wait();
  }

  /// @param node empty: nobody stops it
  void stop(const std::string& node) {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_now_.stopped = node.empty() ? 0 : 1;
    state_now_.stopped_by = node;
    state_.publish(state_now_);
  }
  void release() { stop(""); }

  void tell(std::uint8_t motors, std::uint8_t posture) {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_now_.motors = motors;
    state_now_.posture = posture;
    state_.publish(state_now_);
  }

  /// What moves the robot from now on.
  void move(const std::vector<aibo_driver::Movement>& movements) {
    aibo_driver::MotionState state;
    state.movements = movements;
    motion_.publish(state);
  }

  /// The camera sees a ball of this width. All in pixels of the mask; 0: no ball.
  void showBall(unsigned left, unsigned width) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ball_left_ = left;
    ball_width_ = width;
  }

 private:
  ros::ServiceServer serve(const std::string& name, const std::function<void()>& act) {
    return handle_.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
        name, [act](std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
          act();
          response.success = 1;
          return true;
        });
  }

  void sense() {
    sensor_msgs::Image black;
    black.header.frame_id = "camera_optical_frame";
    black.header.stamp = ros::Time(7);
    black.width = 104;
    black.height = 80;
    black.step = 3 * black.width;
    black.encoding = "rgb8";
    black.data.resize(black.step * black.height);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (unsigned i = 0; i < ball_width_ * ball_width_; ++i) {
        black.data.at((20 + i / ball_width_) * black.step + 3 * (ball_left_ + i % ball_width_)) = 1;
      }
    }
    mask_.publish(black);
  }

  ros::NodeHandle handle_;
  std::mutex mutex_;  ///< guards the data, because services are called on several threads
  aibo_driver::RobotState state_now_;
  unsigned ball_left_ = 0;
  unsigned ball_width_ = 0;
  ros::Publisher state_;
  ros::Publisher motion_;
  ros::Publisher mask_;
  ros::ServiceServer release_;
  ros::ServiceServer stop_;
  std::promise<void> end_;
  std::future<void> senses_;
};

}  // namespace test_support

#endif  // TEST_ROS_FAKE_DRIVER_H
