/// @file aibo_radio_link.cpp
/// Two hosts on this machine with a weak radio link between them, and a command on each.

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/program_options.hpp>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "radio/network_host.h"
#include "radio/radio_link.h"
#include "support/program.h"

namespace {

namespace po = boost::program_options;

constexpr char kRobotAddress[] = "10.77.0.1";
constexpr char kComputerAddress[] = "10.77.0.2";

struct Options {
  std::string robot_command;
  std::string computer_command;
  double megabits_per_second = 0;
  double loss_percent = 0;
  double delay_ms = 0;
  double jitter_ms = 0;
  std::vector<std::string> outages;
  fault_bench::RadioOptions radio;
};

po::options_description describe(Options& options) {
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("robot", po::value(&options.robot_command), "shell command on the robot's host, 10.77.0.1")
    ("computer", po::value(&options.computer_command), "shell command on the other host, 10.77.0.2; when it ends, everything ends")
    ("rate", po::value(&options.megabits_per_second)->default_value(11), "Mbit/s; 802.11b has 11, 5.5, 2 and 1")
    ("loss", po::value(&options.loss_percent)->default_value(0), "lost packets, in percent")
    ("delay", po::value(&options.delay_ms)->default_value(1), "of each packet, in ms")
    ("jitter", po::value(&options.jitter_ms)->default_value(1), "random additional delay, up to this many ms")
    ("outage", po::value(&options.outages), "BEGIN:LENGTH in seconds, such as 10:3; may be repeated")
    ("seed", po::value(&options.radio.seed)->default_value(1), "seed of loss and jitter");
  // clang-format on
  return description;
}

fault_bench::Outage parseOutage(const std::string& text) {
  char* colon = nullptr;
  char* end = nullptr;
  const double begin = std::strtod(text.c_str(), &colon);
  const double length = *colon == ':' ? std::strtod(colon + 1, &end) : -1;
  if (begin < 0 || length <= 0 || *end != '\0') {
    throw po::error("option '--outage' must be BEGIN:LENGTH in seconds, such as 10:3, not '" + text + "'");
  }
  const auto toMilliseconds = [](double seconds) {
    return std::chrono::milliseconds(static_cast<long>(seconds * 1e3));
  };
  return {toMilliseconds(begin), toMilliseconds(length)};
}

std::chrono::microseconds toMicroseconds(const std::string& option, double milliseconds) {
  if (!(milliseconds >= 0 && milliseconds <= 60000)) {
    throw po::error("option '--" + option + "' must be 0 to 60000 ms");
  }
  return std::chrono::microseconds(static_cast<long>(milliseconds * 1e3));
}

/// Checks the options, and sets options.radio.
void check(Options& options) {
  if (options.robot_command.empty() || options.computer_command.empty()) {
    throw po::error("the options '--robot' and '--computer' are required");
  }
  if (!(options.megabits_per_second > 0)) {
    throw po::error("option '--rate' must be above 0");
  }
  if (!(options.loss_percent >= 0 && options.loss_percent <= 100)) {
    throw po::error("option '--loss' must be 0 to 100");
  }
  options.radio.bits_per_second = options.megabits_per_second * 1e6;
  options.radio.loss = options.loss_percent / 100;
  options.radio.delay = toMicroseconds("delay", options.delay_ms);
  options.radio.jitter = toMicroseconds("jitter", options.jitter_ms);
  for (const std::string& outage : options.outages) {
    options.radio.outages.push_back(parseOutage(outage));
  }
}

/// Starts a shell command on a host, in a process group of its own.
pid_t start(const fault_bench::NetworkHost& host, const std::string& command) {
  const pid_t child = ::fork();
  if (child < 0) {
    throw std::runtime_error("cannot start '" + command + "'");
  }
  if (child == 0) {
    ::setpgid(0, 0);
    try {
      host.enter();
    } catch (const std::exception& error) {
      std::cerr << error.what() << "\n";
      ::_exit(EXIT_FAILURE);
    }
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(EXIT_FAILURE);
  }
  ::setpgid(child, child);
  return child;
}

volatile sig_atomic_t computer_process = 0;

// Ctrl-C ends the command on the computer's host, and thus everything.
void endComputer(int signal) {
  ::kill(-computer_process, signal);
}

int waitFor(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
}

int run(const Options& options) {
  const fault_bench::NetworkHost robot_host(kRobotAddress);
  const fault_bench::NetworkHost computer_host(kComputerAddress);
  const pid_t robot = start(robot_host, options.robot_command);
  computer_process = start(computer_host, options.computer_command);
  ::signal(SIGINT, endComputer);
  ::signal(SIGTERM, endComputer);
  const fault_bench::RadioLink link(robot_host, computer_host, options.radio);
  const int result = waitFor(computer_process);
  ::kill(-robot, SIGTERM);
  waitFor(robot);
  std::cout << "Packets: " << link.carried() << " carried, " << link.lost() << " lost\n";
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  return test_support::runProgram(
      argc, argv,
      "Two hosts on this machine with an emulated 802.11b link between them, and a command on "
      "each.\nNeeds root. For instance:\n\n"
      "  aibo_radio_link --loss 5 --outage 10:3 --robot 'aibo_rcserver --bind 10.77.0.1' \\\n"
      "      --computer 'roslaunch aibo_driver aibo.launch host:=10.77.0.1'",
      describe(options), [&] {
        check(options);
        return run(options);
      });
}
