// Measures what a driver costs and how long pictures take through it: ours as node and nodelet, the least that a node
// can do, an MJPEG reader in Python, and OpenCV. All get the same JPEGs at the same rate from this process, over
// 127.0.0.1, and publish to a subscriber in it. Processor time is that of the driver's process alone.
//
//   driver_benchmark [--rounds N] [--seconds N]
//
// Needs a ROS master.
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <boost/program_options.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "driver/mjpeg_server.h"
#include "figures.h"
#include "process_cost.h"
#include "support/picture_server.h"
#include "support/process.h"
#include "support/program.h"
#include "support/ros/driver_process.h"
#include "support/test_pictures.h"

namespace {

namespace po = boost::program_options;
using benchmark_figures::atMost;
using benchmark_figures::print;
using benchmark_figures::quantile;
using benchmark_figures::Rounds;
using std::chrono::microseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr char kNamespace[] = "/driver_benchmark";
constexpr microseconds kCameraPeriod{33445};  // of the ERS-7: 29.9 pictures a second
constexpr seconds kWarmUp{2};
constexpr seconds kSafetyNet{30};

enum class Subscription { kNone, kCompressed, kRaw };

/// The pictures' sources, and what they have sent.
struct Sources {
  test_support::PictureServer robot{2, kCameraPeriod};
  test_support::PictureServer old_robot{1, kCameraPeriod};  // minimal_node knows version 1 alone
  driver_benchmark::MjpegServer web_camera{kCameraPeriod};
};

struct Cost {
  double processor_share = 0;  ///< of one processor
  double per_picture = 0;      ///< us of processor time
  std::vector<double> ages{};  ///< ms, from the first byte to the subscriber's callback
};

/// Counts pictures, and how old they are if they tell their number.
class Subscriber {
 public:
  using TimeOf = std::function<steady_clock::time_point(std::uint64_t number)>;

  Subscriber(Subscription subscription, TimeOf time_of) : time_of_(std::move(time_of)) {
    const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
    if (subscription == Subscription::kCompressed) {
      subscriber_ = node_.subscribe("camera/image_raw/compressed", 100, &Subscriber::onCompressed, this, hints);
    } else if (subscription == Subscription::kRaw) {
      subscriber_ = node_.subscribe("camera/image_raw", 100, &Subscriber::onRaw, this, hints);
    }
  }

  ~Subscriber() { subscriber_.shutdown(); }

  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    count_ = 0;
    ages_.clear();
  }

  std::uint64_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
  }

  std::vector<double> ages() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ages_;
  }

 private:
  void onCompressed(const sensor_msgs::CompressedImageConstPtr& image) {
    const auto now = steady_clock::now();
    const auto name = test_pictures::nameOf(image->data);
    const std::lock_guard<std::mutex> lock(mutex_);
    ++count_;
    if (name) {
      ages_.push_back(std::chrono::duration<double, std::milli>(now - time_of_(name->number)).count());
    }
  }

  void onRaw(const sensor_msgs::ImageConstPtr&) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++count_;
  }

  ros::NodeHandle node_{kNamespace};
  TimeOf time_of_;
  mutable std::mutex mutex_;  // guards what follows
  std::uint64_t count_ = 0;
  std::vector<double> ages_;
  ros::Subscriber subscriber_;
};

class DriverBenchmark {
 public:
  DriverBenchmark(int rounds, int window) : rounds_(rounds), window_(window) { spinner_.start(); }

  void run() {
    for (int round = 0; round < rounds_; ++round) {
      measureCamera();
    }
    report();
  }

 private:
  using Start = std::function<std::unique_ptr<test_support::Process>()>;

  // Parameters stay at the master, so each node gets all of them. The rivals have no joints.
  static Start node(const test_support::PictureServer& robot, bool streams = true) {
    return [&robot, streams] {
      return std::make_unique<test_support::DriverProcess>(
          kNamespace, robot.port(),
          std::vector<std::string>{"_telemetry_rate:=0",
                                   streams ? "_stream_on_start:=true" : "_stream_on_start:=false"});
    };
  }

  static Start command(const std::vector<std::string>& words) {
    return [words] {
      return std::make_unique<test_support::Process>(words,
                                                     std::map<std::string, std::string>{{"ROS_NAMESPACE", kNamespace}});
    };
  }

  Start nodelet() const {
    return command(
        test_support::nodeletHost({"standalone", "aibo_driver/AiboDriverNodelet", "_host:=127.0.0.1",
                                   "_port:=" + std::to_string(sources_.robot.port()), "_telemetry_rate:=0"}));
  }

  Start minimal(const test_support::PictureServer& robot) const {
    return command({MINIMAL_NODE, std::to_string(robot.port())});
  }

  Start python(const std::string& program) const {
    return command({"/usr/bin/python3", RIVALS_FOLDER "/" + program,
                    "http://127.0.0.1:" + std::to_string(sources_.web_camera.port()) + "/stream.mjpg"});
  }

  void measureCamera() {
    const auto robot = [this](std::uint64_t number) { return sources_.robot.timeOf(number); };
    const auto old_robot = [this](std::uint64_t number) { return sources_.old_robot.timeOf(number); };
    const auto web_camera = [this](std::uint64_t number) { return sources_.web_camera.timeOf(number); };
    measure("node", node(sources_.robot), Subscription::kCompressed, robot);
    measure("minimal node", minimal(sources_.old_robot), Subscription::kCompressed, old_robot);
    measure("nodelet", nodelet(), Subscription::kCompressed, robot);
    measure("MJPEG reader", python("mjpeg_reader.py"), Subscription::kCompressed, web_camera);
    measure("node, decoded", node(sources_.robot), Subscription::kRaw, robot);
    measure("OpenCV", python("opencv_reader.py"), Subscription::kRaw, web_camera);
    measure("node, no subscriber", node(sources_.robot), Subscription::kNone, robot);
    measure("node, idle", node(sources_.robot, false), Subscription::kNone, robot);
  }

  void measure(const std::string& name, const Start& start, Subscription subscription,
               const Subscriber::TimeOf& time_of) {
    Subscriber subscriber(subscription, time_of);
    const auto process = start();
    waitForPictures(subscription, subscriber, name, *process);
    std::this_thread::sleep_for(kWarmUp);
    subscriber.clear();
    const std::uint64_t sent_before = sources_.robot.lastNumber();
    const auto begin = steady_clock::now();
    const double processor_before = benchmark_figures::processorSeconds(process->pid());
    std::this_thread::sleep_for(seconds(window_));
    const double processor = benchmark_figures::processorSeconds(process->pid()) - processor_before;
    const double duration = std::chrono::duration<double>(steady_clock::now() - begin).count();
    const auto pictures = static_cast<double>(
        subscription == Subscription::kNone ? sources_.robot.lastNumber() - sent_before : subscriber.count());
    record(name, {processor / duration, pictures > 0 ? 1e6 * processor / pictures : 0, subscriber.ages()});
  }

  static void waitForPictures(Subscription subscription, const Subscriber& subscriber, const std::string& name,
                              const test_support::Process& process) {
    const auto end = steady_clock::now() + kSafetyNet;
    while (subscription != Subscription::kNone && subscriber.count() == 0) {
      if (steady_clock::now() > end) {
        throw std::runtime_error(name + " publishes no pictures; it printed:\n" + process.output());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  void record(const std::string& name, const Cost& cost) {
    shares_[name].push_back(100 * cost.processor_share);
    costs_[name].push_back(cost.per_picture);
    medians_[name].push_back(quantile(cost.ages, 0.5));
    worsts_[name].push_back(quantile(cost.ages, 0.99));
  }

  void report() {
    printCost("node", "minimal node", atMost(1.2));
    printCost("node", "MJPEG reader", atMost(0.6));
    printCost("nodelet", "minimal node", {});
    printCost("node, decoded", "OpenCV", atMost(0.8));
    print("processor time of node, no subscriber", "us a picture", costs_["node, no subscriber"], {}, atMost(60));
    print("processor share of node, idle", "%", shares_["node, idle"], {}, atMost(0.1));
    for (const char* name : {"minimal node", "MJPEG reader"}) {
      print("age at the subscriber, median, node", "ms", medians_["node"], {name, medians_[name]});
      print("age at the subscriber, 99 %, node", "ms", worsts_["node"], {name, worsts_[name]});
    }
  }

  void printCost(const char* name, const char* rival, const benchmark_figures::Mark& mark) {
    print(std::string("processor time of ") + name, "us a picture", costs_[name], {rival, costs_[rival]}, mark);
  }

  const int rounds_;
  const int window_;
  Sources sources_;
  ros::AsyncSpinner spinner_{1};
  std::map<std::string, Rounds> shares_;
  std::map<std::string, Rounds> costs_;
  std::map<std::string, Rounds> medians_;
  std::map<std::string, Rounds> worsts_;
};

}  // namespace

int main(int argc, char** argv) {
  int rounds = 3;
  int window = 5;
  ros::init(argc, argv, "driver_benchmark", ros::init_options::AnonymousName);
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("rounds", po::value(&rounds)->default_value(rounds), "how often everything is measured")
    ("seconds", po::value(&window)->default_value(window), "how long each measurement takes");
  // clang-format on
  return test_support::runProgram(argc, argv, "Measures what a driver costs, beside other drivers.", description, [&] {
    if (!ros::master::check()) {
      throw std::runtime_error("there is no ROS master: start roscore first");
    }
    DriverBenchmark(rounds, window).run();
    return EXIT_SUCCESS;
  });
}
