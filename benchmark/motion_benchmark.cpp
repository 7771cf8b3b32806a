// Measures the time from a ROS message until the command to a servo changes, compared with one byte over TCP, and how
// much 18 moving joints slow down the stream of pictures. Driver, robot and this program communicate over 127.0.0.1. It
// takes two minutes, needs a ROS master and has no arguments:
//
//   roscore &
//   make motion_benchmark && rosrun aibo_driver motion_benchmark
//
// The robot takes commands in frames of 8 ms. A command at a random time waits 4 ms on average for the next frame: the
// line "next frame" is this wait alone. A moving joint reacts later than one at rest, because up to 64 ms of motion are
// already in the robot's two command vectors.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "robot_model/robot_model.h"
#include "simulator/ers7/body/primitive_table.h"
#include "simulator/ers7/camera/camera.h"
#include "simulator/ers7/simulated_ers7.h"
#include "support/robot_thread.h"
#include "support/ros/driver_process.h"

namespace {

using SteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr char kNamespace[] = "/motion_benchmark";
constexpr char kJoint[] = "head_pan";
constexpr int kCommands = 200;
constexpr seconds kPictureTime{15};
constexpr milliseconds kCommandPeriod{32};  // 31.25 Hz
constexpr seconds kSafetyNet{30};

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
}

double millisecondsSince(SteadyClock::time_point begin) {
  return std::chrono::duration<double, std::milli>(SteadyClock::now() - begin).count();
}

// How many images the camera has taken, and when.
struct CameraCount {
  longword last_frame = 0;
  int images = 0;
};

// A robot that detects when the motion of one joint changes, and counts the images of its camera.
class WatchedErs7 : public simulated_ers7::SimulatedErs7 {
 public:
  void passFrame(longword frame, const openr_host::EffectorCommands& commands) override {
    const SteadyClock::time_point now = SteadyClock::now();
    watch(commands, now);
    SimulatedErs7::passFrame(frame, commands);
  }

  RCRegion* captureImage(longword frame) override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      camera_ = {frame, camera_.images + 1};
    }
    changed_.notify_all();
    return SimulatedErs7::captureImage(frame);
  }

  // Begins to wait for a change of motion.
  void expectChange() {
    const std::lock_guard<std::mutex> lock(mutex_);
    expected_ = true;
    step_before_ = step_;
  }

  // Waits for the frame whose command moves the joint differently than at expectChange().
  // @return the time of this frame
  SteadyClock::time_point waitForChange() {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!changed_.wait_for(lock, kSafetyNet, [this] { return !expected_; })) {
      throw std::runtime_error("the joint does not move");
    }
    return changed_at_;
  }

  CameraCount waitForNextImage() {
    std::unique_lock<std::mutex> lock(mutex_);
    const int before = camera_.images;
    if (!changed_.wait_for(lock, kSafetyNet, [&] { return camera_.images > before; })) {
      throw std::runtime_error("the camera takes no pictures");
    }
    return camera_;
  }

 private:
  // At rest every step is 0. In motion all steps are equal, except for rounding.
  static constexpr slongword kRounding = 10;  // microradian

  void watch(const openr_host::EffectorCommands& commands, SteadyClock::time_point now) {
    const std::lock_guard<std::mutex> lock(mutex_);
    step_ = 0;
    for (const openr_host::EffectorCommand& command : commands) {
      if (command.primitive == primitive_) {
        const slongword position = command.value.value[0];
        step_ = position - position_;
        position_ = position;
      }
    }
    if (expected_ && std::abs(step_ - step_before_) > kRounding) {
      expected_ = false;
      changed_at_ = now;
      changed_.notify_all();
    }
  }

  const OPrimitiveID primitive_ =
      simulated_ers7::jointPrimitive(static_cast<std::size_t>(robot_model::findJointByName(ers7(), kJoint)));
  std::mutex mutex_;
  std::condition_variable changed_;
  slongword position_ = 0;  // microradian, like the steps
  slongword step_ = 0;
  slongword step_before_ = 0;
  bool expected_ = false;
  SteadyClock::time_point changed_at_;
  CameraCount camera_;
};

void check(bool success, const char* what) {
  if (!success) {
    throw std::runtime_error(std::string(what) + " failed");
  }
}

// A TCP connection on 127.0.0.1 whose other end echoes every byte.
class ByteEcho {
 public:
  ByteEcho() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof(address);
    void* const storage = &address;
    auto* const generic = static_cast<sockaddr*>(storage);
    const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
    check(::bind(listener, generic, length) == 0 && ::listen(listener, 1) == 0, "listening");
    check(::getsockname(listener, generic, &length) == 0, "getsockname");
    near_ = ::socket(AF_INET, SOCK_STREAM, 0);
    check(::connect(near_, generic, length) == 0, "connecting");
    far_ = ::accept(listener, nullptr, nullptr);
    check(far_ >= 0, "accepting");
    ::close(listener);
    sendAtOnce(near_);
    sendAtOnce(far_);
    thread_ = std::thread([this] { echo(); });
  }

  ~ByteEcho() {
    ::shutdown(near_, SHUT_RDWR);
    thread_.join();
    ::close(near_);
    ::close(far_);
  }

  ByteEcho(const ByteEcho&) = delete;
  ByteEcho& operator=(const ByteEcho&) = delete;

  double roundTrip() const {
    char byte = 'a';
    const SteadyClock::time_point begin = SteadyClock::now();
    check(::write(near_, &byte, 1) == 1 && ::read(near_, &byte, 1) == 1, "the byte's round trip");
    return millisecondsSince(begin);
  }

 private:
  static void sendAtOnce(int socket) {
    const int on = 1;
    check(::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on)) == 0, "TCP_NODELAY");
  }

  void echo() const {
    char byte = 0;
    while (::read(far_, &byte, 1) == 1 && ::write(far_, &byte, 1) == 1) {
    }
  }

  int near_ = -1;
  int far_ = -1;
  std::thread thread_;
};

// A user of the driver.
class User {
 public:
  User() {
    pictures_ = handle_.subscribe<sensor_msgs::CompressedImage>(
        "camera/image_raw/compressed", 1000, [this](const sensor_msgs::CompressedImageConstPtr&) { ++received_; },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
    all_joints_ = handle_.advertise<sensor_msgs::JointState>("joint_command", 100);
    one_joint_ = handle_.advertise<std_msgs::Float64>(std::string(kJoint) + "_position_controller/command", 100);
    spinner_.start();
  }

  void waitForDriver() {
    const SteadyClock::time_point end = SteadyClock::now() + kSafetyNet;
    while (all_joints_.getNumSubscribers() == 0 || one_joint_.getNumSubscribers() == 0 ||
           pictures_.getNumPublishers() == 0) {
      check(ros::ok() && SteadyClock::now() < end, "waiting for the driver");
      std::this_thread::sleep_for(milliseconds(10));
    }
  }

  void setStreaming(bool on) {
    std_srvs::SetBool service;
    service.request.data = on;
    check(ros::service::call(std::string(kNamespace) + "/set_streaming", service) && service.response.success,
          "set_streaming");
  }

  // Velocity in rad/s; 0 is as fast as allowed.
  void command(double position, double velocity = 0) {
    sensor_msgs::JointState message;
    message.name = {kJoint};
    message.position = {position};
    message.velocity = {velocity};
    all_joints_.publish(message);
  }

  void commandOnItsTopic(double position) {
    std_msgs::Float64 message;
    message.data = position;
    one_joint_.publish(message);
  }

  // Moves all joints to this fraction of their ranges. From 0.5 to 0.7, no joint is in the way of another.
  void commandAll(double fraction) {
    sensor_msgs::JointState message;
    for (int i = 0; i < ers7().number_of_joints; ++i) {
      const robot_model::Joint& joint = ers7().joints[i];
      message.name.emplace_back(joint.name);
      message.position.push_back((joint.lowest + fraction * (joint.highest - joint.lowest)) / 1e6);
    }
    all_joints_.publish(message);
  }

  int picturesReceived() const { return received_; }

 private:
  ros::NodeHandle handle_{kNamespace};
  std::atomic<int> received_{0};
  ros::Subscriber pictures_;
  ros::Publisher all_joints_;
  ros::Publisher one_joint_;
  ros::AsyncSpinner spinner_{1};
};

class MotionBenchmark {
 public:
  void run() {
    user_.waitForDriver();
    user_.command(0);
    std::this_thread::sleep_for(seconds(2));  // the motors are switched on, and the joint moves to 0
    measureMotion();
    measurePictures();
  }

 private:
  using Samples = std::vector<double>;  // ms

  // A small step, which ends long before the next one.
  static double smallStep(bool left) { return left ? 0.01 : -0.01; }

  void measureMotion() {
    const auto command = [this](bool left) { user_.command(smallStep(left)); };
    const auto command_on_its_topic = [this](bool left) { user_.commandOnItsTopic(smallStep(left)); };
    // To a distant position; the next command comes long before the joint arrives.
    const auto turn_round = [this](bool left) { user_.command(left ? 0.5 : -0.5, 0.3); };

    const Samples at_rest = timesToMotion(command);
    const Samples on_its_topic = timesToMotion(command_on_its_topic);
    user_.setStreaming(true);
    const Samples with_stream = timesToMotion(command);
    const Samples on_its_way = timesToMotion(turn_round);

    std::printf("Command to motion, %d commands each              p50 ms    p99 ms   p50 / byte\n", kCommands);
    print("one byte there and back by TCP", bytes_);
    print("next frame", framesToWait());
    print("joint_command", at_rest);
    print("its own topic (collects for 4 ms)", on_its_topic);
    print("joint_command, camera streams", with_stream);
    print("joint_command, camera streams, joint on its way", on_its_way);
    std::printf("\n");
  }

  // Also fills bytes_, alternately, so that both are measured under the same load.
  Samples timesToMotion(const std::function<void(bool)>& command) {
    Samples samples;
    for (int i = 0; i < kCommands; ++i) {
      sleepAtRandom();
      bytes_.push_back(byte_.roundTrip());
      sleepAtRandom();
      robot_.expectChange();
      const SteadyClock::time_point begin = SteadyClock::now();
      command(i % 2 == 0);
      samples.push_back(std::chrono::duration<double, std::milli>(robot_.waitForChange() - begin).count());
    }
    return samples;
  }

  // Two of these are longer than two command vectors, 64 ms, so that a joint comes to rest.
  void sleepAtRandom() {
    std::this_thread::sleep_for(
        std::chrono::duration<double, std::milli>(std::uniform_real_distribution<double>(40, 60)(random_)));
  }

  static Samples framesToWait() {
    Samples samples;
    for (int i = 0; i < kCommands; ++i) {
      samples.push_back(8.0 * i / kCommands);
    }
    return samples;
  }

  void print(const char* what, const Samples& samples) const {
    std::printf("%-48s %6.2f    %6.2f   %10.0f\n", what, percentile(samples, 50), percentile(samples, 99),
                percentile(samples, 50) / percentile(bytes_, 50));
  }

  static double percentile(Samples samples, std::size_t percent) {
    std::sort(samples.begin(), samples.end());
    return samples[samples.size() * percent / 100];
  }

  void measurePictures() {
    std::printf("Pictures in %d s                          camera's  left out  published  per second\n",
                static_cast<int>(kPictureTime.count()));
    const double still =
        countPictures("joints at rest", [](SteadyClock::time_point end) { std::this_thread::sleep_until(end); });
    const double moving =
        countPictures("18 joints commanded at 31.25 Hz", [this](SteadyClock::time_point end) { moveAllJoints(end); });
    std::printf("Pictures per second, moving / at rest: %.3f\n", moving / still);
  }

  double countPictures(const char* what, const std::function<void(SteadyClock::time_point)>& meanwhile) {
    const CameraCount camera_before = nextImage();
    const int published_before = user_.picturesReceived();
    const SteadyClock::time_point begin = SteadyClock::now();
    meanwhile(begin + kPictureTime);
    const CameraCount camera = nextImage();
    const int published = user_.picturesReceived() - published_before;
    const double duration = millisecondsSince(begin) / 1e3;
    const int due = static_cast<int>(simulated_ers7::imagesUpTo(camera.last_frame) -
                                     simulated_ers7::imagesUpTo(camera_before.last_frame));
    std::printf("%-42s %6d  %8d  %9d  %10.2f\n", what, due, due - (camera.images - camera_before.images), published,
                published / duration);
    return published / duration;
  }

  // Returns when the picture should have been published, long before the next image.
  CameraCount nextImage() {
    const CameraCount camera = robot_.waitForNextImage();
    std::this_thread::sleep_for(milliseconds(16));
    return camera;
  }

  void moveAllJoints(SteadyClock::time_point end) {
    int i = 0;
    for (SteadyClock::time_point next = SteadyClock::now(); next < end; next += kCommandPeriod) {
      std::this_thread::sleep_until(next);
      user_.commandAll(0.6 + 0.03 * std::sin(0.2 * i));
      ++i;
    }
  }

  WatchedErs7 robot_;
  test_support::RobotThread robot_thread_{robot_};
  User user_;
  test_support::DriverProcess driver_{kNamespace, robot_thread_.port(), {"_stream_on_start:=false"}};
  ByteEcho byte_;
  std::mt19937 random_{1};
  Samples bytes_;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    ros::init(argc, argv, "motion_benchmark", ros::init_options::AnonymousName);
    if (!ros::master::check()) {
      throw std::runtime_error("there is no ROS master: start roscore first");
    }
    MotionBenchmark().run();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "motion_benchmark: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
