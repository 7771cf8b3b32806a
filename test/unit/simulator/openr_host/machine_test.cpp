// A machine that boots a memory stick with an object written for the robot.
#include "simulator/openr_host/machine.h"

#include <OPENR/OPENRAPI.h>
#include <dirent.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <thread>

#include "EchoServer_stub.h"
#include "fake_robot.h"
#include "support/temporary_folder.h"
#include "support/test_client.h"
#include "test_system.h"

namespace openr_host {
namespace {

using test_support::TestClient;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint16_t kEchoPort = 7000;
const char kObjects[] = "/MS/OPEN-R/MW/OBJS/ECHO.BIN\n";
const char kConnections[] =
    "OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S\nEchoServer.Image.OFbkImageVectorData.O\n";

/// Records which of its life cycle functions are called, and can fail in one of them.
class LifeRecorder : public OObject {
 public:
  LifeRecorder(std::string name, std::vector<std::string>& calls, std::string failure)
      : name_(std::move(name)), calls_(calls), failure_(std::move(failure)) {}

  OStatus DoInit(const OSystemEvent& /*event*/) override { return called("DoInit"); }
  OStatus DoStart(const OSystemEvent& /*event*/) override { return called("DoStart"); }
  OStatus DoStop(const OSystemEvent& /*event*/) override { return called("DoStop"); }
  OStatus DoDestroy(const OSystemEvent& /*event*/) override { return called("DoDestroy"); }

 private:
  OStatus called(const std::string& function) {
    calls_.push_back(name_ + " " + function);
    return function == failure_ ? oFAIL : oSUCCESS;
  }

  const std::string name_;
  std::vector<std::string>& calls_;
  const std::string failure_;
};

/// Shuts the robot down when it starts, each time with the next of `conditions`; afterwards never again.
class Shutter : public OObject {
 public:
  explicit Shutter(std::vector<OBootCondition>& conditions) : conditions_(conditions) {}

  OStatus DoStart(const OSystemEvent& /*event*/) override {
    if (!conditions_.empty()) {
      const OBootCondition condition = conditions_.front();
      conditions_.erase(conditions_.begin());
      status = OPENR::Shutdown(condition);
    }
    return oSUCCESS;
  }

  static OStatus status;  ///< of the last call

 private:
  std::vector<OBootCondition>& conditions_;
};

OStatus Shutter::status = oSUCCESS;

/// A clock with frames of 80 s, so that no frame begins during a test.
class SlowClock : public Clock {
 public:
  std::chrono::nanoseconds now() const override { return (std::chrono::steady_clock::now() - begin_) / kSlowness; }
  std::optional<std::chrono::steady_clock::time_point> timeOf(std::chrono::nanoseconds since_begin) const override {
    return begin_ + since_begin * kSlowness;
  }

 private:
  static constexpr int kSlowness = 10000;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
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
    stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", kObjects);
    stick_.write("OPEN-R/MW/CONF/CONNECT.CFG", kConnections);
    options_.memory_stick = stick_.path().string();
    options_.ports = {{kConsolePort, 0}, {kEchoPort, 0}};
    options_.catalog = {{"ECHO.BIN", describeEchoServer()}, {"SPARE.BIN", TestObject::describe("Spare")}};
    options_.console = &console_;
  }

  ObjectDescription recorder(const std::string& name, const std::string& failure = "") {
    ObjectDescription description;
    description.name = name;
    description.create = [this, name, failure] { return std::make_unique<LifeRecorder>(name, calls_, failure); };
    return description;
  }

  /// Boots the echo server and an object that shuts the robot down with these conditions, one after the other.
  Machine& bootAndShutDown(const std::vector<OBootCondition>& conditions) {
    stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", std::string(kObjects) + "/MS/OPEN-R/MW/OBJS/SHUTTER.BIN\n");
    conditions_ = conditions;
    ObjectDescription& shutter = options_.catalog["SHUTTER.BIN"];
    shutter.name = "Shutter";
    shutter.create = [this] { return std::make_unique<Shutter>(conditions_); };
    return boot();
  }

  Machine& boot() {
    machine_.emplace(options_, clock_, robot_);
    machine_->boot();
    return *machine_;
  }

  /// Boots a robot whose time hurries, and says for which three frames it waited first.
  std::vector<longword> firstFramesWaitedFor() {
    HastyClock clock;
    Machine machine(options_, clock, robot_);
    machine.boot();
    machine.runUntil([&] { return clock.waited_for.size() > 3; });
    return {clock.waited_for.begin(), clock.waited_for.begin() + 3};
  }

  std::string bootError() {
    try {
      boot();
    } catch (const BootError& error) {
      machine_.reset();
      return error.what();
    }
    return "no error";
  }

  void stepTo(longword frame) {
    while (clock_.frame() < frame) {
      clock_.step();
      machine_->runPending();
    }
  }

  test_support::TemporaryFolder stick_;
  std::ostringstream console_;
  SteppedClock clock_;
  FakeRobot robot_;
  std::vector<std::string> calls_;
  std::vector<OBootCondition> conditions_;
  MachineOptions options_;
  std::optional<Machine> machine_;
};

TEST_F(MachineTest, BootsAnObjectOfTheStickAndServesItsClientsOneAfterTheOther) {
  Machine& machine = boot();
  EXPECT_THAT(console_.str(), HasSubstr("EchoServer on ERS-7\n"));
  for (const std::string text : {"first", "second", "third"}) {
    TestClient client(machine.hostPort(kEchoPort));
    client.send(text);
    ASSERT_TRUE(machine.runUntil([&] { return client.received() == text; }));
  }
  machine.shutdown();
  EXPECT_THAT(console_.str(), HasSubstr("EchoServer has gone\n"));
}

TEST_F(MachineTest, MessagesForABusyObjectAreHandledWhenItHasFinishedEvenIfNoFrameBegins) {
  options_.handler_time = [](const std::string&, Entry, std::chrono::nanoseconds) {
    return std::chrono::microseconds(5);
  };
  SlowClock clock;
  Machine machine(options_, clock, robot_);
  machine.boot();
  TestClient client(machine.hostPort(kEchoPort));
  client.send("first");
  EXPECT_TRUE(machine.runUntil([&] { return client.received() == "first"; }));
}

TEST_F(MachineTest, SleepsUntilTheNextFrameInWhichObjectsMayGetSomething) {
  robot_.frames_with_image = {6};
  EXPECT_THAT(firstFramesWaitedFor(), ElementsAre(0, 6, 11));
}

TEST_F(MachineTest, NoFrameIsSleptThroughWhileAnObjectListens) {
  stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", "/MS/OPEN-R/MW/OBJS/LISTENER.BIN\n");
  stick_.write("OPEN-R/MW/CONF/CONNECT.CFG",
               "OVirtualRobotAudioComm.Mic.OSoundVectorData.S Listener.In.OSoundVectorData.O\n");
  ObjectDescription& listener = options_.catalog["LISTENER.BIN"] = TestObject::describe("Listener");
  listener.observers[TestObject::kSecond].service = "Listener.In.OSoundVectorData.O";
  listener.observers[TestObject::kSecond].connect = [](OObject& object, const OConnectEvent& /*event*/) {
    static_cast<TestObject&>(object).observer().AssertReady();
  };
  EXPECT_THAT(firstFramesWaitedFor(), ElementsAre(0, 6, 11));
}

TEST_F(MachineTest, WhatIsTypedActsOnTheRobotAfterTheFramesThatHavePassed) {
  HastyClock clock;
  std::optional<Machine> machine;
  std::string last_call;
  std::string expected;
  options_.on_console_line = [&](const std::string& /*line*/) {
    last_call = robot_.calls.back();
    expected = "cameraImageDue " + std::to_string(clock.frame());
    machine->stop();
    return "";
  };
  machine.emplace(options_, clock, robot_);
  machine->boot();
  TestClient telnet(machine->hostPort(kConsolePort));
  telnet.send("press head_touch\n");
  machine->run();
  EXPECT_EQ(last_call, expected);
}

TEST_F(MachineTest, AsksForAnImageOncePerFrameAndDeliversThoseThatAreDue) {
  boot();
  robot_.frames_with_image = {4, 8, 13};
  stepTo(13);
  EXPECT_THAT(robot_.frames_seen, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13));
  EXPECT_THAT(robot_.frames_captured, ElementsAre(4, 8, 13));
  EXPECT_THAT(console_.str(), HasSubstr("image 4\nimage 8\nimage 13\n"));
  EXPECT_EQ(robot_.image()->NumberOfReference(), 1);
}

TEST_F(MachineTest, AfterADelayTheBodyGetsTheMissedFramesAndTheCameraLeavesThemOut) {
  boot();
  machine_->runPending();
  clock_.step(100);
  machine_->runPending();
  EXPECT_THAT(robot_.frames_seen, ElementsAre(0, 100));
  EXPECT_EQ(std::count_if(robot_.calls.begin(), robot_.calls.end(),
                          [](const std::string& call) { return call.rfind("passFrame", 0) == 0; }),
            101);
}

TEST_F(MachineTest, NoImageIsCapturedWhenNoObserverIsConnected) {
  stick_.write("OPEN-R/MW/CONF/CONNECT.CFG", "# nothing\n");
  boot();
  robot_.frames_with_image = {1, 2};
  stepTo(3);
  EXPECT_THAT(robot_.frames_seen, ElementsAre(1, 2, 3));
  EXPECT_THAT(robot_.frames_captured, testing::IsEmpty());
}

TEST_F(MachineTest, AllObjectsReachOneStageOfLifeBeforeAnyReachesTheNext) {
  stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", "/MS/OPEN-R/MW/OBJS/A.BIN\n/MS/OPEN-R/MW/OBJS/B.BIN\n");
  stick_.write("OPEN-R/MW/CONF/CONNECT.CFG", "");
  options_.catalog = {{"B.BIN", recorder("B")}, {"A.BIN", recorder("A")}};
  boot().shutdown();
  EXPECT_THAT(calls_, ElementsAre("A DoInit", "B DoInit", "A DoStart", "B DoStart", "A DoStop", "B DoStop",
                                  "A DoDestroy", "B DoDestroy"));
}

TEST_F(MachineTest, AnObjectThatFailsToInitialiseEndsTheBootAndTheOthersAreDestroyed) {
  stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", "/MS/OPEN-R/MW/OBJS/A.BIN\n/MS/OPEN-R/MW/OBJS/B.BIN\n");
  stick_.write("OPEN-R/MW/CONF/CONNECT.CFG", "");
  options_.catalog = {{"A.BIN", recorder("A")}, {"B.BIN", recorder("B", "DoInit")}};
  EXPECT_THAT(bootError(), AllOf(HasSubstr("object B: DoInit() returned 2")));
  EXPECT_THAT(calls_, ElementsAre("A DoInit", "B DoInit", "A DoDestroy"));
}

TEST_F(MachineTest, AnObjectThatFailsToStartEndsTheBootAndTheOthersAreStopped) {
  stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", "/MS/OPEN-R/MW/OBJS/A.BIN\n/MS/OPEN-R/MW/OBJS/B.BIN\n");
  stick_.write("OPEN-R/MW/CONF/CONNECT.CFG", "");
  options_.catalog = {{"A.BIN", recorder("A")}, {"B.BIN", recorder("B", "DoStart")}};
  EXPECT_THAT(bootError(), HasSubstr("object B: DoStart()"));
  EXPECT_THAT(calls_,
              ElementsAre("A DoInit", "B DoInit", "A DoStart", "B DoStart", "A DoStop", "A DoDestroy", "B DoDestroy"));
}

TEST_F(MachineTest, BootErrorsNameStickFileAndLine) {
  stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", "# objects\n" + std::string(kObjects) + "/MS/OPEN-R/MW/OBJS/OTHER.BIN\n");
  EXPECT_THAT(bootError(), testing::EndsWith("OBJECT.CFG:3: OTHER.BIN is neither on the memory stick nor an object of "
                                             "this program, which has ECHO.BIN, SPARE.BIN"));
  stick_.write("OPEN-R/MW/OBJS/OTHER.BIN", "for the robot");
  EXPECT_THAT(bootError(), AllOf(HasSubstr("OTHER.BIN: cannot be loaded"), HasSubstr("scripts/openr_object")));
  stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", "[ERS-210]\n/MS/OPEN-R/MW/OBJS/ECHO.BIN\n");
  EXPECT_THAT(bootError(), HasSubstr("no object for ERS-7"));
  stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", kObjects);
  stick_.write("OPEN-R/MW/CONF/CONNECT.CFG", "A.B.C.S D.E.C.O\n");
  EXPECT_THAT(bootError(), AllOf(HasSubstr("CONNECT.CFG:1: "), HasSubstr("A.B.C.S")));
  options_.memory_stick = (stick_.path() / "absent").string();
  EXPECT_THAT(bootError(), HasSubstr("absent"));
}

TEST_F(MachineTest, APortInUseIsNamedWithARemedy) {
  TcpListener other_program("127.0.0.1", 0);
  const std::string port = std::to_string(other_program.port());
  options_.ports[kEchoPort] = other_program.port();
  EXPECT_THAT(bootError(), AllOf(HasSubstr("port " + port + " on 127.0.0.1 is in use"), HasSubstr("--port")));
  options_.ports = {{kConsolePort, other_program.port()}};
  EXPECT_THAT(bootError(), AllOf(HasSubstr("port " + port), HasSubstr("--console-port")));
  options_.ports = {{kConsolePort, 0}};
  options_.bind_address = "203.0.113.1";
  EXPECT_THAT(bootError(), AllOf(HasSubstr("on 203.0.113.1 cannot be used: "), HasSubstr("--bind")))
      << "an address for documents, of no computer";
  options_.bind_address = "here";
  EXPECT_THAT(bootError(), AllOf(HasSubstr("'here'"), HasSubstr("--bind")));
}

TEST_F(MachineTest, ClosesEveryDescriptorAndBootsAgain) {
  const auto open_descriptors = [] {
    int count = 0;
    DIR* folder = opendir("/proc/self/fd");
    while (readdir(folder) != nullptr) {
      ++count;
    }
    closedir(folder);
    return count;
  };
  Machine& machine = boot();
  machine.shutdown();
  const int before = open_descriptors();
  for (int round = 0; round < 10; ++round) {
    machine.boot();
    TestClient client(machine.hostPort(kEchoPort));
    client.send("x");
    ASSERT_TRUE(machine.runUntil([&] { return client.received() == "x"; }));
    machine.shutdown();
  }
  EXPECT_EQ(open_descriptors(), before);
}

TEST_F(MachineTest, AnObjectCanShutTheRobotDownAndTheConsoleSaysSo) {
  Machine& machine = bootAndShutDown({OBootCondition(obcbPAUSE_SW)});
  EXPECT_TRUE(machine.isOn());
  TestClient listener(machine.hostPort(kConsolePort));
  machine.run();
  EXPECT_FALSE(machine.isOn());
  EXPECT_THAT(console_.str(), HasSubstr("The robot shuts down\nEchoServer has gone\n"));
  EXPECT_EQ(robot_.calls.back(), "switchOff");
  EXPECT_THROW(machine.runPending(), std::logic_error);
  EXPECT_FALSE(machine.runUntil([] { return false; }));
}

TEST_F(MachineTest, ARebootedMachineServesOnTheSamePortsWithNewObjects) {
  const OBootCondition at_once(obcbBOOT_TIMER, 0, obcbttRELATIVE);
  Machine& machine = bootAndShutDown({at_once, at_once});
  const std::uint16_t port = machine.hostPort(kEchoPort);
  TestClient before(port);
  machine.runPending();
  EXPECT_TRUE(before.isAtEnd());

  EXPECT_TRUE(machine.isOn());
  EXPECT_EQ(machine.hostPort(kEchoPort), port);
  TestClient after(port);
  after.send("again");
  EXPECT_TRUE(machine.runUntil([&] { return after.received() == "again"; }));
  const std::string reboot = "The robot boots again\nEchoServer has gone\nEchoServer on ERS-7\n";
  EXPECT_EQ(console_.str(), "EchoServer on ERS-7\n" + reboot + reboot);
  EXPECT_EQ(std::count(robot_.calls.begin(), robot_.calls.end(), "switchOff"), 2);
}

TEST_F(MachineTest, ARebootedMachineCallsTheSameFunctions) {
  std::set<std::string> called;
  options_.on_console_line = [&](const std::string& line) {
    called.insert(line);
    return "";
  };
  options_.handler_time = [&](const std::string& object, Entry, std::chrono::nanoseconds) {
    if (object == "EchoServer") {
      called.insert("time");
    }
    return std::chrono::nanoseconds(0);
  };
  options_.on_camera_image = [&] { called.insert("image"); };
  options_.on_send = [&](const void*, std::size_t) { called.insert("send"); };
  Machine& machine = bootAndShutDown({OBootCondition(obcbBOOT_TIMER, 0, obcbttRELATIVE)});
  machine.runPending();
  called.clear();
  TestClient client(machine.hostPort(kEchoPort));
  client.send("again");
  TestClient telnet(machine.hostPort(kConsolePort));
  telnet.send("press\n");
  robot_.frames_with_image = {1};
  stepTo(1);
  EXPECT_TRUE(machine.runUntil([&] { return called.size() == 4; }));
  EXPECT_THAT(called, ElementsAre("image", "press", "send", "time"));
}

TEST_F(MachineTest, AMachineThatCannotBootAgainIsOffAndSaysWhy) {
  Machine& machine = bootAndShutDown({OBootCondition(obcbBOOT_TIMER, 0, obcbttRELATIVE)});
  stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", "/MS/OPEN-R/MW/OBJS/OTHER.BIN\n");
  EXPECT_THROW(machine.run(), BootError);
  EXPECT_FALSE(machine.isOn());
}

TEST_F(MachineTest, ALaterTimeToBootAgainIsRefusedAndTheMachineStaysOn) {
  for (const auto& condition : {OBootCondition(obcbBOOT_TIMER, 60, obcbttRELATIVE),
                                OBootCondition(obcbBOOT_TIMER | obcbPAUSE_SW, 0, obcbttABSOLUTE)}) {
    bootAndShutDown({condition}).runPending();
    EXPECT_EQ(Shutter::status, oINVALID_ARG);
    EXPECT_TRUE(machine_->isOn());
  }
}

TEST_F(MachineTest, RunFollowsTheWallClockUntilItIsStoppedFromAnotherThread) {
  WallClock clock;
  for (longword frame = 0; frame < 100000; ++frame) {
    robot_.frames_with_image.insert(frame);
  }
  Machine machine(options_, clock, robot_);
  machine.boot();
  std::thread other([&] {
    // The echo shows that the machine is running.
    TestClient client(machine.hostPort(kEchoPort));
    client.send("x");
    while (client.received() != "x") {
      std::this_thread::yield();
    }
    machine.stop();
  });
  machine.run();
  other.join();
  EXPECT_FALSE(robot_.frames_seen.empty());
  EXPECT_TRUE(std::is_sorted(robot_.frames_seen.begin(), robot_.frames_seen.end()));
}

}  // namespace
}  // namespace openr_host
