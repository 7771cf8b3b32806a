// Measures what the robot's server costs on this computer, with the simulated ERS-7: while nobody is connected, and for
// each picture, with photographs, in the rendered room with the robot at rest, and walking with its head moving. Beside
// it, GStreamer compresses pictures of the same size, with the same quality and at the same rate, and so does
// ustreamer, which reads them from a device that camera_device.cpp makes. Also measures the time from the camera's
// handing over an image until a client has its picture, in a run of its own, because the server then writes a log.
//
//   server_benchmark [--rounds N] [--seconds N]
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <boost/program_options.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "figures.h"
#include "process_cost.h"
#include "robot_model/robot_model.h"
#include "support/process.h"
#include "support/program.h"
#include "support/simulated_robot.h"
#include "support/sockets.h"
#include "support/temporary_folder.h"
#include "support/test_pictures.h"

namespace {

namespace po = boost::program_options;
using benchmark_figures::atMost;
using benchmark_figures::print;
using benchmark_figures::Rounds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;
using std::chrono::system_clock;

constexpr seconds kWarmUp{2};
constexpr seconds kSafetyNet{30};
constexpr milliseconds kCommandPeriod{100};

// A second, of a rival at 30 a second: with fewer, something is wrong with it, and its figure would mean nothing.
constexpr int kFewestPictures = 20;

/// A client that counts pictures, and notes when they came.
class Client {
 public:
  explicit Client(int port) : client_(optionsFor(port), callbacks()) {
    client_.setStreaming(true);
    client_.start();
    const auto end = steady_clock::now() + kSafetyNet;
    while (pictures_ == 0) {
      if (steady_clock::now() > end) {
        throw std::runtime_error("no picture came");
      }
      std::this_thread::sleep_for(milliseconds(10));
    }
  }

  std::uint64_t pictures() const { return pictures_; }

  /// In nanoseconds of the system's clock, in order.
  std::vector<std::int64_t> arrivals() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return arrivals_;
  }

  void walkAndLookAround(double time) {
    client_.steer({0.05, 0, 0.3});
    const auto* model = robot_model::findRobotModel("ERS-7");
    const auto pan = static_cast<std::size_t>(robot_model::findJointByName(*model, "head_pan"));
    client_.commandJoints({{model->joints[pan].identifier, 0.6 * std::sin(2 * time)}}, kCommandPeriod);
  }

 private:
  static aibo_client::ClientOptions optionsFor(int port) {
    aibo_client::ClientOptions options;
    options.host = "127.0.0.1";
    options.port = static_cast<std::uint16_t>(port);
    return options;
  }

  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [this](const aibo_client::PicturePtr&) {
      const auto now = std::chrono::nanoseconds(system_clock::now().time_since_epoch());
      const std::lock_guard<std::mutex> lock(mutex_);
      arrivals_.push_back(now.count());
      ++pictures_;
    };
    return callbacks;
  }

  std::mutex mutex_;
  std::vector<std::int64_t> arrivals_;
  std::atomic<std::uint64_t> pictures_{0};
  aibo_client::RcServerClient client_;
};

/// How another program serves JPEGs.
struct Rival {
  std::string name;
  std::vector<std::string> command;
  int port = 0;
  std::string request;   ///< what a client sends first
  std::string boundary;  ///< what comes between two pictures
  std::map<std::string, std::string> environment{};
};

int freePort() {
  return test_support::portOf(test_support::bindTo("127.0.0.1", 0));
}

/// @param images raw images, 4:2:0, of the robot's size, one after the other
Rival gstreamer(const std::string& images) {
  const int port = freePort();
  const std::string format = "format=i420";
  return {"GStreamer",
          {"gst-launch-1.0",
           "-q",
           "filesrc",
           "location=" + images,
           "!",
           "rawvideoparse",
           "width=208",
           "height=160",
           format,
           "framerate=299/10",
           "!",
           "identity",
           "sync=true",
           "!",
           "jpegenc",
           "quality=85",
           "!",
           "multipartmux",
           "boundary=picture",
           "!",
           "tcpserversink",
           "host=127.0.0.1",
           "port=" + std::to_string(port)},
          port,
          "",
          "--picture"};
}

/// @param images raw images, YUYV, of the robot's size, one after the other
Rival ustreamer(const std::string& images) {
  const int port = freePort();
  return {"ustreamer",
          {"ustreamer", "--device=" + images, "--resolution=208x160", "--quality=85", "--host=127.0.0.1",
           "--port=" + std::to_string(port)},
          port,
          "GET /stream HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
          "--boundarydonotcross",
          {{"LD_PRELOAD", CAMERA_DEVICE_LIBRARY}, {"CAMERA_DEVICE", images}}};
}

bool isInstalled(const std::string& program) {
  return test_support::Process({program, "--version"}).waitForExit(kSafetyNet) == 0;
}

/// A rival, and a client that reads and forgets its pictures.
class RivalServer {
 public:
  explicit RivalServer(Rival rival) : rival_(std::move(rival)), process_(rival_.command, rival_.environment) {
    const auto end = steady_clock::now() + kSafetyNet;
    while (!connect()) {
      if (steady_clock::now() > end) {
        throw std::runtime_error(rival_.name + " does not serve: " + process_.output());
      }
      std::this_thread::sleep_for(milliseconds(50));
    }
    test_support::check(::send(connection_.get(), rival_.request.data(), rival_.request.size(), MSG_NOSIGNAL) ==
                            static_cast<ssize_t>(rival_.request.size()),
                        "sending a request");
    reader_ = std::thread([this] { read(); });
  }

  ~RivalServer() {
    process_.kill();
    reader_.join();
  }

  RivalServer(const RivalServer&) = delete;
  RivalServer& operator=(const RivalServer&) = delete;

  pid_t pid() const { return process_.pid(); }
  std::uint64_t pictures() const { return pictures_; }
  std::string output() const { return process_.output(); }

 private:
  bool connect() {
    connection_ = test_support::beginConnecting("127.0.0.1", rival_.port);
    pollfd polled{connection_.get(), POLLOUT, 0};
    int error = 0;
    socklen_t length = sizeof error;
    return ::poll(&polled, 1, 1000) > 0 &&
           ::getsockopt(connection_.get(), SOL_SOCKET, SO_ERROR, &error, &length) == 0 && error == 0;
  }

  void read() {
    const std::string& boundary = rival_.boundary;
    std::string rest;
    char buffer[65536];
    pollfd polled{connection_.get(), POLLIN, 0};
    while (::poll(&polled, 1, -1) > 0) {
      const ssize_t size = ::recv(connection_.get(), buffer, sizeof buffer, 0);
      if (size <= 0) {
        return;
      }
      rest.append(buffer, static_cast<std::size_t>(size));
      std::size_t at = rest.find(boundary);
      for (; at != std::string::npos; at = rest.find(boundary)) {
        ++pictures_;
        rest.erase(0, at + boundary.size());
      }
      rest.erase(0, rest.size() - std::min(rest.size(), boundary.size() - 1));
    }
  }

  const Rival rival_;
  test_support::Process process_;
  aibo_client::FileDescriptor connection_;
  std::atomic<std::uint64_t> pictures_{0};
  std::thread reader_;
};

class ServerBenchmark {
 public:
  ServerBenchmark(int rounds, int window) : rounds_(rounds), window_(window) {
    writeImages();
    if (!has_ustreamer_) {
      std::fprintf(stderr, "ustreamer is not installed: the server is not compared with it.\n");
    }
  }

  void run() {
    for (int round = 0; round < rounds_; ++round) {
      measureIdle();
      measureStream("photographs", {"--images", folder_.path("photographs").string()}, false);
      measureRival(gstreamer(folder_.path("images.i420").string()));
      if (has_ustreamer_) {
        measureRival(ustreamer(folder_.path("images.yuyv").string()));
      }
      measureAge();
      measureStream("at rest", {}, false);
      measureStream("walking", {}, true);
    }
    print("processor share of the simulated robot, nobody connected", "%", costs_["idle"], {}, atMost(1));
    print("processor time of the server, photographs", "us a picture", costs_["photographs"],
          {"GStreamer", costs_["GStreamer"]}, atMost(0.5));
    if (has_ustreamer_) {
      print("processor time of the server, photographs", "us a picture", costs_["photographs"],
            {"ustreamer", costs_["ustreamer"]}, atMost(0.45));
    }
    print("from image to received picture, median", "ms", costs_["age, median"], {}, atMost(0.3));
    print("from image to received picture, 99 %", "ms", costs_["age, 99 %"]);
    print("processor time of the simulated robot at rest", "us a picture", costs_["at rest"], {}, atMost(4000));
    print("processor time of the simulated robot walking", "us a picture", costs_["walking"], {}, atMost(6000));
  }

 private:
  // The same pictures as JPEGs, and as raw images: for 60 s, and once for a device that repeats them.
  void writeImages() const {
    std::string raw;
    std::string yuyv;
    for (unsigned i = 0; i < 16; ++i) {
      const auto jpeg = test_pictures::makeNumbered(i);
      folder_.write("photographs/" + std::to_string(100 + i) + ".jpg", std::string(jpeg.begin(), jpeg.end()));
      const std::string planes = planesOf(jpeg);
      raw += planes;
      yuyv += yuyvOf(planes);
    }
    std::string all;
    for (int i = 0; i < 113; ++i) {
      all += raw;
    }
    folder_.write("images.i420", all);
    folder_.write("images.yuyv", yuyv);
  }

  // The format of cameras, 4:2:2: two lines get the same chroma, so a server that averages them has the same pictures.
  static std::string yuyvOf(const std::string& planes) {
    const char* const luma = planes.data();
    const char* const blue = luma + 208 * 160;
    const char* const red = blue + 104 * 80;
    std::string yuyv;
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 104; ++x) {
        const int chroma = y / 2 * 104 + x;
        yuyv += {luma[208 * y + 2 * x], blue[chroma], luma[208 * y + 2 * x + 1], red[chroma]};
      }
    }
    return yuyv;
  }

  static std::string planesOf(const test_pictures::Bytes& jpeg) {
    std::string planes(208 * 160 * 3 / 2, '\0');
    void* const bytes = planes.data();
    const tjhandle decoder = tjInitDecompress();
    const int result = tjDecompressToYUV2(decoder, jpeg.data(), static_cast<unsigned long>(jpeg.size()),
                                          static_cast<unsigned char*>(bytes), 208, 4, 160, 0);
    tjDestroy(decoder);
    if (result != 0) {
      throw std::runtime_error("the pictures cannot be decoded");
    }
    return planes;
  }

  double processorSecondsIn(pid_t process, const std::function<void(double time)>& meanwhile = nullptr) const {
    const double before = benchmark_figures::processorSeconds(process);
    const auto begin = steady_clock::now();
    for (auto now = begin; now < begin + seconds(window_); now = steady_clock::now()) {
      if (meanwhile) {
        meanwhile(std::chrono::duration<double>(now - begin).count());
      }
      std::this_thread::sleep_for(kCommandPeriod);
    }
    return benchmark_figures::processorSeconds(process) - before;
  }

  void measureIdle() {
    test_support::SimulatedRobot robot;
    std::this_thread::sleep_for(kWarmUp);
    costs_["idle"].push_back(100 * processorSecondsIn(robot.process().pid()) / window_);
  }

  void measureStream(const std::string& name, const std::vector<std::string>& options, bool moving) {
    test_support::SimulatedRobot robot(options);
    Client client(robot.port());
    const auto move = [&client](double time) { client.walkAndLookAround(time); };
    if (moving) {
      move(0);
    }
    std::this_thread::sleep_for(kWarmUp);
    const std::uint64_t before = client.pictures();
    const double processor = processorSecondsIn(
        robot.process().pid(), moving ? std::function<void(double)>(move) : std::function<void(double)>());
    costs_[name].push_back(1e6 * processor / static_cast<double>(client.pictures() - before));
  }

  void measureRival(const Rival& rival) {
    const RivalServer server(rival);
    std::this_thread::sleep_for(kWarmUp);
    const std::uint64_t before = server.pictures();
    const double processor = processorSecondsIn(server.pid());
    const std::uint64_t pictures = server.pictures() - before;
    if (pictures < static_cast<std::uint64_t>(kFewestPictures * window_)) {
      throw std::runtime_error(rival.name + " has sent only " + std::to_string(pictures) +
                               " pictures: " + server.output());
    }
    costs_[rival.name].push_back(1e6 * processor / static_cast<double>(pictures));
  }

  // The log has the time of each picture's image, in the order in which the only client gets them.
  void measureAge() {
    const std::string log = folder_.path("pictures.log").string();
    const test_support::SimulatedRobot robot({"--images", folder_.path("photographs").string(), "--picture-log", log});
    Client client(robot.port());
    std::this_thread::sleep_for(seconds(window_));
    std::ifstream lines(log);
    std::vector<double> ages;
    for (const std::int64_t arrival : client.arrivals()) {
      std::int64_t taken = 0;
      std::size_t size = 0;
      std::uint32_t checksum = 0;
      if (!(lines >> taken >> size >> checksum)) {
        throw std::runtime_error("the server's log lacks a picture");
      }
      ages.push_back(1e-6 * static_cast<double>(arrival - taken));
    }
    costs_["age, median"].push_back(benchmark_figures::quantile(ages, 0.5));
    costs_["age, 99 %"].push_back(benchmark_figures::quantile(ages, 0.99));
  }

  const int rounds_;
  const int window_;
  const bool has_ustreamer_ = isInstalled("ustreamer");
  const test_support::TemporaryFolder folder_;
  std::map<std::string, Rounds> costs_;
};

}  // namespace

int main(int argc, char** argv) {
  int rounds = 3;
  int window = 5;
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("rounds", po::value(&rounds)->default_value(rounds), "how often everything is measured")
    ("seconds", po::value(&window)->default_value(window), "how long each measurement takes");
  // clang-format on
  return test_support::runProgram(argc, argv, "Measures what the robot's server costs, beside others.", description,
                                  [&] {
                                    ServerBenchmark(rounds, window).run();
                                    return EXIT_SUCCESS;
                                  });
}
