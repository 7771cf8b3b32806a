// The executable aibo_rcserver.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "support/process.h"
#include "support/temporary_folder.h"
#include "support/test_client.h"

namespace {

using test_support::Process;
using test_support::Reply;
using test_support::TestClient;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<std::string> command(const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {AIBO_RCSERVER, "--memory-stick", MEMORY_STICK};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return arguments;
}

constexpr std::chrono::seconds kPatience{30};
const std::vector<std::string> kFreePorts = {"--port", "0", "--console-port", "0"};

std::string restOfLine(Process& robot, const std::string& text) {
  return robot.waitForOutput(text + "(.+)\n", kPatience).at(1);
}

// Waits until it listens.
std::string portOf(Process& robot, const std::string& address = "127.0.0.1") {
  return restOfLine(robot, "RCServer listening on " + address + ":");
}

// Tries an address of this computer other than 127.0.0.1.
bool isReachableByAnotherAddress(const std::string& port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
  EXPECT_EQ(::inet_pton(AF_INET, "127.0.0.2", &address.sin_addr), 1);
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  const bool reached = ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::close(socket);
  return reached;
}

// The letter of the robot's first reply; 0 if it sends none.
char letterOfAnswer(const std::string& port, const std::string& request) {
  TestClient client(static_cast<uint16_t>(std::stoi(port)));
  client.send(request);
  std::optional<Reply> reply;
  for (int i = 0; i < 3000 && !reply && !client.ended(); ++i) {
    reply = client.next();
    ::poll(nullptr, 0, 10);
  }
  return reply ? reply->letter : '\0';
}

TEST(AiboRCServer, ServesPicturesUntilItIsToldToStop) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const test_support::TemporaryFolder folder;
    std::vector<std::string> options = kFreePorts;
    options.insert(options.end(), {"--picture-log", folder.path("log")});
    Process robot(command(options));
    EXPECT_EQ(letterOfAnswer(portOf(robot), "FU"), protocol::REPLY_PICTURE);
    std::ifstream log(folder.path("log"));
    long long taken_at = 0;  // nanoseconds since 1970
    EXPECT_TRUE(log >> taken_at);
    EXPECT_LE(std::abs(taken_at / 1000000000 - std::time(nullptr)), 30);
    robot.signal(signal);
    EXPECT_EQ(robot.waitForExit(kPatience), 0) << robot.output();
    EXPECT_THAT(robot.output(), AllOf(HasSubstr("RCServer: waiting for a client on port"), HasSubstr("Stopped\n")));
  }
}

TEST(AiboRCServer, ContinuesWhenNobodyReadsItsOutputAnyMore) {
  std::string line = "exec";
  for (const std::string& argument : command(kFreePorts)) {
    line += " '" + argument + "'";
  }
  Process robot({"bash", "-c", line + " > >(sed -u '/RCServer listening/q')"});
  const std::string port = portOf(robot);
  for (int client = 0; client < 3; ++client) {  // it prints a line about each
    EXPECT_EQ(letterOfAnswer(port, "FU"), protocol::REPLY_PICTURE);
  }
}

TEST(AiboRCServer, IgnoresTheArgumentsThatRoslaunchAdds) {
  std::vector<std::string> options = kFreePorts;
  options.insert(options.end(), {"__name:=robot", "__log:=/nowhere/robot.log"});
  Process robot(command(options));
  portOf(robot);
  robot.signal(SIGTERM);
  EXPECT_EQ(robot.waitForExit(kPatience), 0);
}

TEST(AiboRCServer, RefusesBadOptionsAndNamesThem) {
  const std::vector<std::vector<std::string>> wrong = {{"--port", "65536"},
                                                       {"--port", "-1"},
                                                       {"--port", "x"},
                                                       {"--console-port", "65536"},
                                                       {"--seconds-per-image", "0"},
                                                       {"--battery-minutes", "0"},
                                                       {"--battery-minutes", "nan"},
                                                       {"--encode-time", "-1"},
                                                       {"--encode-time", "10001"},
                                                       {"--stick-time", "-1"},
                                                       {"--stick-time", "60001"},
                                                       {"--processor-slowdown", "-1"},
                                                       {"--processor-slowdown", "1001"},
                                                       {"--hears-itself", "-0.1"},
                                                       {"--hears-itself", "1.1"},
                                                       {"--map-port", "7"},
                                                       {"--map-port", "7="},
                                                       {"--map-port", "7=7x"},
                                                       {"--map-port", "0=7"},
                                                       {"--map-port", "65536=7"},
                                                       {"--map-port", "7=65536"},
                                                       {"--protocol-version", "3"},
                                                       {"--protocol-version", "0"},
                                                       {"--no-such-option"}};
  for (const std::vector<std::string>& options : wrong) {
    Process robot(command(options));
    EXPECT_EQ(robot.waitForExit(kPatience), 2) << options[0];
    EXPECT_THAT(robot.output(), HasSubstr(options[0]));
  }
}

TEST(AiboRCServer, AcceptsTheLargestValuesAndExplainsItsOptions) {
  Process robot(command({"--help", "--port", "65535", "--console-port", "65535", "--encode-time", "10000",
                         "--stick-time", "60000", "--processor-slowdown", "1000", "--hears-itself", "1"}));
  EXPECT_EQ(robot.waitForExit(kPatience), 0);
  EXPECT_THAT(robot.output(), HasSubstr("--processor-slowdown"));
}

TEST(AiboRCServer, MapsPortsOfOtherObjectsAndTellsThem) {
  std::vector<std::string> options = kFreePorts;
  options.insert(options.end(), {"--map-port", "7=0", "--map-port", "65535=0"});
  Process robot(command(options));
  const std::string rest = " of the robot is port ([0-9]+) of this computer\n";
  EXPECT_GT(std::stoi(robot.waitForOutput("Port 7" + rest, kPatience).at(1)), 7);
  EXPECT_GT(std::stoi(robot.waitForOutput("Port 65535" + rest, kPatience).at(1)), 7);
  EXPECT_EQ(robot.waitForOutput("Port 54321" + rest, kPatience).at(1), portOf(robot));
}

TEST(AiboRCServer, TakesItsTimeForPicturesAndFiles) {
  const std::string play = std::string("P\0NOD.MTN", 9) + std::string(5, '\0') + std::string("\1\0\0\0", 4);
  for (const auto& [option, request, letter] :
       {std::tuple<std::string, std::string, char>{"--encode-time", "FU", 'f'}, {"--stick-time", play, 'p'}}) {
    std::vector<std::string> options = kFreePorts;
    options.insert(options.end(), {option, "200"});
    Process robot(command(options));
    const std::string port = portOf(robot);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(letterOfAnswer(port, request), letter);
    EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(200)) << option;
  }
}

TEST(AiboRCServer, SaysWhichSoundItCannotHear) {
  std::vector<std::string> options = kFreePorts;
  options.insert(options.end(), {"--microphone", "/nowhere.wav"});
  Process robot(command(options));
  EXPECT_EQ(robot.waitForExit(kPatience), 1);
  EXPECT_THAT(robot.output(), HasSubstr("/nowhere.wav"));
}

TEST(AiboRCServer, SpeaksVersion2UnlessItIsToldNotTo) {
  for (const auto& [version, letter] : std::map<std::string, char>{{"2", 'x'}, {"1", 'e'}}) {
    std::vector<std::string> options = kFreePorts;
    options.insert(options.end(), {"--protocol-version", version});
    Process robot(command(options));
    EXPECT_EQ(letterOfAnswer(portOf(robot), "X\2"), letter) << version;
  }
}

TEST(AiboRCServer, ListensOnLoopbackUnlessItIsToldOtherwise) {
  for (const auto& [address, reachable] : std::map<std::string, bool>{{"127.0.0.1", false}, {"0.0.0.0", true}}) {
    std::vector<std::string> options = kFreePorts;
    if (reachable) {
      options.insert(options.end(), {"--bind", address});
    }
    Process robot(command(options));
    const std::string console_port = restOfLine(robot, "Console on " + address + ":");
    const std::string port = portOf(robot, address);
    EXPECT_EQ(isReachableByAnotherAddress(port), reachable);
    EXPECT_EQ(isReachableByAnotherAddress(console_port), reachable);
  }
}

TEST(AiboRCServer, SaysWhichPortIsInUse) {
  Process first(command(kFreePorts));
  const std::string port = portOf(first);
  Process second(command({"--port", port, "--console-port", "0"}));
  EXPECT_EQ(second.waitForExit(kPatience), 1);
  EXPECT_THAT(second.output(), HasSubstr(port));
}

TEST(AiboRCServer, SaysWhichMemoryStickIsNotThere) {
  Process robot({AIBO_RCSERVER, "--port", "0", "--console-port", "0", "--memory-stick", "/nowhere"});
  EXPECT_EQ(robot.waitForExit(kPatience), 1);
  EXPECT_THAT(robot.output(), HasSubstr("/nowhere"));
}

TEST(AiboRCServer, FindsItsMemoryStickByItself) {
  Process robot({AIBO_RCSERVER, "--port", "0", "--no-console"});
  portOf(robot);
  Process another({AIBO_RCSERVER, "--port", "0", "--no-console"});
  portOf(another);  // so the port of the console is not in use
  robot.signal(SIGTERM);
  EXPECT_EQ(robot.waitForExit(kPatience), 0) << robot.output();
}

}  // namespace
