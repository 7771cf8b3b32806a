// The executable aibo_rcserver.
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <tuple>

#include "rcserver_fixture.h"
#include "support/process.h"
#include "support/safety_net.h"
#include "support/simulated_robot.h"
#include "support/sockets.h"
#include "support/temporary_folder.h"

namespace {

using test_support::kSafetyNet;
using test_support::Process;
using test_support::TemporaryFolder;
using test_support::TestClient;
using Strings = std::vector<std::string>;

/// A memory stick whose path has a blank and that alone has BOW.MTN, the arguments that roslaunch adds, and among them
/// `options`.
Strings command(const Strings& options = {}, const std::string& port = "0", const std::string& console_port = "0") {
  static const TemporaryFolder folder;
  const std::filesystem::path stick = folder.path("a stick");
  if (!std::filesystem::exists(stick)) {
    std::filesystem::copy(MEMORY_STICK, stick, std::filesystem::copy_options::recursive);
    std::filesystem::rename(stick / "OPEN-R/MW/DATA/P/NOD.MTN", stick / "OPEN-R/MW/DATA/P/BOW.MTN");
  }
  Strings arguments = {AIBO_RCSERVER, "__name:=robot", "--console-port", console_port,
                       "--memory-stick=" + stick.string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  arguments.insert(arguments.end(), {"--port=" + port, "__log:=/nowhere/robot.log"});
  return arguments;
}

std::string restOfLine(Process& robot, const std::string& text) {
  return robot.waitForOutput(text + "(.+)\n").at(1);
}

/// Waits until it listens.
std::string portOf(Process& robot, const std::string& address = "127.0.0.1") {
  return restOfLine(robot, "RCServer listening on " + address + ":");
}

bool isReachable(const std::string& address, const std::string& port) {
  const auto socket = test_support::beginConnecting(address, std::stoi(port));
  pollfd waiting{socket.get(), POLLOUT, 0};
  EXPECT_EQ(::poll(&waiting, 1, 30000), 1);
  return (waiting.revents & POLLERR) == 0;
}

/// What one robot prints until it ends, and how it ends.
std::pair<int, std::string> endOf(const Strings& arguments) {
  Process robot(arguments);
  const auto status = robot.waitForExit(kSafetyNet);
  return {status.value_or(-1), robot.output()};
}

/// The letter of the reply of version 1; 0 if none comes.
char letterOfAnswer(int port, const std::string& request) {
  TestClient client(static_cast<std::uint16_t>(port));
  client.send(request);
  std::optional<test_support::Reply> reply;
  test_support::eventually([&] { return (reply = client.next()).has_value() || client.ended(); });
  return reply ? reply->letter : '\0';
}

TEST(AiboRCServer, TellsEachPortThatIsNotTheRobotsOwnAndStopsWhenItIsTold) {
  const std::string address = "127.0.0.7";
  for (const int signal : {SIGINT, SIGTERM}) {
    Strings free;
    for (std::vector<host_files::FileDescriptor> sockets; sockets.size() < 4;) {
      sockets.push_back(test_support::bindTo(address, 0));
      free.push_back(std::to_string(test_support::portOf(sockets.back())));
    }
    Process robot(command(
        {"--map-port", "65535=0", "--map-port=7=" + free[0], "--bind", address, "--map-port", free[1] + "=" + free[1]},
        free[2], free[3]));
    const std::string any = restOfLine(robot, "Port 65535 of the robot is port ").substr(0, 5);
    EXPECT_EQ(portOf(robot, address), free[2]);
    EXPECT_TRUE(isReachable(address, free[3]));
    robot.signal(signal);
    EXPECT_EQ(robot.waitForExit(kSafetyNet), 0);
    const std::string here = " of this computer\n";
    EXPECT_EQ(robot.output(),
              "RCServer: any address may connect\nRCServer: waiting for a client on port 54321\n"
              "Port 7 of the robot is port " +
                  free[0] + here + "Port 54321 of the robot is port " + free[2] + here +
                  "Port 65535 of the robot is port " + any + here + "Console on " + address + ":" + free[3] +
                  "\nRCServer listening on " + address + ":" + free[2] + "\nStopped\n");
  }
}

TEST(AiboRCServer, ListensOnLoopbackUnlessItIsToldOtherwise) {
  for (const auto& [address, reachable] : std::map<std::string, bool>{{"127.0.0.1", false}, {"0.0.0.0", true}}) {
    Process robot(command(reachable ? Strings{"--bind", address} : Strings{}));
    const std::string console_port = restOfLine(robot, "Console on " + address + ":");
    EXPECT_EQ(isReachable("127.0.0.2", portOf(robot, address)), reachable);
    EXPECT_EQ(isReachable("127.0.0.2", console_port), reachable);
  }
}

TEST(AiboRCServer, HasNoConsoleIfItIsToldSo) {
  const auto other_program = test_support::bindTo("127.0.0.1", 0);
  ASSERT_EQ(::listen(other_program.get(), 1), 0);
  Process robot(command({"--no-console"}, "0", std::to_string(test_support::portOf(other_program))));
  EXPECT_NO_THROW(portOf(robot));
}

// On Linux, opening a pipe waits for somebody who writes into it.
TEST(AiboRCServer, GoesOnIfAMotionOnItsMemoryStickIsAPipe) {
  const Strings arguments = command();
  const std::filesystem::path stick = arguments[4].substr(arguments[4].find('=') + 1);
  ASSERT_EQ(::mkfifo((stick / "OPEN-R/MW/DATA/P/PIPE.MTN").c_str(), 0600), 0);
  Process robot(arguments);
  const int port = std::stoi(portOf(robot));
  EXPECT_EQ(letterOfAnswer(port, fileRequest('P', "PIPE.MTN", 1)), 'e');
  EXPECT_EQ(letterOfAnswer(port, fileRequest('P', "BOW.MTN", 1)), 'p');
}

TEST(AiboRCServer, IsTheModelAndHasTheBatteryThatItIsTold) {
  const auto [status, output] = endOf(command({"--battery-minutes", "0.02", "--robot", "ERS-210"}));
  EXPECT_EQ(status, 0);
  EXPECT_THAT(output, testing::EndsWith("RCServer: the battery is low: the robot lies down and shuts down\n"
                                        "ERROR RCServer: RCServer: the robot does not lie down: this kind of robot has "
                                        "no known way to lie down\nThe robot shuts down\nStopped\n"));
}

TEST(AiboRCServer, TakesItsTimeForPicturesAndFiles) {
  const std::string play = fileRequest('P', "NOD.MTN", 1);
  const std::tuple<Strings, std::string, std::string, char, int> cases[] = {
      {{"--stick-time", "400"}, "full", play, 'p', 400},
      {{"--stick-time", "1"}, "slow", play, 'p', 2000},
      {{"--stick-time", "1", "--encode-time", "300"}, "slow", request('F', 85), 'f', 300}};
  for (const auto& [options, stick, bytes, answer, least] : cases) {
    const test_support::SimulatedRobot robot(options);
    EXPECT_EQ(robot.type("stick " + stick), "ok: stick " + stick + "\n");
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(letterOfAnswer(robot.port(), bytes), answer);
    EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(least)) << options[0];
  }
}

TEST(AiboRCServer, RefusesBadOptionsAndNamesThem) {
  const std::tuple<std::string, Strings, std::string> wrong[] = {
      {"battery-minutes", {"0", "nan", "1e6"}, "0.01 to 100000"},
      {"encode-time", {"-1", "10001"}, "0 to 10000"},
      {"stick-time", {"-1", "60001"}, "0 to 60000"},
      {"hears-itself", {"-0.1", "1.1"}, "0 to 1"},
      {"protocol-version", {"3", "0"}, "1 or 2"}};
  const auto refusal = [](const std::string& message) {
    return std::pair(2, "aibo_rcserver: " + message + " (--help lists all options)\n");
  };
  for (const auto& [option, values, allowed] : wrong) {
    for (const std::string& value : values) {
      EXPECT_EQ(endOf(command({"--" + option, value})), refusal("option '--" + option + "' must be " + allowed));
    }
  }
  for (const char* ports : {"7", "7=", "7=7x", "0=7", "65536=7", "7=65536"}) {
    EXPECT_EQ(endOf(command({"--map-port", "7=7007", "--map-port", ports})),
              refusal("option '--map-port' takes two ports such as 7=7007, not '" + std::string(ports) + "'"));
  }
  EXPECT_EQ(endOf(command({"--map-port", "7=7007", "--map-port", "7=7008"})),
            refusal("option '--map-port' names a port of the robot twice: '7=7008'"));
  EXPECT_EQ(endOf(command({"--no-such-option"})), refusal("unrecognised option '--no-such-option'"));
  EXPECT_EQ(endOf(command({}, "65537")), refusal("option '--port' must be 0 to 65535, not 65537"));
}

TEST(AiboRCServer, SaysWhatItCannotUse) {
  const auto socket = test_support::bindTo("127.0.0.1", 0);
  ::listen(socket.get(), 1);
  const std::string port = std::to_string(test_support::portOf(socket));
  const std::pair<Strings, std::string> missing[] = {
      {command({"--microphone", "/nowhere.wav"}), "/nowhere.wav: cannot be read: No such file or directory"},
      {command({"--speaker", "/nowhere/played.wav"}), "/nowhere/played.wav: cannot be written"},
      {command({"--images", "/nowhere"}), "cannot open the folder of pictures /nowhere: No such file or directory"},
      {command({"--robot", "ERS-9"}), "there is no simulated ERS-9; there are ERS-7 and ERS-210"},
      {{AIBO_RCSERVER, "--memory-stick", "/nowhere", "--no-console"},
       "memory stick: the folder /nowhere cannot be read: No such file or directory"},
      {command({}, port), "port " + port +
                              " on 127.0.0.1 is in use by another program, perhaps a second aibo_rcserver: stop that, "
                              "or choose another port (--port NUMBER; 0 = any free one)"}};
  for (const auto& [arguments, message] : missing) {
    EXPECT_EQ(endOf(arguments), std::pair(1, "aibo_rcserver: " + message + "\n"));
  }
}

}  // namespace
