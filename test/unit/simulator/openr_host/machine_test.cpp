// A machine that boots the objects of a memory stick: docs/simulated_robot.md, docs/architecture.md.
#include "simulator/openr_host/machine.h"

#include <gmock/gmock.h>

#include "support/refusal.h"
#include "support/temporary_folder.h"
#include "test_system.h"

namespace openr_host {
namespace {

using testing::HasSubstr;

const char kObjects[] = "/MS/OPEN-R/MW/OBJS/TALKER.BIN\n";

class MachineTest : public testing::Test {
 protected:
  MachineTest() {
    writeObjects(kObjects);
    options_.memory_stick = stick_.path().string();
    options_.ports = {{kConsolePort, 0}};
    options_.catalog = {{"TALKER.BIN", TestObject::describe("Talker")}, {"SPARE.BIN", TestObject::describe("Spare")}};
    options_.console = &console_;
  }

  void writeObjects(const std::string& text) const { stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", text); }

  std::string bootError() {
    return test_support::refusalOf<BootError>([this] { Machine(options_, clock_, robot_).boot(); });
  }
  test_support::TemporaryFolder stick_;
  std::ostringstream console_;
  SteppedClock clock_;
  FakeRobot robot_;
  MachineOptions options_;
};

TEST_F(MachineTest, WithoutConnectCfgObjectsBootUnconnectedAndTheConsoleSaysSo) {
  EXPECT_EQ(bootError(), "");
  EXPECT_THAT(console_.str(), HasSubstr("There is no OPEN-R/MW/CONF/CONNECT.CFG"));
}

TEST_F(MachineTest, BootErrorsNameStickFileAndLine) {
  writeObjects("# objects\n" + std::string(kObjects) + "/MS/OPEN-R/MW/OBJS/OTHER.BIN\n");
  EXPECT_THAT(bootError(), AllOf(HasSubstr("OBJECT.CFG:3: OTHER.BIN is neither"), HasSubstr("SPARE.BIN, TALKER.BIN")));
  stick_.write("OPEN-R/MW/OBJS/OTHER.BIN", "for the robot");
  EXPECT_THAT(bootError(), AllOf(HasSubstr("OTHER.BIN: cannot be loaded"), HasSubstr("scripts/openr_object")));
  writeObjects("[ERS-210]\n" + std::string(kObjects));
  EXPECT_THAT(bootError(), HasSubstr("no object for ERS-7"));
  writeObjects(kObjects);
  stick_.write("OPEN-R/MW/CONF/CONNECT.CFG", "A.B.C.S D.E.C.O\n");
  EXPECT_THAT(bootError(), AllOf(HasSubstr("CONNECT.CFG:1: "), HasSubstr("A.B.C.S")));
  options_.memory_stick = (stick_.path() / "absent").string();
  EXPECT_THAT(bootError(), HasSubstr("absent"));
}

TEST_F(MachineTest, AnAddressOrPortThatCannotBeUsedIsNamedWithARemedy) {
  TcpListener other_program("127.0.0.1", 0);
  const std::string port = std::to_string(other_program.port());
  options_.ports[7000] = other_program.port();
  EXPECT_THAT(bootError(), AllOf(HasSubstr("port " + port + " on 127.0.0.1 is in use"), HasSubstr("--port")));
  options_.ports = {{59000, other_program.port()}};
  EXPECT_THAT(bootError(), AllOf(HasSubstr("port " + port), HasSubstr("--console-port")));
  options_.ports = {{kConsolePort, 0}};
  options_.bind_address = "203.0.113.1";  // an address for documents, of no computer
  EXPECT_THAT(bootError(), AllOf(HasSubstr("on 203.0.113.1 cannot be used: "), HasSubstr("--bind")));
  options_.bind_address = "here";
  EXPECT_THAT(bootError(), AllOf(HasSubstr("'here'"), HasSubstr("--bind")));
}

}  // namespace
}  // namespace openr_host
