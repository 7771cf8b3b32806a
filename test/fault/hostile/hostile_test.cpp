// The programs attack only this computer, and not for ever.

#include <gmock/gmock.h>

#include <set>
#include <stdexcept>

#include "hostile/attacks.h"
#include "support/process.h"
#include "support/scripted_server.h"

namespace hostile {
namespace {

using std::chrono::milliseconds;
using test_support::Process;
using test_support::ScriptedServer;
using ::testing::HasSubstr;

constexpr milliseconds kPatience{30000};

TEST(HostileTest, OtherAddressesAndLongAttacksAreRefused) {
  EXPECT_NO_THROW(checkLimits("127.0.0.1", 1));
  EXPECT_NO_THROW(checkLimits("127.1.2.3", 600));
  for (const char* address :
       {"192.168.1.20", "0.0.0.0", "", "localhost", "127.example.com", "128.0.0.1", "1127.0.0.1"}) {
    EXPECT_THROW(checkLimits(address, 10), std::invalid_argument) << address;
  }
  EXPECT_THROW(checkLimits("127.0.0.1", 0), std::invalid_argument);
  EXPECT_THROW(checkLimits("127.0.0.1", 601), std::invalid_argument);
}

TEST(HostileTest, TheProgramsRefuseThemToo) {
  Process client({AIBO_HOSTILE_CLIENT, "--address", "192.168.1.20"});
  EXPECT_EQ(client.waitForExit(kPatience), 2);
  EXPECT_THAT(client.output(), HasSubstr("'192.168.1.20' is not an address of this computer alone"));
  Process robot({AIBO_HOSTILE_ROBOT, "--port", "0", "--seconds", "601"});
  EXPECT_EQ(robot.waitForExit(kPatience), 2);
  EXPECT_THAT(robot.output(), HasSubstr("1 to 600 seconds, not 601"));
  Process wrong({AIBO_HOSTILE_ROBOT, "--port", "0", "--attack", "love"});
  EXPECT_EQ(wrong.waitForExit(kPatience), 2);
  EXPECT_THAT(wrong.output(), HasSubstr("no attack 'love' of a robot that speaks version 2, but reports"));
}

TEST(HostileTest, AnAttackOfClientsEndsAfterItsTime) {
  ScriptedServer server;
  Process client({AIBO_HOSTILE_CLIENT, "--port", std::to_string(server.port()), "--attack", "half", "--seconds", "1"});
  server.accept();
  EXPECT_EQ(client.waitForExit(kPatience), 0) << client.output();
}

TEST(HostileTest, NamesOfAttacksAreUnique) {
  std::set<std::string> names;
  for (const RobotAttack& attack : robotAttacks()) {
    EXPECT_TRUE(names.insert(attack.name + std::to_string(attack.version)).second) << attack.name;
    EXPECT_EQ(findRobotAttack(attack.name, attack.version).title, attack.title);
  }
  for (const ClientAttack& attack : clientAttacks()) {
    EXPECT_TRUE(names.insert(attack.name).second) << attack.name;
    EXPECT_EQ(findClientAttack(attack.name).title, attack.title);
  }
}

}  // namespace
}  // namespace hostile
