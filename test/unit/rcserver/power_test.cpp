// The pause button and a low battery switch the robot off, as POWERMON.BIN of the SDK does: motors off, then
// OPENR::Shutdown() until the pause button is pressed again.

#include <cmath>

#include "motion_bytes.h"
#include "rcserver_fixture.h"
#include "support/safety_net.h"

namespace {

constexpr int kPowerCode = 4;

class PowerTest : public FakeRobotFixture {
 protected:
  void SetUp() override { start(); }

  void raise(longword robot_status) {
    robot_.power_status.robotStatus |= robot_status;
    passUntilOff(1);
  }

  /// @return the number of frames until the robot was off
  unsigned passUntilOff(unsigned most) {
    unsigned passed = 0;
    while (passed < most && machine_->isOn()) {
      passFrames(1);
      ++passed;
    }
    return passed;
  }

  bool isOff() const { return !robot_.powered && isLimp(); }

  // The machine may be off already.
  Frame nextError() {
    std::optional<Frame> told;
    do {
      told = frameThatIsHere();
    } while (told && told->header.kind != 'e');
    return told.value_or(Frame{});
  }

  void playSitForEver() {
    const std::string payload = playPayload("SIT.MTN", 0xffff);
    EXPECT_EQ(answerTo('P', 0, payload).header.kind, 'p');
    passFrames(100);
  }

  // The machine may be off already, and the end of the connection still under way.
  static bool endsFor(TestClient& client) {
    return test_support::eventually([&] { return client.ended(); });
  }
};

TEST_F(PowerTest, PauseCutsTheMotorsAtOnceTellsTheClientAndShutsDown) {
  connectVersion2();
  playSitForEver();
  raise(orsbPAUSE);
  EXPECT_TRUE(isOff());
  expectRefusal(nextError(), kPowerCode, "the pause button was pressed");
  passUntilOff(kFramesASecond);
  EXPECT_FALSE(machine_->isOn());
  EXPECT_TRUE(endsFor(*client_));
  EXPECT_THAT(console_.str(), testing::HasSubstr("the pause button was pressed"));
}

TEST_F(PowerTest, PauseEndsTheConnectionOfAClientOfVersion1Too) {
  client_ = connectServed();
  raise(orsbPAUSE);
  passUntilOff(kFramesASecond);
  EXPECT_FALSE(machine_->isOn());
  EXPECT_TRUE(endsFor(*client_));
}

// The press that has booted the robot must not switch it off.
TEST_F(PowerTest, PauseButtonPressedAtBootIsIgnoredUntilItIsPressedAgain) {
  robot_.power_status.robotStatus = orsbPAUSE;
  start();
  passFrames(kFramesASecond);
  ASSERT_TRUE(machine_->isOn());
  robot_.power_status.robotStatus = 0;
  passFrames(1);
  raise(orsbPAUSE);
  EXPECT_FALSE(machine_->isOn());
}

TEST_F(PowerTest, ClientThatDoesNotReadDelaysTheShutdownByAtMostASecond) {
  robot_.showNoise();
  connectVersion2(4096);
  send(frame('W', 100, 1, kStreamOn));
  for (size_t sent = 0; sends_.empty() || sent < sends_.size();) {
    sent = sends_.size();
    passFrames(5 * FakeRobot::kFramesPerImage);  // no send ends any more when all buffers are full
    send(frame('H', 0, 2));
  }
  raise(orsbPAUSE);
  EXPECT_TRUE(isOff());
  EXPECT_LE(passUntilOff(1000), kFramesASecond + 4);
  EXPECT_FALSE(machine_->isOn());
}

// A rename that is cut can lose the file that it replaces.
TEST_F(PowerTest, AnUploadInProgressIsFinishedAndAnsweredWhileTheMotorsAreOff) {
  startWith("ALLOW_UPLOAD=yes\nALLOW_SHUT_DOWN=yes");
  connectVersion2();
  file_keeper_.slowDown();
  send(frame('U', 0, 1, uploadPayload("NEW.MTN", contentOf(MEMORY_STICK "/OPEN-R/MW/DATA/P/WAG.MTN"))));
  ASSERT_TRUE(file_keeper_.hasJob());
  EXPECT_EQ(answerTo('Q', 0).header.kind, 'q');
  passFrames(4);
  EXPECT_TRUE(isOff());
  passUntilOff(2 * kFramesASecond);
  ASSERT_TRUE(machine_->isOn());
  file_keeper_.finish();
  passUntilOff(kFramesASecond);
  EXPECT_FALSE(machine_->isOn());
  const std::optional<Frame> stored = frameThatIsHere();
  ASSERT_TRUE(stored);
  EXPECT_EQ(stored->header.kind, 'u');
  EXPECT_TRUE(endsFor(*client_));
}

TEST_F(PowerTest, AMemoryStickThatHangsDelaysTheShutdownByThreeSeconds) {
  for (const bool by_client : {true, false}) {
    startWith("ALLOW_SHUT_DOWN=yes");
    connectVersion2();
    file_keeper_.slowDown();
    send(frame('N', 0, 1));
    ASSERT_TRUE(file_keeper_.hasJob());
    if (by_client) {
      send(frame('Q', 0, 2));
    } else {
      disconnect();
      raise(orsbPAUSE);
    }
    EXPECT_TRUE(isOff());
    const unsigned frames = passUntilOff(10 * kFramesASecond);
    EXPECT_GE(frames, 2 * kFramesASecond);
    EXPECT_LE(frames, 3 * kFramesASecond + 10);
    EXPECT_FALSE(machine_->isOn());
    robot_.power_status.robotStatus = 0;
  }
}

TEST_F(PowerTest, LowBatteryIsReportedAtOnceAndTheMotorsStayOnForNow) {
  connectVersion2();
  playSitForEver();
  raise(orsbBATTERY_CAPACITY_LOW);
  expectRefusal(nextError(), kPowerCode, "the battery is low");
  EXPECT_FALSE(isOff());
}

TEST_F(PowerTest, ALowBatteryEndsInOneOfTheseWays) {
  const struct {
    const char* what;
    std::function<void(FakeRobot&)> change;
    longword status;
    unsigned seconds;  // until the robot is off, at most; 0 if it stays on
    bool lies;
  } rows[] = {
      {"it stands", [](FakeRobot&) {}, orsbBATTERY_CAPACITY_LOW, 5, true},
      {"it lies on its side", [](FakeRobot& robot) { robot.layOnSide(); }, orsbBATTERY_CAPACITY_LOW, 1, false},
      {"a leg is jammed", [](FakeRobot& robot) { robot.joint("left_front_rotator").jammed = true; },
       orsbBATTERY_CAPACITY_LOW, 11, false},
      {"its motors are off", [](FakeRobot& robot) { robot.refuses_power = true; }, orsbBATTERY_CAPACITY_LOW, 1, false},
      {"it is being charged", [](FakeRobot&) {}, orsbBATTERY_CAPACITY_LOW | orsbBATTERY_CHARGING, 0, false},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(row.what);
    FakeRobot robot;
    row.change(robot);
    machine_.reset();
    boot(robot);
    passFrames(kFramesASecond);
    robot.power_status.robotStatus = row.status;
    passUntilOff((row.seconds == 0 ? 10 : row.seconds) * kFramesASecond);
    EXPECT_EQ(machine_->isOn(), row.seconds == 0);
    EXPECT_EQ(robot.powered, row.seconds == 0);
    EXPECT_EQ(std::abs(robot.joint("left_front_rotator").position - 1134464) < 2, row.lies);
    machine_.reset();
  }
}

TEST_F(PowerTest, NoClientIsServedWhileTheRobotLiesDown) {
  raise(orsbBATTERY_CAPACITY_LOW);
  passFrames(10);
  ASSERT_TRUE(machine_->isOn());
  const auto newcomer = connect();
  machine_->runPending();
  EXPECT_TRUE(endsFor(*newcomer));
  EXPECT_THAT(console_.str(), testing::HasSubstr("is turned away: the robot goes off"));
}

TEST_F(PowerTest, PowerMonitorCanBeSwitchedOff) {
  startWith("POWER_MONITOR=no");
  EXPECT_THAT(console_.str(), testing::HasSubstr("POWERMON.BIN"));
  raise(orsbPAUSE | orsbBATTERY_CAPACITY_LOW);
  passFrames(200);
  EXPECT_TRUE(machine_->isOn());
  EXPECT_TRUE(robot_.powered);
}

TEST_F(PowerTest, MotorsStayOffAtBootIfTheSettingsSaySo) {
  for (FakeRobot::FakeJoint& joint : robot_.joints) {
    joint.gain = false;
  }
  robot_.powered = false;
  startWith("MOTORS_AT_BOOT=no");
  passFrames(100);
  EXPECT_TRUE(isOff());
  EXPECT_THAT(console_.str(), testing::HasSubstr("MOTORS_AT_BOOT"));
}

}  // namespace
