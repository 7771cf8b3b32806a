// Measures what a robot and its driver cost when there are many of them on this computer: processor time, memory and
// pictures of each robot, and the time until all stream. Once with a node for each driver, once with all drivers as
// nodelets in one process. The robots' cameras show photographs, except for those with the rendered room.
//
//   scale_benchmark [--robots N...] [--seconds N]
//   two_hosts scale_benchmark [--robots N...] [--seconds N]
//
// With two_hosts, the robots run on another host than the drivers.
// Needs a ROS master.
#include <nodelet/NodeletLoad.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>

#include <atomic>
#include <boost/program_options.hpp>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <list>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "figures.h"
#include "process_cost.h"
#include "support/process.h"
#include "support/program.h"
#include "support/ros/driver_process.h"
#include "support/simulated_robot.h"
#include "support/temporary_folder.h"
#include "support/test_pictures.h"

namespace {

namespace po = boost::program_options;
using benchmark_figures::atLeast;
using benchmark_figures::atMost;
using benchmark_figures::print;
using benchmark_figures::Rounds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr char kManager[] = "/scale_benchmark/manager";
constexpr seconds kWarmUp{3};
constexpr seconds kSafetyNet{120};

/// What the benchmark needs to know of a way to start drivers.
enum class Drivers { kNodes, kNodelets };

std::string nameSpaceOf(int robot) {
  return "/scale_benchmark/robot" + std::to_string(robot);
}

/// Where the robots run. two_hosts sets this environment.
struct RobotHost {
  const char* name_space = std::getenv("AIBO_ROBOT_NAMESPACE");  ///< network namespace; null: this host
  const char* address = name_space != nullptr ? std::getenv("AIBO_ROBOT_ADDRESS") : "127.0.0.1";

  std::vector<std::string> launcher() const {
    return name_space != nullptr ? std::vector<std::string>{"ip", "netns", "exec", name_space}
                                 : std::vector<std::string>();
  }
};

/// Counts the pictures of one robot.
class Counter {
 public:
  explicit Counter(int robot)
      : subscriber_(ros::NodeHandle(nameSpaceOf(robot))
                        .subscribe<sensor_msgs::CompressedImage>(
                            "camera/image_raw/compressed", 100,
                            [this](const sensor_msgs::CompressedImageConstPtr&) { ++count_; }, ros::VoidConstPtr(),
                            ros::TransportHints().tcpNoDelay())) {}
  ~Counter() { subscriber_.shutdown(); }

  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  std::uint64_t count() const { return count_; }

 private:
  std::atomic<std::uint64_t> count_{0};
  ros::Subscriber subscriber_;
};

/// Drivers for robots at these ports, each in its namespace.
class DriverProcesses {
 public:
  DriverProcesses(Drivers kind, const std::list<test_support::SimulatedRobot>& robots, const std::string& address) {
    if (kind == Drivers::kNodelets) {
      processes_.push_back(std::make_unique<test_support::Process>(
          test_support::nodeletHost({"manager", std::string("__name:=manager"), "__ns:=/scale_benchmark"})));
    }
    int number = 0;
    for (const test_support::SimulatedRobot& robot : robots) {
      if (kind == Drivers::kNodelets) {
        load(number, address, robot.port());
      } else {
        processes_.push_back(std::make_unique<test_support::DriverProcess>(
            nameSpaceOf(number), robot.port(), std::vector<std::string>{"_host:=" + address}));
      }
      ++number;
    }
  }

  const std::list<std::unique_ptr<test_support::Process>>& processes() const { return processes_; }

 private:
  static void load(int number, const std::string& address, int port) {
    const std::string name = nameSpaceOf(number) + "/aibo_driver";
    ros::param::set(name + "/host", address);
    ros::param::set(name + "/port", port);
    nodelet::NodeletLoad nodelet;
    nodelet.request.name = name;
    nodelet.request.type = "aibo_driver/AiboDriverNodelet";
    const std::string service = std::string(kManager) + "/load_nodelet";
    if (!ros::service::waitForService(service, ros::Duration(kSafetyNet.count())) ||
        !ros::service::call(service, nodelet) || !nodelet.response.success) {
      throw std::runtime_error("the nodelet " + name + " cannot be loaded");
    }
  }

  std::list<std::unique_ptr<test_support::Process>> processes_;
};

/// Of each robot, on average.
struct Result {
  double driver_share = 0;     ///< % of one processor
  double robot_share = 0;      ///< % of one processor
  double driver_memory = 0;    ///< MB
  double fewest_pictures = 0;  ///< a second, of the robot with the fewest
  double start_time = 0;       ///< s, until all stream
};

template <typename Processes, typename Measure>
double sum(const Processes& processes, const Measure& measure) {
  double total = 0;
  for (const auto& process : processes) {
    total += measure(process);
  }
  return total;
}

double processorOf(const std::unique_ptr<test_support::Process>& driver) {
  return benchmark_figures::processorSeconds(driver->pid());
}

void waitForAll(const std::list<Counter>& counters) {
  const auto end = steady_clock::now() + kSafetyNet;
  for (const Counter& counter : counters) {
    while (counter.count() == 0) {
      if (steady_clock::now() > end) {
        throw std::runtime_error("not all robots stream");
      }
      std::this_thread::sleep_for(milliseconds(10));
    }
  }
}

std::vector<std::uint64_t> countsOf(const std::list<Counter>& counters) {
  std::vector<std::uint64_t> counts;
  for (const Counter& counter : counters) {
    counts.push_back(counter.count());
  }
  return counts;
}

Result measure(int robots, Drivers kind, const std::vector<std::string>& robot_options, seconds window) {
  const RobotHost host;
  std::list<test_support::SimulatedRobot> servers;
  std::list<Counter> counters;
  for (int i = 0; i < robots; ++i) {
    servers.emplace_back(robot_options, host.launcher());
    counters.emplace_back(i);
  }
  const auto robotProcessor = [](test_support::SimulatedRobot& server) {
    return benchmark_figures::processorSeconds(server.process().pid());
  };
  const auto begin = steady_clock::now();
  const DriverProcesses drivers(kind, servers, host.address);
  waitForAll(counters);
  Result result;
  result.start_time = std::chrono::duration<double>(steady_clock::now() - begin).count();

  std::this_thread::sleep_for(kWarmUp);
  const auto window_begin = steady_clock::now();
  const auto counts_before = countsOf(counters);
  const double driver_before = sum(drivers.processes(), processorOf);
  double robot_before = 0;
  for (test_support::SimulatedRobot& server : servers) {
    robot_before += robotProcessor(server);
  }
  std::this_thread::sleep_for(window);
  const double duration = std::chrono::duration<double>(steady_clock::now() - window_begin).count();
  result.driver_share = 100 * (sum(drivers.processes(), processorOf) - driver_before) / duration / robots;
  double robot_after = 0;
  for (test_support::SimulatedRobot& server : servers) {
    robot_after += robotProcessor(server);
  }
  result.robot_share = 100 * (robot_after - robot_before) / duration / robots;
  result.driver_memory =
      sum(drivers.processes(), [](const auto& driver) { return benchmark_figures::memoryMegabytes(driver->pid()); }) /
      robots;
  const auto counts = countsOf(counters);
  result.fewest_pictures = 1e9;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    result.fewest_pictures =
        std::min(result.fewest_pictures, static_cast<double>(counts[i] - counts_before[i]) / duration);
  }
  return result;
}

void writePhotographs(const test_support::TemporaryFolder& folder) {
  for (unsigned i = 0; i < 4; ++i) {
    const auto jpeg = test_pictures::makeNumbered(i);
    folder.write(std::to_string(i) + ".jpg", std::string(jpeg.begin(), jpeg.end()));
  }
}

void report(const std::string& kind, int robots, const Result& result, const Result& one) {
  const std::string title = std::to_string(robots) + (robots == 1 ? " robot, " : " robots, ") + kind + ": ";
  const auto mark = robots > 1 ? atMost(1.1) : benchmark_figures::Mark{};
  print(title + "processor share of a driver", "%", {result.driver_share}, {"one robot", {one.driver_share}}, mark);
  print(title + "memory of a driver", "MB", {result.driver_memory}, {"one robot", {one.driver_memory}}, mark);
  print(title + "processor share of a simulated robot", "%", {result.robot_share}, {"one robot", {one.robot_share}});
  print(title + "pictures a second, fewest of a robot", "/s", {result.fewest_pictures}, {}, atLeast(29.5));
  print(title + "time until all stream", "s", {result.start_time});
}

void run(const std::vector<int>& numbers, int rendered, seconds window) {
  const test_support::TemporaryFolder photographs;
  writePhotographs(photographs);
  const RobotHost host;
  const std::vector<std::string> with_photographs{"--images", photographs.path().string(), "--bind", host.address};
  const std::string where = host.name_space != nullptr ? ", robots on another host" : "";
  for (const Drivers kind : {Drivers::kNodes, Drivers::kNodelets}) {
    const std::string name = kind == Drivers::kNodes ? "nodes" : "nodelets in one process";
    Result one;
    for (const int robots : numbers) {
      const Result result = measure(robots, kind, with_photographs, window);
      one = robots == numbers.front() ? result : one;
      report(name + where, robots, result, one);
    }
  }
  if (rendered > 0) {
    const Result result = measure(rendered, Drivers::kNodes, {"--bind", host.address}, window);
    print(std::to_string(rendered) + " robots in the rendered room: pictures a second, fewest of a robot", "/s",
          {result.fewest_pictures}, {}, atLeast(29.5));
    print(std::to_string(rendered) + " robots in the rendered room: processor share of a simulated robot", "%",
          {result.robot_share});
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> numbers;
  int rendered = 8;
  int window = 10;
  ros::init(argc, argv, "scale_benchmark", ros::init_options::AnonymousName);
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("robots", po::value(&numbers)->multitoken()->default_value({1, 4, 16, 32}, "1 4 16 32"), "numbers of robots")
    ("rendered", po::value(&rendered)->default_value(rendered), "number of robots in the rendered room; 0: none")
    ("seconds", po::value(&window)->default_value(window), "how long each number is measured");
  // clang-format on
  return test_support::runProgram(argc, argv, "Measures what a robot costs when there are many.", description, [&] {
    if (!ros::master::check()) {
      throw std::runtime_error("there is no ROS master: start roscore first");
    }
    ros::AsyncSpinner spinner(1);
    spinner.start();
    run(numbers, rendered, seconds(window));
    return EXIT_SUCCESS;
  });
}
