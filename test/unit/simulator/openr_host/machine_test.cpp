// A machine that boots the objects of a memory stick: docs/simulated_robot.md, docs/architecture.md.
#include "simulator/openr_host/machine.h"

#include <EndpointTypes.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <gmock/gmock.h>

#include "support/refusal.h"
#include "support/temporary_folder.h"
#include "support/test_client.h"
#include "test_system.h"

namespace openr_host {
namespace {

using testing::HasSubstr;

constexpr std::uint16_t kEchoPort = 7000;
const char kObjects[] = "/MS/OPEN-R/MW/OBJS/ECHO.BIN\n";
const char kConnections[] = "OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S\nEcho.In.OFbkImageVectorData.O\n";
constexpr int kSize = 4096;

/// Wants every camera image, and sends back what a client sends to its port. At the words "off" and "again" it shuts
/// the robot down, the second time to boot it again.
class Echo : public TestObject {
 public:
  static ObjectDescription describe() {
    ObjectDescription description = TestObject::describe("Echo");
    description.observers[kEntry].service = "Echo.In.OFbkImageVectorData.O";
    description.create = [] { return std::make_unique<Echo>(); };
    return description;
  }

  OStatus DoStart(const OSystemEvent& /*event*/) override {
    char design[orobotdesignNAME_MAX + 1];
    OPENR::GetRobotDesign(design);
    OSYSPRINT(("Echo on %s\n", design));
    on_notify = [this](const ONotifyEvent&) { observer().AssertReady(); };
    on_answer = [this](ANTENVMSG message) { goOn(*antEnvMsg::Receive(message)); };
    antEnvCreateSharedBufferMsg message(kSize);
    message.Call(stack_, sizeof(message));
    data_ = static_cast<byte*>(message.buffer.GetAddress());
    listen();
    observer().AssertReady();
    return oSUCCESS;
  }

  OStatus DoDestroy(const OSystemEvent& event) override {
    OSYSPRINT(("Echo has gone\n"));
    return TestObject::DoDestroy(event);
  }

 private:
  template <typename Message>
  void send(Message message) {
    message.Send(stack_, id(), kEntry, sizeof(message));
  }
  void listen() {
    antEnvCreateEndpointMsg message(EndpointType_TCP, kSize);
    message.Call(stack_, sizeof(message));
    endpoint_ = message.moduleRef;
    send(TCPEndpointListenMsg(endpoint_, IP_ADDR_ANY, kEchoPort));
  }
  void goOn(const antEnvMsg& answer) {
    if (answer.operation == antOperation_TCPClose) {
      listen();
    } else if (static_cast<const TCPEndpointBaseMsg&>(answer).error != TCP_SUCCESS) {
      send(TCPEndpointCloseMsg(endpoint_));
    } else if (answer.operation == antOperation_TCPReceive) {
      const int size = static_cast<const TCPEndpointReceiveMsg&>(answer).sizeMin;
      const std::string text(data_, data_ + size);
      if (text == "off" || text == "again") {
        OPENR::Shutdown(text == "off" ? OBootCondition(obcbPAUSE_SW)
                                      : OBootCondition(obcbBOOT_TIMER, 0, obcbttRELATIVE));
      }
      send(TCPEndpointSendMsg(endpoint_, data_, size));
    } else {
      send(TCPEndpointReceiveMsg(endpoint_, data_, 1, kSize));
    }
  }

  const antStackRef stack_{"IPStack"};
  antModuleRef endpoint_;
  byte* data_ = nullptr;
};

/// Five frames pass each time somebody wants to wait for one, and no time in reality.
class HastyClock : public Clock {
 public:
  std::chrono::nanoseconds now() const override { return now_; }
  std::optional<std::chrono::steady_clock::time_point> timeOf(std::chrono::nanoseconds since_begin) const override {
    waited_for.push_back(static_cast<longword>(since_begin / kFramePeriod));
    now_ += 5 * kFramePeriod;
    return std::chrono::steady_clock::now();
  }

  mutable std::vector<longword> waited_for;

 private:
  mutable std::chrono::nanoseconds now_{0};
};

class MachineTest : public testing::Test {
 protected:
  MachineTest() {
    writeObjects(kObjects);
    stick_.write("OPEN-R/MW/CONF/CONNECT.CFG", kConnections);
    options_.memory_stick = stick_.path().string();
    options_.ports = {{kConsolePort, 0}, {kEchoPort, 0}};
    options_.catalog = {{"ECHO.BIN", Echo::describe()}, {"SPARE.BIN", TestObject::describe("Spare")}};
    options_.console = &console_;
  }

  void writeObjects(const std::string& text) const { stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", text); }

  Machine& boot() {
    machine_.emplace(options_, clock_, robot_);
    machine_->boot();
    return *machine_;
  }
  std::string bootError() {
    return test_support::refusalOf<BootError>([this] { boot(); });
  }
  bool echoes(Machine& machine, const std::string& text) {
    test_support::TestClient client(machine.hostPort(kEchoPort));
    client.send(text);
    return machine.runUntil([&] { return client.received() == text; });
  }
  /// A client asks the object to shut the robot down.
  void ask(Machine& machine, const std::string& word) {
    test_support::TestClient client(machine.hostPort(kEchoPort));
    client.send(word);
    EXPECT_TRUE(machine.runUntil([&] { return client.ended(); }) || !machine.isOn());
  }

  test_support::TemporaryFolder stick_;
  std::ostringstream console_;
  SteppedClock clock_;
  FakeRobot robot_;
  MachineOptions options_;
  std::optional<Machine> machine_;
};

TEST_F(MachineTest, WithoutConnectCfgObjectsBootUnconnectedAndTheConsoleSaysSo) {
  std::filesystem::remove(stick_.path("OPEN-R/MW/CONF/CONNECT.CFG"));
  EXPECT_TRUE(echoes(boot(), "text"));
  EXPECT_THAT(console_.str(), HasSubstr("There is no OPEN-R/MW/CONF/CONNECT.CFG"));
}

TEST_F(MachineTest, BootErrorsNameStickFileAndLine) {
  writeObjects("# objects\n" + std::string(kObjects) + "/MS/OPEN-R/MW/OBJS/OTHER.BIN\n");
  EXPECT_THAT(bootError(), AllOf(HasSubstr("OBJECT.CFG:3: OTHER.BIN is neither"), HasSubstr("ECHO.BIN, SPARE.BIN")));
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
  options_.ports[kEchoPort] = other_program.port();
  EXPECT_THAT(bootError(), AllOf(HasSubstr("port " + port + " on 127.0.0.1 is in use"), HasSubstr("--port")));
  options_.ports = {{kConsolePort, other_program.port()}};
  EXPECT_THAT(bootError(), AllOf(HasSubstr("port " + port), HasSubstr("--console-port")));
  options_.ports = {{kConsolePort, 0}};
  options_.bind_address = "203.0.113.1";  // an address for documents, of no computer
  EXPECT_THAT(bootError(), AllOf(HasSubstr("on 203.0.113.1 cannot be used: "), HasSubstr("--bind")));
  options_.bind_address = "here";
  EXPECT_THAT(bootError(), AllOf(HasSubstr("'here'"), HasSubstr("--bind")));
}

TEST_F(MachineTest, SleepsUntilTheNextFrameInWhichObjectsMayGetSomething) {
  robot_.frames_with_image = {6};
  HastyClock clock;
  Machine machine(options_, clock, robot_);
  machine.boot();
  machine.runUntil([&] { return clock.waited_for.size() > 2; });
  EXPECT_EQ(clock.waited_for[0], 0U);
  EXPECT_EQ(clock.waited_for[1], 6U);
  EXPECT_EQ(clock.waited_for[2], 11U);
}

TEST_F(MachineTest, AnObjectCanShutTheRobotDownAndTheConsoleSaysSo) {
  Machine& machine = boot();
  ask(machine, "off");
  EXPECT_FALSE(machine.isOn());
  EXPECT_THAT(console_.str(), HasSubstr("The robot shuts down\nEcho has gone\n"));
  EXPECT_EQ(robot_.calls.back(), "switchOff");
  machine.run();  // returns at once
}

TEST_F(MachineTest, ARebootedMachineServesOnTheSamePortsWithNewObjects) {
  Machine& machine = boot();
  const std::uint16_t port = machine.hostPort(kEchoPort);
  ask(machine, "again");
  EXPECT_TRUE(machine.isOn());
  EXPECT_EQ(machine.hostPort(kEchoPort), port);
  EXPECT_TRUE(echoes(machine, "text"));
  EXPECT_EQ(console_.str(), "Echo on ERS-7\nThe robot boots again\nEcho has gone\nEcho on ERS-7\n");
  EXPECT_EQ(std::count(robot_.calls.begin(), robot_.calls.end(), "switchOff"), 1);
}

}  // namespace
}  // namespace openr_host
