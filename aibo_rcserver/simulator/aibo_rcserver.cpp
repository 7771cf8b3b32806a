// Boots a memory stick with RCServer on a simulated ERS-7.

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <ext/stdio_sync_filebuf.h>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host_files/regular_file.h"
#include "objects/HostSettings.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "simulator/ers7/console_commands.h"
#include "simulator/ers7/simulated_ers7.h"
#include "simulator/object_catalog.h"
#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/machine.h"
#include "simulator/openr_host/memory_stick.h"

namespace {

namespace po = boost::program_options;

constexpr int kWrongUsage = 2;
constexpr unsigned kSecondsToStop = 5;
constexpr double kMostEncodeTime = 10000;  // milliseconds
constexpr double kMostStickTime = 60000;   // milliseconds
constexpr double kShortestBattery = 0.01;  // minutes
constexpr double kLongestBattery = 1e5;    // minutes, for ten weeks of tests

constexpr char kRCServerFile[] = "RCSERVER.BIN";
constexpr auto kRobotPort = static_cast<std::uint16_t>(protocol::RCSERVER_PORT);

struct Options {
  bool help = false;
  std::string bind_address;
  int port = 0;
  int console_port = 0;
  bool no_console = false;
  int protocol_version = 0;
  std::vector<std::string> mapped_ports;  ///< "ROBOT=COMPUTER"
  std::string memory_stick;
  std::string microphone;
  double encode_time = 0;  ///< milliseconds
  double stick_time = 0;   ///< milliseconds
  simulated_ers7::SimulatedErs7Options robot;
};

// The folder of the memory stick, which is built and installed beside lib/aibo_driver.
std::string ownMemoryStick() {
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe");
  return (executable.parent_path() / "../../share/aibo_driver/memory_stick").lexically_normal().string();
}

po::options_description describe(Options& options) {
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("help", "print this help and exit")
    ("bind", po::value(&options.bind_address)->default_value("127.0.0.1"),
     "address of this computer on which clients connect; 0.0.0.0 means all of them")
    ("port", po::value(&options.port)->default_value(protocol::RCSERVER_PORT),
     "port for clients of the RCServer; 0 means any free one")
    ("console-port", po::value(&options.console_port)->default_value(openr_host::kConsolePort),
     "port of the wireless console, for telnet; 0 means any free one")
    ("map-port", po::value(&options.mapped_ports)->composing(),
     "for objects other than RCServer: ROBOT=COMPUTER, a port of the robot and the one of this computer, such as 7=7007; "
     "may be repeated")
    ("no-console", po::bool_switch(&options.no_console), "disable the wireless console")
    ("protocol-version", po::value(&options.protocol_version)->default_value(protocol::version2::VERSION),
     "newest version of the protocol that the RCServer speaks; with 1 it answers like a server of 2005 or 2006")
    ("memory-stick", po::value(&options.memory_stick)->default_value(ownMemoryStick(), "its own"),
     "folder with the content of the robot's memory stick")
    ("robot", po::value(&options.robot.design)->default_value("ERS-7"),
     "model of the simulated robot: ERS-7, or ERS-210, which has that robot's joints, sensors, LEDs and ears")
    ("images", po::value(&options.robot.images_folder),
     "folder with photographs (JPEG) that the camera shows in turn, 2 s each; without it, the camera sees a room")
    ("on-table", po::bool_switch(&options.robot.on_table),
     "the robot begins on a table in this room, with an edge to fall off and a board to run into")
    ("battery-minutes", po::value(&options.robot.battery_minutes)->default_value(90),
     "how long a full battery lasts, 0.01 to 100000")
    ("microphone", po::value(&options.microphone),
     "WAV file, 16 kHz with 16 bits, that the microphones hear once, beginning when a client listens or plays a sound")
    ("speaker", po::value(&options.robot.speaker_file),
     "WAV file or pipe that gets what the robot's speaker plays; in bash, >(aplay -q) plays it on this computer")
    ("hears-itself", po::value(&options.robot.hears_itself)->default_value(0),
     "how much of what the speaker plays reaches the microphones, 0 to 1")
    ("encode-time", po::value(&options.encode_time)->default_value(0),
     "milliseconds for the robot to compress a picture: 9 to 14 by instruction count, 32 to 64 in the report of 2006")
    ("stick-time", po::value(&options.stick_time)->default_value(0),
     "milliseconds for the memory stick to read, write or delete a file")
    ("seed", po::value(&options.robot.seed)->default_value(1), "seed of the noise of camera and sensors");
  // clang-format on
  return description;
}

// The arguments without those that roslaunch adds, such as name:=value.
std::vector<std::string> withoutRosArguments(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto is_ros = [](const std::string& argument) { return argument.find(":=") != std::string::npos; };
  arguments.erase(std::remove_if(arguments.begin(), arguments.end(), is_ros), arguments.end());
  return arguments;
}

void checkPort(const std::string& option, int port) {
  if (port < 0 || port > 65535) {
    throw po::error("option '--" + option + "' must be 0 to 65535, not " + std::to_string(port));
  }
}

void parse(const po::options_description& description, const std::vector<std::string>& arguments, Options& options) {
  po::variables_map values;
  po::store(po::command_line_parser(arguments).options(description).positional({}).run(), values);
  po::notify(values);
  options.help = values.count("help") > 0;
  checkPort("port", options.port);
  checkPort("console-port", options.console_port);
  if (options.protocol_version != 1 && options.protocol_version != protocol::version2::VERSION) {
    throw po::error("option '--protocol-version' must be 1 or 2");
  }
  if (!(options.encode_time >= 0 && options.encode_time <= kMostEncodeTime)) {
    throw po::error("option '--encode-time' must be 0 to 10000");
  }
  if (!(options.stick_time >= 0 && options.stick_time <= kMostStickTime)) {
    throw po::error("option '--stick-time' must be 0 to 60000");
  }
  if (!(options.robot.hears_itself >= 0 && options.robot.hears_itself <= 1)) {
    throw po::error("option '--hears-itself' must be 0 to 1");
  }
  if (!(options.robot.battery_minutes >= kShortestBattery && options.robot.battery_minutes <= kLongestBattery)) {
    throw po::error("option '--battery-minutes' must be 0.01 to 100000");
  }
}

// True if RCServer runs. It need not be on the memory stick.
bool runsRCServer(const std::string& memory_stick, const std::string& design) {
  const std::string path = openr_host::findOnMemoryStick(memory_stick, "OPEN-R/MW/CONF/OBJECT.CFG").string();
  std::istringstream file = openr_host::openConfiguration(path);
  const auto objects = openr_host::readObjectConfiguration(file, path, design);
  return std::any_of(objects.begin(), objects.end(),
                     [](const openr_host::ObjectFile& object) { return object.name == kRCServerFile; });
}

/// @return the robot's port and the computer's
std::pair<std::uint16_t, std::uint16_t> readPorts(const std::string& text) {
  unsigned robot_port = 0;
  unsigned host_port = 0;
  char more = 0;
  if (std::sscanf(text.c_str(), "%5u=%5u%c", &robot_port, &host_port, &more) != 2 || robot_port == 0 ||
      robot_port > 65535 || host_port > 65535) {
    throw po::error("option '--map-port' takes two ports such as 7=7007, not '" + text + "'");
  }
  return {static_cast<std::uint16_t>(robot_port), static_cast<std::uint16_t>(host_port)};
}

std::chrono::nanoseconds nanoseconds(double milliseconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double, std::milli>(milliseconds));
}

openr_host::HandlerTime handlerTime(const Options& options, const simulated_ers7::StickSlot& stick) {
  const auto encode_time = nanoseconds(options.encode_time);
  const auto stick_time = nanoseconds(options.stick_time);
  return [=, &stick](const std::string& object) {
    if (object == "PictureEncoder") {
      return encode_time;
    }
    return object == "FileKeeper" ? std::max<std::chrono::nanoseconds>(stick_time, stick.jobTime())
                                  : std::chrono::nanoseconds(0);
  };
}

openr_host::MachineOptions machineOptions(const Options& options, const simulated_ers7::SimulatedErs7& robot) {
  openr_host::MachineOptions machine;
  machine.bind_address = options.bind_address;
  machine.ports.clear();
  for (const std::string& ports : options.mapped_ports) {
    if (!machine.ports.insert(readPorts(ports)).second) {
      throw po::error("option '--map-port' names a port of the robot twice: '" + ports + "'");
    }
  }
  if (runsRCServer(options.memory_stick, robot.design())) {
    machine.ports[kRobotPort] = static_cast<std::uint16_t>(options.port);
  }
  if (!options.no_console) {
    machine.ports[openr_host::kConsolePort] = static_cast<std::uint16_t>(options.console_port);
  }
  machine.memory_stick = options.memory_stick;
  machine.catalog = objectCatalog();
  machine.console = &std::cout;
  machine.handler_time = handlerTime(options, robot.stick());
  return machine;
}

// Scripts read the last lines to learn the ports.
void announce(const openr_host::Machine& machine, const openr_host::MachineOptions& asked, const Options& options) {
  for (const auto& ports : asked.ports) {
    const int port = machine.hostPort(ports.first);
    // Objects print the robot's port, but do not know the computer's port.
    if (port != ports.first && ports.first != openr_host::kConsolePort) {
      std::cout << "Port " << ports.first << " of the robot is port " << port << " of this computer\n";
    }
  }
  if (!options.no_console) {
    std::cout << "Console on " << options.bind_address << ":" << machine.hostPort(openr_host::kConsolePort) << "\n";
  }
  if (asked.ports.count(kRobotPort) != 0) {
    std::cout << "RCServer listening on " << options.bind_address << ":" << machine.hostPort(kRobotPort) << "\n";
  }
  std::cout << std::flush;
}

openr_host::Machine* stoppable_machine = nullptr;

void stopMachine(int) {
  stoppable_machine->stop();
  alarm(kSecondsToStop);
}

void giveUp(int) {
  constexpr char kText[] = "aibo_rcserver: an object does not return, so the robot cannot stop in an orderly way\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kText, sizeof(kText) - 1);
  _exit(EXIT_FAILURE);
}

// Stops the machine on Ctrl-C, or when roslaunch ends. A second signal kills the process.
void stopOnSignal(openr_host::Machine& machine) {
  stoppable_machine = &machine;
  struct sigaction action = {};
  action.sa_handler = stopMachine;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  signal(SIGALRM, giveUp);
}

ssize_t readInput(void* /*unused*/, char* buffer, std::size_t size) {
  const ssize_t count = read(STDIN_FILENO, buffer, size);
  if (count <= 0) {
    std::cerr << "aibo_rcserver: an object waits for input that cannot come\n";
    std::_Exit(EXIT_FAILURE);
  }
  return count;
}

// Ends with the input: Sony's samples repeat a question until they get an answer, even if no more input can come.
void endWithInput() {
  stdin = fopencookie(nullptr, "r", {readInput, nullptr, nullptr, nullptr});
  static __gnu_cxx::stdio_sync_filebuf<char> input(stdin);
  std::cin.rdbuf(&input);
}

void run(const Options& options) {
  openr_host::WallClock clock;
  simulated_ers7::SimulatedErs7 robot(options.robot);
  if (!options.microphone.empty()) {
    robot.hear(options.microphone);
  }
  openr_host::MachineOptions machine_options = machineOptions(options, robot);
  machine_options.on_console_line = [&](const std::string& line) { return simulated_ers7::obeyConsole(robot, line); };
  openr_host::Machine machine(machine_options, clock, robot);
  HostSettings host;
  host.newest_version = options.protocol_version;
  host.memory_stick = options.memory_stick.c_str();
  host.room = robot.stick().room();
  host.open_to_read = host_files::openToRead;  // a robot's stick has neither pipes nor devices
  setHostSettings(host);
  stopOnSignal(machine);
  endWithInput();
  machine.boot();
  announce(machine, machine_options, options);
  machine.run();
  machine.shutdown();
  std::cout << "Stopped" << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  signal(SIGPIPE, SIG_IGN);  // a robot goes on when nobody reads its console
  try {
    Options options;
    const po::options_description description = describe(options);
    parse(description, withoutRosArguments(argc, argv), options);
    if (options.help) {
      std::cout << "An RCServer on a simulated ERS-7. Clients connect by TCP, as to a robot.\n\n" << description;
      return EXIT_SUCCESS;
    }
    run(options);
    return EXIT_SUCCESS;
  } catch (const po::error& error) {
    std::cerr << "aibo_rcserver: " << error.what() << " (--help lists all options)\n";
    return kWrongUsage;
  } catch (const std::exception& error) {
    std::cerr << "aibo_rcserver: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
