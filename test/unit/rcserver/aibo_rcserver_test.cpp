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
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/test_client.h"

namespace {

using test_support::Process;
using test_support::Reply;
using test_support::TestClient;
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

TEST(AiboRCServer, ServesPicturesUntilItIsToldToStop) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Process robot(command(kFreePorts));
    TestClient client(static_cast<uint16_t>(std::stoi(portOf(robot))));
    client.send("FU");
    std::optional<Reply> reply;
    for (int i = 0; i < 3000 && !reply && !client.ended(); ++i) {
      reply = client.next();
      ::poll(nullptr, 0, 10);
    }
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->letter, protocol::REPLY_PICTURE);
    robot.signal(signal);
    EXPECT_EQ(robot.waitForExit(kPatience), 0) << robot.output();
    EXPECT_THAT(robot.output(), HasSubstr("Stopped\n"));
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
                                                       {"--protocol-version", "3"},
                                                       {"--protocol-version", "0"},
                                                       {"--no-such-option"}};
  for (const std::vector<std::string>& options : wrong) {
    Process robot(command(options));
    EXPECT_EQ(robot.waitForExit(kPatience), 2) << options[0];
    EXPECT_THAT(robot.output(), HasSubstr(options[0]));
  }
}

TEST(AiboRCServer, SpeaksVersion2UnlessItIsToldNotTo) {
  for (const auto& [version, letter] : std::map<std::string, char>{{"2", 'x'}, {"1", 'e'}}) {
    std::vector<std::string> options = kFreePorts;
    options.insert(options.end(), {"--protocol-version", version});
    Process robot(command(options));
    TestClient client(static_cast<uint16_t>(std::stoi(portOf(robot))));
    client.send("X\2");
    std::optional<Reply> reply;
    for (int i = 0; i < 3000 && !reply && !client.ended(); ++i) {
      reply = client.next();
      ::poll(nullptr, 0, 10);
    }
    ASSERT_TRUE(reply) << version;
    EXPECT_EQ(reply->letter, letter) << version;
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
  robot.signal(SIGTERM);
  EXPECT_EQ(robot.waitForExit(kPatience), 0) << robot.output();
}

}  // namespace
