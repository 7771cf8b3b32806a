// F23: something is wrong with the robot's memory stick.

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "aibo_client/rcserver_client.h"
#include "campaign/experiment.h"
#include "objects/HostSettings.h"
#include "simulator/ers7/simulated_ers7.h"
#include "support/memory_stick.h"
#include "support/robot_thread.h"

using aibo_client::CommandException;
using simulated_ers7::StickState;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace fault_bench {
namespace {

struct StickFault {
  StickState state;
  const char* reason;  ///< in the robot's words; null: the picture is stored, later
};

const StickFault kFaults[] = {{StickState::kFull, "the memory stick is full"},
                              {StickState::kLocked, "the memory stick is write-protected"},
                              {StickState::kOut, "there is no memory stick"},
                              {StickState::kSlow, nullptr}};

/// The robot's server with a memory stick of its own, and a client with a stream. A picture is taken onto the stick
/// while it is full, locked, out or slow, and again when it is well.
class StickExperiment : public Experiment {
 public:
  explicit StickExperiment(unsigned /*remainder*/)
      : robot_thread_(robot_, machineOptions()), client_(options(), callbacks()) {
    client_.setStreaming(true);
    client_.start();
    awaitPictures(1);
  }
  ~StickExperiment() override {
    client_.stop();
    setHostSettings(HostSettings());  // of other experiments
  }

  Outcome run(unsigned trial, Random&) override {
    try {
      return attempt(kFaults[trial % std::size(kFaults)]);
    } catch (const std::exception& error) {
      return {{}, {error.what()}};
    }
  }

 private:
  Outcome attempt(const StickFault& fault) {
    Outcome outcome;
    state_ = fault.state;
    awaitPictures(2);
    const int before = pictures_;
    const std::string said = take();
    if (fault.reason != nullptr && said.find(fault.reason) == std::string::npos) {
      outcome.violations.push_back("the robot did not say that " + std::string(fault.reason) + " but: " + said);
    }
    if (fault.reason == nullptr && !said.empty()) {
      outcome.violations.push_back("a slow stick: " + said);
    }
    if (fault.reason == nullptr && pictures_ - before < 20) {
      outcome.violations.push_back("M: a slow stick: " + std::to_string(pictures_ - before) + " pictures meanwhile");
    }
    const TimePoint well = steady_clock::now();
    state_ = StickState::kReady;
    awaitPictures(2);
    const std::string again = take();
    outcome.recovery = steady_clock::now() - well;
    if (!again.empty()) {
      outcome.violations.push_back("a stick that is well again: " + again);
    }
    checkFiles(&outcome);
    if (client_.statistics().connections != 1) {
      outcome.violations.push_back("the connection ended");
    }
    return outcome;
  }

  /// @return empty, or why there is no picture
  std::string take() {
    try {
      taken_.push_back(client_.takePictureOnRobot(85, kPatience));
      return "";
    } catch (const CommandException& error) {
      return error.what();
    }
  }

  // The stick has the pictures whose names the client got, whole, and nothing else that was not there before.
  void checkFiles(Outcome* outcome) {
    std::size_t found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(stick_.path("OPEN-R/MW/DATA/P"))) {
      const std::string name = entry.path().filename();
      if (entry.path().extension() == ".TMP") {
        outcome->violations.push_back(name + " was left on the stick");
      } else if (entry.path().extension() == ".JPG") {
        ++found;
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(file), {}};
        if (content.size() < 100 || content.substr(content.size() - 2) != "\xFF\xD9") {
          outcome->violations.push_back(name + " is not whole");
        }
      }
    }
    if (found != taken_.size()) {
      outcome->violations.push_back(std::to_string(found) + " pictures on the stick instead of " +
                                    std::to_string(taken_.size()));
    }
    for (const std::string& name : taken_) {
      client_.deletePicture(name, kPatience);
    }
    taken_.clear();
  }

  void awaitPictures(int count) {
    const TimePoint end = steady_clock::now() + kPatience;
    for (const int before = pictures_; pictures_ < before + count;) {
      if (steady_clock::now() > end) {
        throw std::runtime_error("no picture came any more");
      }
      std::this_thread::sleep_for(milliseconds(2));
    }
  }

  openr_host::MachineOptions machineOptions() {
    HostSettings host;
    host.memory_stick = stick_.path().c_str();
    host.room = robot_.stick().room();
    setHostSettings(host);
    openr_host::MachineOptions options = test_support::RobotThread::defaultOptions();
    options.memory_stick = stick_.path();
    options.on_camera_image = [this] { robot_.stick().set(state_); };
    options.handler_time = [this](const std::string& object, openr_host::Entry entry, std::chrono::nanoseconds) {
      const bool is_file = object == "FileKeeper" && entry == openr_host::Entry::kNotify;
      return std::chrono::nanoseconds(is_file ? robot_.stick().jobTime() : milliseconds(0));
    };
    return options;
  }

  aibo_client::ClientOptions options() const {
    aibo_client::ClientOptions options;
    options.port = robot_thread_.port();
    options.read_timeout = milliseconds(5000);  // a busy computer is not what is tested here
    return options;
  }

  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [this](const aibo_client::PicturePtr&) { ++pictures_; };
    return callbacks;
  }

  std::atomic<int> pictures_{0};
  std::atomic<StickState> state_{StickState::kReady};
  std::vector<std::string> taken_;
  const test_support::MemoryStick stick_{"ALLOW_PICTURES=yes\nALLOW_DELETE=yes\n"};
  simulated_ers7::SimulatedErs7 robot_;
  test_support::RobotThread robot_thread_;
  aibo_client::RcServerClient client_;
};

}  // namespace

std::vector<Row> stickRows() {
  return {{"F23", "server: its memory stick is full, locked, out or slow", 100, 1, Milliseconds(1000),
           maker<StickExperiment>()}};
}

}  // namespace fault_bench
