// Measures what a driver costs and how long pictures take through it: ours as node and nodelet, a minimal node, an
// MJPEG reader in Python, and OpenCV; and what aibo_web costs, which shows the node's pictures in a browser. All get
// the same JPEGs from this process, over 127.0.0.1, at the rate of a camera and as fast as they take them, and publish
// to a subscriber in this process. Processor time is that of the driver's process alone. Each round measures everything
// once, so that a busy computer slows all of it down.
//
//   driver_benchmark [--rounds N] [--seconds N]
//
// Needs a ROS master.
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Bool.h>

#include <algorithm>
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
#include <utility>
#include <vector>

#include "driver/mjpeg_server.h"
#include "driver/page_viewer.h"
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
using benchmark_figures::Mark;
using benchmark_figures::print;
using benchmark_figures::quantile;
using benchmark_figures::Rounds;
using std::chrono::microseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr char kNamespace[] = "/driver_benchmark";
constexpr microseconds kCameraPeriod{33445};  // of the ERS-7: 29.9 pictures a second
constexpr microseconds kFullRate{0};          // a picture is due when the previous one has been taken
constexpr seconds kLongestWarmUp{2};
constexpr seconds kFullRateWindow{1};  // thousands of pictures
constexpr seconds kSafetyNet{30};

enum class Subscription { kNone, kCompressed, kRaw };

/// The pictures' sources, and what they have sent.
struct Sources {
  explicit Sources(microseconds period)
      : robot(2, period), old_robot(1, period), web_camera(period), is_paced(period != kFullRate) {}

  test_support::PictureServer robot;
  test_support::PictureServer old_robot;  // minimal_node knows version 1 alone
  driver_benchmark::MjpegServer web_camera;
  const bool is_paced;
};

/// One figure from each round.
struct Cost {
  Rounds rates{};        ///< pictures a second
  Rounds shares{};       ///< of one processor, %
  Rounds per_picture{};  ///< us of processor time
  Rounds medians{};      ///< ms, of the age from the first byte to the subscriber's callback
  Rounds worsts{};       ///< ms, below which 99 % of the ages are
};

/// Counts pictures, and how old they are.
class Subscriber {
 public:
  /// When a picture was sent; 0 stands for the newest.
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

  // A decoded picture does not have its number. At the rate of a camera, it is the newest.
  void onRaw(const sensor_msgs::ImageConstPtr&) {
    const auto now = steady_clock::now();
    const std::lock_guard<std::mutex> lock(mutex_);
    ++count_;
    ages_.push_back(std::chrono::duration<double, std::milli>(now - time_of_(0)).count());
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
      measureAll(camera_, window_, "");
      measurePage();
      measureIdle();
      measureAll(full_rate_, kFullRateWindow, kAtFullRate);
    }
    reportCosts();
    reportAges();
    reportFullRate();
  }

 private:
  using Start = std::function<std::unique_ptr<test_support::Process>()>;

  static constexpr char kAtFullRate[] = ", full rate";

  // Parameters stay at the master, so each node gets all of them. The rivals have no joints.
  static Start node(const test_support::PictureServer& robot, bool streams = true) {
    return [&robot, streams] {
      return std::make_unique<test_support::DriverProcess>(
          kNamespace, robot.port(),
          std::vector<std::string>{"_telemetry_rate:=0", "_stream_on_demand:=false",
                                   streams ? "_stream_on_start:=true" : "_stream_on_start:=false"});
    };
  }

  static Start command(const std::vector<std::string>& words) {
    return [words] {
      return std::make_unique<test_support::Process>(words,
                                                     std::map<std::string, std::string>{{"ROS_NAMESPACE", kNamespace}});
    };
  }

  static Start nodelet(const test_support::PictureServer& robot) {
    return command(test_support::nodeletHost({"standalone", "aibo_driver/AiboDriverNodelet", "_host:=127.0.0.1",
                                              "_port:=" + std::to_string(robot.port()), "_telemetry_rate:=0"}));
  }

  static Start python(const std::string& program, const driver_benchmark::MjpegServer& camera) {
    return command({"/usr/bin/python3", RIVALS_FOLDER "/" + program,
                    "http://127.0.0.1:" + std::to_string(camera.port()) + "/stream.mjpg"});
  }

  template <typename Server>
  static Subscriber::TimeOf timesOf(const Server& server) {
    return [&server](std::uint64_t number) { return server.timeOf(number == 0 ? server.lastNumber() : number); };
  }

  /// @param suffix of the names
  void measureAll(const Sources& sources, seconds window, const std::string& suffix) {
    const auto& [robot, old_robot, camera, is_paced] = sources;
    const auto times = timesOf(robot);
    const Subscription compressed = Subscription::kCompressed;
    measure("node" + suffix, node(robot), compressed, times, window);
    measure("minimal node" + suffix, command({MINIMAL_NODE, std::to_string(old_robot.port())}), compressed,
            timesOf(old_robot), window);
    measure("nodelet" + suffix, nodelet(robot), compressed, times, window);
    measure("MJPEG reader" + suffix, python("mjpeg_reader.py", camera), compressed, timesOf(camera), window);
    measure("node, decoded" + suffix, node(robot), Subscription::kRaw, times, window);
    measure("OpenCV" + suffix, python("opencv_reader.py", camera), Subscription::kRaw, timesOf(camera), window);
    if (is_paced) {
      measure("nodelet, decoded" + suffix, nodelet(robot), Subscription::kRaw, times, window);
      measure("node, no subscriber" + suffix, node(robot), Subscription::kNone, times, window);
    }
  }

  // The time is that of aibo_web. The driver has one subscriber, as in the other measurements.
  void measurePage() {
    const auto driver = node(camera_.robot)();
    test_support::Process web({AIBO_WEB, std::string("__ns:=") + kNamespace, "_web_port:=0"});
    const std::string port = web.waitForOutput("page is at http://127.0.0.1:([0-9]+)").at(1);
    const driver_benchmark::PageViewer viewer(static_cast<unsigned short>(std::stoi(port)));
    waitForPictures(viewer, "the page", web);
    std::this_thread::sleep_for(kLongestWarmUp);
    const std::uint64_t shown_before = viewer.count();
    const double processor_before = benchmark_figures::processorSeconds(web.pid());
    std::this_thread::sleep_for(window_);
    const double processor = benchmark_figures::processorSeconds(web.pid()) - processor_before;
    costs_["aibo_web, one page"].per_picture.push_back(1e6 * processor /
                                                       static_cast<double>(viewer.count() - shown_before));
  }

  // Both at once, because little happens and measuring takes longer.
  void measureIdle() {
    const std::vector<std::pair<std::string, Start>> nodes = {{"node, idle", node(camera_.robot, false)},
                                                              {"empty node, idle", command({MINIMAL_NODE})}};
    std::vector<std::unique_ptr<test_support::Process>> processes;
    std::vector<double> before;
    for (const auto& each : nodes) {
      processes.push_back(each.second());
    }
    waitForDriver("the idle node");
    std::this_thread::sleep_for(kLongestWarmUp);
    for (const auto& process : processes) {
      before.push_back(benchmark_figures::processorSeconds(process->pid()));
    }
    const seconds window = 2 * window_;
    std::this_thread::sleep_for(window);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double used = benchmark_figures::processorSeconds(processes[i]->pid()) - before[i];
      costs_[nodes[i].first].shares.push_back(100 * used / static_cast<double>(window.count()));
    }
  }

  void measure(const std::string& name, const Start& start, Subscription subscription,
               const Subscriber::TimeOf& time_of, seconds window) {
    Subscriber subscriber(subscription, time_of);
    const auto process = start();
    if (subscription == Subscription::kNone) {
      waitForDriver(name);
    } else {
      waitForPictures(subscriber, name, *process);
    }
    std::this_thread::sleep_for(std::min(kLongestWarmUp, window));
    subscriber.clear();
    const std::uint64_t sent_before = camera_.robot.lastNumber();
    const auto begin = steady_clock::now();
    const double processor_before = benchmark_figures::processorSeconds(process->pid());
    std::this_thread::sleep_for(window);
    const double processor = benchmark_figures::processorSeconds(process->pid()) - processor_before;
    const double duration = std::chrono::duration<double>(steady_clock::now() - begin).count();
    const auto pictures = static_cast<double>(
        subscription == Subscription::kNone ? camera_.robot.lastNumber() - sent_before : subscriber.count());
    Cost& cost = costs_[name];
    cost.rates.push_back(pictures / duration);
    cost.shares.push_back(100 * processor / duration);
    cost.per_picture.push_back(pictures > 0 ? 1e6 * processor / pictures : 0);
    cost.medians.push_back(quantile(subscriber.ages(), 0.5));
    cost.worsts.push_back(quantile(subscriber.ages(), 0.99));
  }

  // Its topic `streaming` is latched.
  static void waitForDriver(const std::string& name) {
    if (!ros::topic::waitForMessage<std_msgs::Bool>(std::string(kNamespace) + "/streaming",
                                                    ros::Duration(kSafetyNet.count()))) {
      throw std::runtime_error(name + " has not started");
    }
  }

  /// @param viewer has a count()
  template <typename Viewer>
  static void waitForPictures(const Viewer& viewer, const std::string& name, const test_support::Process& process) {
    const auto end = steady_clock::now() + kSafetyNet;
    while (viewer.count() == 0) {
      if (steady_clock::now() > end) {
        throw std::runtime_error(name + " publishes no pictures; it printed:\n" + process.output());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  void reportCosts() {
    printCost("node", "minimal node", atMost(1.15));
    printCost("node", "MJPEG reader", atMost(0.55));
    printCost("nodelet", "minimal node", {});
    printCost("node, decoded", "OpenCV", atMost(0.8));
    printCost("nodelet, decoded", "OpenCV", {});
    printCost("aibo_web, one page", "minimal node", {});
    print("processor time of node, no subscriber", "us a picture", costs_["node, no subscriber"].per_picture);
    print("processor share of node, idle", "%", costs_["node, idle"].shares,
          {"empty node", costs_["empty node, idle"].shares}, atMost(1.3));
  }

  void reportAges() {
    for (const std::string name : {"node", "nodelet"}) {
      for (const std::string rival : {"minimal node", "MJPEG reader"}) {
        const bool has_mark = name == "node" && rival == "minimal node";
        print("age at the subscriber, median, " + name, "ms", costs_[name].medians, {rival, costs_[rival].medians},
              has_mark ? atMost(1.15) : Mark());
        print("age at the subscriber, 99 %, " + name, "ms", costs_[name].worsts, {rival, costs_[rival].worsts},
              has_mark ? atMost(1.2) : Mark());
      }
      const Cost& decoded = costs_[name + ", decoded"];
      print("age at the subscriber, median, " + name + ", decoded", "ms", decoded.medians);
      print("age at the subscriber, 99 %, " + name + ", decoded", "ms", decoded.worsts);
    }
  }

  void reportFullRate() {
    const std::vector<std::pair<std::string, std::string>> pairs = {
        {"node", "minimal node"}, {"nodelet", "minimal node"}, {"node", "MJPEG reader"}, {"node, decoded", "OpenCV"}};
    for (const auto& [name, rival] : pairs) {
      const Cost& own = costs_[name + kAtFullRate];
      const Cost& other = costs_[rival + kAtFullRate];
      print("pictures a second, " + name + kAtFullRate, "/s", own.rates, {rival, other.rates});
      print("processor time of " + name + kAtFullRate, "us a picture", own.per_picture, {rival, other.per_picture});
      if (name != "node, decoded") {
        print("age at the subscriber, median, " + name + kAtFullRate, "ms", own.medians, {rival, other.medians});
        print("age at the subscriber, 99 %, " + name + kAtFullRate, "ms", own.worsts, {rival, other.worsts});
      }
    }
  }

  void printCost(const std::string& name, const std::string& rival, const Mark& mark) {
    print("processor time of " + name, "us a picture", costs_[name].per_picture, {rival, costs_[rival].per_picture},
          mark);
  }

  const int rounds_;
  const seconds window_;
  Sources camera_{kCameraPeriod};
  Sources full_rate_{kFullRate};
  ros::AsyncSpinner spinner_{1};
  std::map<std::string, Cost> costs_;  // by what was measured
};

}  // namespace

int main(int argc, char** argv) {
  int rounds = 3;
  int window = 2;
  ros::init(argc, argv, "driver_benchmark", ros::init_options::AnonymousName);
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("rounds", po::value(&rounds)->default_value(rounds), "how often everything is measured")
    ("seconds", po::value(&window)->default_value(window), "how long each measurement at the rate of a camera takes");
  // clang-format on
  return test_support::runProgram(argc, argv, "Measures what a driver costs, beside other drivers.", description, [&] {
    if (!ros::master::check()) {
      throw std::runtime_error("there is no ROS master: start roscore first");
    }
    DriverBenchmark(rounds, window).run();
    return EXIT_SUCCESS;
  });
}
