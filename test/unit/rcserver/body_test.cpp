// Sensors, LEDs, ears and power, in both versions of the protocol.
#include <gmock/gmock.h>

#include <OPENR/OPENRAPI.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/units.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "rcserver/body/LightDriver.h"
#include "rcserver/settings/Settings.h"
#include "rcserver_fixture.h"

namespace {

int failing_shutdowns = 0;  // this many calls of OPENR::Shutdown() fail

}  // namespace

// The linker replaces OPENR::Shutdown() by __wrap..., which can call the original as __real....
extern "C" OStatus __real__ZN5OPENR8ShutdownERK14OBootCondition(const OBootCondition& condition);
extern "C" OStatus __wrap__ZN5OPENR8ShutdownERK14OBootCondition(const OBootCondition& condition) {
  if (failing_shutdowns > 0) {
    --failing_shutdowns;
    return oFAIL;
  }
  return __real__ZN5OPENR8ShutdownERK14OBootCondition(condition);
}

namespace {

using namespace protocol::version2;
using robot_model::Sensor;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Eq;
using ::testing::Field;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::Lt;
using ::testing::Not;

constexpr int kHeadTouch = 5;
constexpr int kPawLeftFront = 14;
constexpr int kRangeNear = 53;
constexpr int kAccelerationUpDown = 63;
constexpr int kBattery = 66;
constexpr int kTemperature = 67;

constexpr int kHeadColor = 1;  // only on or off
constexpr int kFace1 = 7;      // intensity and mode
constexpr int kLeftEar = 1;
constexpr int kRightEar = 2;

// The client speaks version 1 until a test changes that.
class BodyTest : public FakeRobotFixture {
 protected:
  void SetUp() override {
    robot_.power_status.remainingCapacity = 87;
    robot_.power_status.temperature = 2982;  // 25.05 degrees Celsius
    start();
  }

  void start() {
    FakeRobotFixture::start();
    client_ = connectServed();
  }

  void startWith(const std::string& settings) {
    stick_.write(SETTINGS_FILE, settings);
    start();
  }

  // The number of frames in which an ear was drawn.
  long framesDrawn(int ear) const {
    const std::vector<bool>& path = robot_.ears[static_cast<size_t>(ear - 1)].path;
    return std::count(path.begin(), path.end(), true);
  }
};

// ------------------------------------------------------------------------------------------------ version 1: sensors

TEST_F(BodyTest, SensorIsReadInTheUnitsOfVersion1) {
  robot_.sensor("range_near") = 123456;
  robot_.sensor("acceleration_up_down") = -9806650;
  robot_.sensor("head_touch") = 17;
  robot_.sensor("paw_left_front") = 1;
  passFrames(kUntilMeasured);
  expectAnswer(request('S', kRangeNear), 's', kRangeNear, 12);
  expectAnswer(request('S', kAccelerationUpDown), 's', kAccelerationUpDown, -981);
  expectAnswer(request('S', kHeadTouch), 's', kHeadTouch, 17);
  expectAnswer(request('S', kPawLeftFront), 's', kPawLeftFront, 1);
}

TEST_F(BodyTest, BatteryAboveFullIsReportedAsFull) {
  robot_.power_status.remainingCapacity = 101;
  passFrames(125 + 4);
  expectAnswer(request('S', kBattery), 's', kBattery, 100);
}

TEST_F(BodyTest, BatteryIsReadOnceASecond) {
  expectAnswer(request('S', kBattery), 's', kBattery, 87);
  expectAnswer(request('S', kTemperature), 's', kTemperature, 2505);
  robot_.power_status.remainingCapacity = 86;
  robot_.power_status.temperature = 65535;
  passFrames(100);
  expectAnswer(request('S', kBattery), 's', kBattery, 87);
  passFrames(40);
  expectAnswer(request('S', kBattery), 's', kBattery, 86);
  expectAnswer(request('S', kTemperature), 's', kTemperature, 32767);
  robot_.refuses_power_status = true;
  passFrames(140);
  expectAnswer(request('S', kBattery), 's', kBattery, 86);
  robot_.refuses_power_status = false;
  robot_.power_status.remainingCapacity = 85;
  passFrames(140);
  expectAnswer(request('S', kBattery), 's', kBattery, 85);
}

TEST_F(BodyTest, JointReadAsASensorGivesItsAngle) {
  const int angle = protocol::centidegreesFromMicroradians(FakeRobot::measured(robot_.joint("tail_tilt")));
  expectAnswer(request('S', 52), 's', 52, angle);
}

TEST_F(BodyTest, SensorThatDoesNotOpenIsNamedAndReadsAsZero) {
  robot_.missing_locator = "PRM:/p1-Sensor:p1";
  robot_.sensor("range_chest") = 500000;
  start();
  EXPECT_THAT(console_.str(), HasSubstr("range_chest (PRM:/p1-Sensor:p1) does not open"));
  expectAnswer(request('S', 55), 's', 55, 0);
  expectAnswer(request('S', kBattery), 's', kBattery, 87);
}

class SensorBlockTest : public BodyTest {
 protected:
  // The values of S 0; checks the reply after them.
  std::vector<int> readBlock(size_t values) {
    client_->send(request('S', 0));
    const size_t size = values * protocol::VALUE_SIZE + protocol::VALUE_REPLY_SIZE;
    std::vector<uint8_t> bytes;
    EXPECT_TRUE(machine_->runUntil([&] { return (bytes = client_->take(size)).size() == size; }));
    EXPECT_EQ(std::vector<uint8_t>(bytes.end() - 4, bytes.end()), (std::vector<uint8_t>{'s', 0, 0, 0}));
    std::vector<int> block;
    for (size_t i = 0; i < values; ++i) {
      block.push_back(protocol::decodeValue(bytes.data() + i * protocol::VALUE_SIZE));
    }
    return block;
  }

  // The values that S returns for each identifier in turn.
  std::vector<int> readOneByOne(const std::vector<int>& left_out) {
    std::vector<int> all;
    for (int identifier = 1; identifier < 256; ++identifier) {
      client_->send(request('S', identifier));
      const std::optional<Reply> reply = await(*client_);
      machine_->runPending();
      if (reply->letter == 's' && std::find(left_out.begin(), left_out.end(), identifier) == left_out.end()) {
        all.push_back(reply->value.value);
      }
    }
    return all;
  }
};

TEST_F(SensorBlockTest, HoldsAllJointsAndSensorsByAscendingIdentifier) {
  for (size_t i = 0; i < robot_.sensor_values.size(); ++i) {
    robot_.sensor_values[i] = static_cast<int>(10000 * (i + 1));
  }
  passFrames(kUntilMeasured);
  EXPECT_EQ(readBlock(36), readOneByOne({}));
}

TEST_F(SensorBlockTest, JointsAndSensorsCanBeLeftOutAndTakenIn) {
  expectAnswer(request('S', 2, 0), 's', 2, 0);
  expectAnswer(request('S', kBattery, 0), 's', kBattery, 0);
  EXPECT_EQ(readBlock(34), readOneByOne({2, kBattery}));
  expectAnswer(request('S', 2, 1), 's', 2, 1);
  expectAnswer(request('S', kBattery, 1), 's', kBattery, 1);
  EXPECT_EQ(readBlock(36), readOneByOne({}));
}

TEST_F(SensorBlockTest, RefusesUnknownSensorsAndValuesOtherThanZeroAndOne) {
  for (const int identifier : {10, 50, 68, 91, 92, 93, 255}) {
    expectError(request('S', identifier));
    expectError(request('S', identifier, 1));
  }
  expectError(request('S', kBattery, 2));
  expectError(request('S', 0, 1));
}

// ---------------------------------------------------------------------------------------------------- version 1: LEDs

TEST_F(BodyTest, EveryLedIsSetByItsIdentifier) {
  for (size_t i = 0; i < robot_.leds.size(); ++i) {
    const robot_model::Led& led = robot_.model.leds[i];
    const bool is_switch = led.kind == robot_model::LED2;
    expectAnswer(request('L', led.identifier, 0x7f40), 'l', led.identifier, is_switch ? 255 : 0x40);
    passFrames(kUntilMeasured);
    EXPECT_EQ(robot_.leds[i].intensity, is_switch ? 1 : 0x40) << led.name;
    EXPECT_EQ(robot_.leds[i].commands, 1) << led.name;
    expectAnswer(request('L', led.identifier, 0x100), 'l', led.identifier, 0);
    passFrames(kUntilMeasured);
    EXPECT_EQ(robot_.leds[i].intensity, 0) << led.name;
  }
}

TEST_F(BodyTest, AllLedsAndTheFaceWithAMode) {
  expectAnswer(request('L', 0, 200), 'l', 0, 200);
  passFrames(kUntilMeasured);
  EXPECT_THAT(robot_.leds, Each(Field(&FakeRobot::FakeLed::intensity, AnyOf(1, 200))));
  EXPECT_EQ(robot_.led("face_14").intensity, 200);
  EXPECT_EQ(robot_.led("wireless").intensity, 1);
  expectAnswer(request('Y', 2, 100), 'y', 2, 100);
  passFrames(kUntilMeasured);
  EXPECT_THAT(robot_.leds, Each(Field(&FakeRobot::FakeLed::intensity, AnyOf(1, 100))));
  EXPECT_EQ(robot_.led("face_1").intensity, 100);
  EXPECT_EQ(robot_.led("face_1").mode, oled3_MODE_B);
  for (const int led : {kFace1, 0}) {
    expectAnswer(request('L', led, 50), 'l', led, 50);
    passFrames(kUntilMeasured);
    EXPECT_EQ(robot_.led("face_1").intensity, 50);
    EXPECT_EQ(robot_.led("face_1").mode, oled3_MODE_B) << "L does not change the mode";
  }
  expectAnswer(request('Y', 1, 50), 'y', 1, 50);
  passFrames(kUntilMeasured);
  EXPECT_EQ(robot_.led("face_1").mode, oled3_MODE_A) << "the mode alone changes";
  expectAnswer(request('Y', 1, 0), 'y', 1, 0);
  passFrames(kUntilMeasured);
  EXPECT_THAT(robot_.leds, Each(Field(&FakeRobot::FakeLed::intensity, 0)));
}

TEST_F(BodyTest, LedsGoOffAndEarsAreLetGoWhenTheClientGoes) {
  expectAnswer(request('L', 0, 200), 'l', 0, 200);
  expectAnswer(request('K', 0, 1), 'k', 0, 1);
  passFrames(8);
  disconnect();
  passFrames(kUntilMeasured);
  EXPECT_THAT(robot_.leds, Each(Field(&FakeRobot::FakeLed::intensity, 0)));
  EXPECT_THAT(robot_.ears, Each(Field(&FakeRobot::FakeEar::drawn, false)));
  EXPECT_LT(framesDrawn(kLeftEar), LightDriver::EAR_FRAMES);
}

TEST_F(BodyTest, LedThatDoesNotOpenIsNamedAndTheOthersShine) {
  robot_.missing_locator = robot_.model.leds[1].locator;
  start();
  EXPECT_THAT(console_.str(), HasSubstr("head_white (PRM:/r1/c1/c2/c3/l2-LED2:l2) does not open"));
  expectAnswer(request('L', 0, 200), 'l', 0, 200);
  passFrames(kUntilMeasured);
  EXPECT_EQ(robot_.led("head_white").intensity, 0);
  EXPECT_EQ(robot_.led("head_color").intensity, 1);
  EXPECT_GT(robot_.leds.back().intensity, 0);
}

TEST_F(BodyTest, LedsShineWhileTheMotorsAreOffAndTheMotorsStayOff) {
  robot_.missing_locator = robot_.model.joints[3].locator;
  for (FakeRobot::FakeJoint& joint : robot_.joints) {
    joint.gain = false;
  }
  start();
  expectAnswer(request('L', kHeadColor, 1), 'l', kHeadColor, 255);
  passFrames(kUntilMeasured);
  EXPECT_EQ(robot_.led("head_color").intensity, 1);
  EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::gain, false)));
}

TEST_F(BodyTest, MotionIsTheSameWithAndWithoutLeds) {
  std::vector<int>& path = robot_.joint("head_pan").path;
  std::vector<std::vector<int>> paths;
  const int begin = robot_.joint("head_pan").position;
  for (const bool blink : {false, true}) {
    start();
    path.clear();
    expectAnswer(request('J', 2, 4000), 'j', 2, 4000);
    for (int i = 0; i < 100; ++i) {
      if (blink) {
        expectAnswer(request('L', 0, i % 2), 'l', 0, i % 2);
      }
      passFrames(1);
    }
    paths.push_back(path);
    path.clear();
    robot_.joint("head_pan").position = robot_.joint("head_pan").reference = begin;
  }
  EXPECT_EQ(paths[0], paths[1]);
}

// ---------------------------------------------------------------------------------------------------- version 1: ears

TEST_F(BodyTest, EarIsDrawnForItsTimeAndLetGo) {
  expectAnswer(request('K', kRightEar, 1), 'k', kRightEar, 1);
  passFrames(100);
  EXPECT_EQ(framesDrawn(kRightEar), LightDriver::EAR_FRAMES);
  EXPECT_EQ(framesDrawn(kLeftEar), 0);
  const std::vector<bool>& path = robot_.ears[1].path;
  const auto drawn = std::find(path.begin(), path.end(), true);
  EXPECT_EQ(std::count(drawn, drawn + LightDriver::EAR_FRAMES, true), LightDriver::EAR_FRAMES) << "without a gap";
  EXPECT_FALSE(robot_.ears[1].drawn);
  EXPECT_EQ(robot_.ears[1].period, 1);
}

TEST_F(BodyTest, BothEarsAreLetGoAtOnce) {
  expectAnswer(request('K', 0, 1), 'k', 0, 1);
  passFrames(1);
  expectAnswer(request('K', 0, 0), 'k', 0, 0);
  passFrames(100);
  for (const int ear : {kLeftEar, kRightEar}) {
    EXPECT_THAT(framesDrawn(ear), AllOf(Gt(0), Lt(LightDriver::EAR_FRAMES)));
  }
}

TEST_F(BodyTest, EarThatDoesNotOpenIsNamedAndTheOtherIsDrawn) {
  robot_.missing_locator = robot_.model.ears[0].locator;
  start();
  EXPECT_THAT(console_.str(), HasSubstr(std::string(robot_.model.ears[0].name) + " (" + robot_.missing_locator));
  send(request('K', kLeftEar, 1) + request('K', kRightEar, 1));
  passFrames(100);
  EXPECT_EQ(framesDrawn(kLeftEar), 0);
  EXPECT_EQ(framesDrawn(kRightEar), LightDriver::EAR_FRAMES);
}

TEST_F(BodyTest, EarDrawnAgainAndAgainRestsAsLongAsItIsDrawn) {
  for (int i = 0; i < 400; ++i) {
    client_->send(request('K', 0, 1));
    ASSERT_TRUE(await(*client_));
    passFrames(1);
  }
  EXPECT_GT(framesDrawn(kLeftEar), 100);
  EXPECT_LE(framesDrawn(kLeftEar), 200 + LightDriver::EAR_FRAMES);
}

TEST_F(BodyTest, EarIsLetGoAtOnceAndCannotBeDrawnWhileItRests) {
  expectAnswer(request('K', kLeftEar, 1), 'k', kLeftEar, 1);
  passFrames(4);
  expectAnswer(request('K', kLeftEar, 0), 'k', kLeftEar, 0);
  expectAnswer(request('K', kLeftEar, 1), 'k', kLeftEar, 0);
  expectAnswer(request('K', 0, 1), 'k', 0, 0);  // only the right one is drawn
  passFrames(100);
  EXPECT_GT(framesDrawn(kLeftEar), 0);
  EXPECT_LT(framesDrawn(kLeftEar), LightDriver::EAR_FRAMES);
  expectAnswer(request('K', kLeftEar, 1), 'k', kLeftEar, 1);
}

TEST_F(BodyTest, RobotOfUnknownDesignRefusesCommandsToAllLedsAndEars) {
  robot_.design_name = "ERS-8";
  start();
  expectError(request('L', 0, 1));
  expectError(request('Y', 1, 1));
  expectError(request('K', 0, 1));
  EXPECT_THAT(console_.str(), HasSubstr("the design \"ERS-8\" is not known"));
}

TEST_F(BodyTest, EarsOfAnErs210AreDrawnAndLetGo) {
  FakeRobot ers210("ERS-210");
  machine_.reset();
  boot(ers210);
  passFrames(kUntilMeasured);
  client_ = connectServed();
  expectAnswer(request('K', 0, 1), 'k', 0, 1);
  passFrames(100);
  for (const FakeRobot::FakeEar& ear : ers210.ears) {
    EXPECT_EQ(ear.period, 0);
    EXPECT_EQ(std::count(ear.path.begin(), ear.path.end(), true), LightDriver::EAR_FRAMES);
  }
  client_.reset();
  machine_.reset();
}

// --------------------------------------------------------------------------------------------------- version 1: power

TEST_F(BodyTest, ShuttingDownAndRebootingAreRefusedUnlessTheSettingsAllowThem) {
  expectError(request('Q', 0, 0));
  expectError(request('R', 0, 0));
  passFrames(10);
  EXPECT_TRUE(robot_.powered);
  EXPECT_TRUE(machine_->isOn());
  startWith("ALLOW_REBOOT=yes");
  expectError(request('Q', 0, 0));
  startWith("ALLOW_SHUT_DOWN=yes");
  expectError(request('R', 0, 0));
}

TEST_F(BodyTest, ShutDownAnswersThenMotorsAreOffAndTheRobotIsOff) {
  startWith("ALLOW_SHUT_DOWN=yes");
  const int times = robot_.times_switched_off;
  client_->send(request('Q', 3, 0));
  machine_->runUntil([&] { return !machine_->isOn(); });
  const std::optional<Reply> reply = client_->next();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->letter, 'q');
  EXPECT_EQ(reply->value.identifier, 3);
  EXPECT_TRUE(client_->ended());
  EXPECT_FALSE(robot_.powered);
  EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::gain, false)));
  EXPECT_EQ(robot_.open_primitives, 0);
  EXPECT_EQ(robot_.times_switched_off, times + 1);
}

TEST_F(BodyTest, RebootAnswersAndServesTheNextClient) {
  startWith("ALLOW_REBOOT=yes");
  const int times = robot_.times_switched_off;
  client_->send(request('R', 0, 0));
  machine_->runUntil([&] { return robot_.times_switched_off > times; });
  EXPECT_TRUE(machine_->isOn());
  const std::optional<Reply> reply = client_->next();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->letter, 'r');
  EXPECT_TRUE(client_->ended());
  passFrames(kUntilMeasured);
  client_ = connectServed();
  expectAnswer(request('S', kBattery), 's', kBattery, 87);
}

TEST_F(BodyTest, PowerOrderThatTheRobotRefusesIsForgotten) {
  startWith("ALLOW_SHUT_DOWN=yes\nALLOW_REBOOT=yes\nALLOW_DELETE=yes");
  for (const char letter : {'Q', 'R'}) {
    failing_shutdowns = 1;
    client_->send(request(letter, 0, 0));
    EXPECT_TRUE(awaitEnd(*client_));
    EXPECT_EQ(failing_shutdowns, 0);
    EXPECT_THAT(console_.str(), HasSubstr("RCServer: the robot does not "));
    client_ = connectServed();
    disconnect();
    EXPECT_TRUE(machine_->isOn()) << "the order is still carried out";
    client_ = connectServed();
    passFrames(400);
    expectError(kRefused);  // it is served, however long the memory stick might have been waited for
  }
  file_keeper_.slowDown();
  send(fileRequest('D', "NOD.MTN", 0));
  disconnect();
  robot_.power_status.robotStatus |= orsbPAUSE;
  passFrames(100);
  EXPECT_TRUE(machine_->isOn()) << "it waits for the memory stick anew";
}

// Both times together take longer than it may take to lie down.
TEST_F(BodyTest, ARobotThatDidNotShutDownHasItsTimeToLieDownAgain) {
  disconnect();
  failing_shutdowns = 1;
  robot_.power_status.robotStatus = orsbBATTERY_CAPACITY_LOW;
  passFrames(6 * kFramesASecond);
  EXPECT_EQ(failing_shutdowns, 0);
  robot_.power_status.robotStatus = 0;
  passFrames(6 * kFramesASecond);
  connectVersion2();
  FakeRobotFixture::answerTo('E', POSTURE_STAND);
  passFrames(4 * kFramesASecond);
  robot_.power_status.robotStatus = orsbBATTERY_CAPACITY_LOW;
  passFrames(kFramesASecond);
  EXPECT_TRUE(robot_.powered);
  for (unsigned i = 0; i < 6 * kFramesASecond && machine_->isOn(); ++i) {
    passFrames(1);
  }
  EXPECT_FALSE(machine_->isOn());
  EXPECT_NEAR(robot_.joint("left_front_rotator").position, 1134464, 2);
  EXPECT_THAT(console_.str(), Not(HasSubstr("the robot does not lie down")));
}

TEST_F(BodyTest, ConsoleNamesNoReasonOfAnEarlierPowerOrder) {
  startWith("ALLOW_SHUT_DOWN=yes\n");
  failing_shutdowns = 1;
  robot_.power_status.robotStatus |= orsbPAUSE;
  passFrames(1);
  EXPECT_TRUE(awaitEnd(*client_));
  EXPECT_THAT(console_.str(), HasSubstr("is gone: the pause button was pressed"));
  client_ = connectServed();
  client_->send(request('Q', 0, 0));
  EXPECT_TRUE(awaitEnd(*client_));
  EXPECT_THAT(console_.str(), HasSubstr("is gone: it switched the robot off"));
}

TEST_F(BodyTest, RequestsAfterAShutDownAreNotCarriedOut) {
  startWith("ALLOW_SHUT_DOWN=yes");
  client_->send(request('Q', 0, 0) + request('L', kHeadColor, 1));
  machine_->runUntil([&] { return !machine_->isOn(); });
  ASSERT_TRUE(client_->next());
  EXPECT_FALSE(client_->next());
}

TEST_F(BodyTest, UploadOfAnObjectIsAlwaysRefused) {
  startWith("ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\nALLOW_SHUT_DOWN=yes\nALLOW_REBOOT=yes");
  expectError(request('C', 0) + std::string("RCSERVER.BIN\0\0\2\0", 16) + "WW");
  expectAnswer(request('S', kBattery), 's', kBattery, 87);
}

// ----------------------------------------------------------------------------------------------------------- version 2

class BodyVersion2Test : public BodyTest {
 protected:
  void SetUp() override {
    BodyTest::SetUp();
    reconnect();
  }

  std::string leds(const std::vector<LedValue>& values) const {
    LedValues all = {static_cast<unsigned char>(values.size()), {}};
    std::copy(values.begin(), values.end(), all.leds);
    return payloadOf(all);
  }

  // The next telemetry: values of sensors by identifier.
  std::vector<TelemetryEntry> sensorTelemetry() {
    answerTo('T', 0, payloadOf(TelemetryPeriod{4}));
    passFrames(8);
    Telemetry telemetry{};
    const std::optional<Frame> pushed = nextFrame();
    EXPECT_EQ(decode(pushed->payload.data(), pushed->payload.size(), &telemetry), nullptr);
    std::vector<TelemetryEntry> sensors;
    std::copy_if(telemetry.entries, telemetry.entries + telemetry.count, std::back_inserter(sensors),
                 [](const TelemetryEntry& entry) { return entry.group == GROUP_SENSOR; });
    return sensors;
  }

  const std::string on_ = std::string(1, '\1');  // of the motors
  const std::string off_ = std::string(1, '\0');
};

MATCHER_P2(IsSensor, id, value, "") {
  return arg.id == id && arg.value == value;
}

TEST_F(BodyVersion2Test, TelemetryHasAllSensorsInMillionths) {
  robot_.sensor("range_near") = 123456;
  robot_.sensor("head_touch") = 17;
  robot_.sensor("paw_left_front") = 1;
  passFrames(kUntilMeasured);
  const std::vector<TelemetryEntry> sensors = sensorTelemetry();
  EXPECT_EQ(sensors.size(), 18U);
  EXPECT_THAT(sensors, Contains(IsSensor(kRangeNear, 123456)));
  EXPECT_THAT(sensors, Contains(IsSensor(kHeadTouch, 17000000)));
  EXPECT_THAT(sensors, Contains(IsSensor(kPawLeftFront, 1)));
  EXPECT_THAT(sensors, Contains(IsSensor(kBattery, 870000)));
  EXPECT_THAT(sensors, Contains(IsSensor(kTemperature, 25050000)));
}

TEST_F(BodyVersion2Test, TelemetryLeavesOutSensorsWithoutAValue) {
  robot_.missing_locator = "PRM:/p1-Sensor:p1";
  start();
  reconnect();
  const std::vector<TelemetryEntry> sensors = sensorTelemetry();
  EXPECT_EQ(sensors.size(), 17U);
  EXPECT_THAT(sensors, Not(Contains(Field(&TelemetryEntry::id, Eq(55)))));
}

TEST_F(BodyVersion2Test, JointsThatReportWithoutSensorsAreServed) {
  robot_.sensor_values.clear();
  answerTo('T', 0, payloadOf(TelemetryPeriod{4}));
  passFrames(8);
  EXPECT_EQ(nextFrame()->header.kind, TELEMETRY_PUSH);
}

TEST_F(BodyVersion2Test, SensorsThatReportWithoutJointsAreServed) {
  robot_.missing_locator = robot_.model.joints[0].locator;
  start();
  reconnect();
  EXPECT_EQ(sensorTelemetry().size(), 18U);
  expectRefusal(answerTo('O', 0, on_), CODE_REFUSED, "cannot switch its motors on");
}

TEST_F(BodyVersion2Test, LedsAreSetTogetherAndAnsweredByTheAcceptedValues) {
  const Frame answer = answerTo('L', 0, leds({{kHeadColor, 3, LED_MODE_B}, {kFace1, 77, LED_MODE_B}}));
  EXPECT_EQ(answer.header.kind, 'l');
  EXPECT_EQ(textOf(answer), leds({{kHeadColor, 255, LED_MODE_A}, {kFace1, 77, LED_MODE_B}}));
  passFrames(kUntilMeasured);
  EXPECT_EQ(robot_.led("head_color").intensity, 1);
  EXPECT_EQ(robot_.led("face_1").intensity, 77);
  EXPECT_EQ(robot_.led("face_1").mode, oled3_MODE_B);
}

TEST_F(BodyVersion2Test, UnknownLedRefusesTheWholeRequest) {
  expectRefusal(answerTo('L', 0, leds({{kHeadColor, 255, LED_MODE_A}, {99, 1, LED_MODE_A}})), CODE_REFUSED, "LED 99");
  expectRefusal(answerTo('L', 0, leds({{99, 1, LED_MODE_A}, {kHeadColor, 255, LED_MODE_A}})), CODE_REFUSED, "LED 99");
  passFrames(kUntilMeasured);
  EXPECT_EQ(robot_.led("head_color").intensity, 0);
}

// Vectors for an ear are output before the one with the present positions.
TEST_F(BodyVersion2Test, GainsGoOnAfterThePresentPositionsEvenBehindVectorsForAnEar) {
  answerTo('O', 0, off_);
  FakeRobot::FakeJoint& tail = robot_.joint("tail_pan");
  tail.reference = tail.position + 100000;
  answerTo('K', 0, std::string("\1\0", 2));
  answerTo('O', 0, on_);
  passFrames(kUntilMeasured);
  EXPECT_TRUE(tail.gain);
  EXPECT_EQ(tail.error_when_gain_went_on, 0);
}

// A limp joint is turned by hand.
TEST_F(BodyVersion2Test, MotorsSwitchedOffAndOnWhileGoingOnHoldThePresentPositions) {
  answerTo('O', 0, off_);
  passFrames(kUntilMeasured);
  answerTo('O', 0, on_);
  answerTo('O', 0, off_);
  FakeRobot::FakeJoint& tail = robot_.joint("tail_pan");
  tail.position += 100000;
  answerTo('O', 0, on_);
  passFrames(kUntilMeasured);
  EXPECT_TRUE(tail.gain);
  EXPECT_EQ(tail.error_when_gain_went_on, 0);
  answerTo('O', 0, off_);
  answerTo('O', 0, on_);
  answerTo('O', 0, off_);
  passFrames(kUntilMeasured);
  EXPECT_FALSE(tail.gain);
}

TEST_F(BodyVersion2Test, MotorsThatCannotBeSwitchedOnStayOffUntilTheyCan) {
  const struct {
    bool& fault;
    const char* words;
  } cases[] = {{robot_.refuses_power, "there is no power for the motors"},
               {robot_.joint("mouth").is_mute, "mouth does not report its position, so the motors stay off"}};
  for (const auto& [fault, words] : cases) {
    answerTo('O', 0, off_);
    fault = true;
    expectRefusal(answerTo('O', 0, on_), CODE_REFUSED, "cannot switch its motors on");
    expectRefusal(answerTo('E', POSTURE_STAND), CODE_REFUSED, "cannot switch its motors on");
    EXPECT_THAT(console_.str(), HasSubstr(words));
    passFrames(kUntilMeasured);
    EXPECT_EQ(textOf(answerTo('O', 0)), off_) << words;
    EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::gain, false))) << words;
    fault = false;
    EXPECT_EQ(textOf(answerTo('O', 0, on_)), on_) << words;
    passFrames(kUntilMeasured);
    EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::gain, true))) << words;
  }
}

TEST_F(BodyVersion2Test, MotorThatCannotBeSwitchedOffIsNamedAndTheOthersGoOff) {
  robot_.joints.front().keeps_gain = true;
  answerTo('O', 0, off_);
  EXPECT_THAT(console_.str(), HasSubstr(std::string(robot_.model.joints[0].name) + " still holds its position"));
  const std::vector<FakeRobot::FakeJoint> others(robot_.joints.begin() + 1, robot_.joints.end());
  EXPECT_THAT(others, Each(Field(&FakeRobot::FakeJoint::gain, false)));
}

TEST_F(BodyVersion2Test, EarsAreAnsweredByTheirState) {
  Frame answer = answerTo('K', 0, std::string("\1\0", 2));
  EXPECT_EQ(answer.header.kind, 'k');
  EXPECT_EQ(textOf(answer), std::string("\1\0", 2));
  passFrames(22);
  EXPECT_EQ(framesDrawn(kLeftEar), LightDriver::EAR_FRAMES);
  EXPECT_EQ(framesDrawn(kRightEar), 0);
  EXPECT_EQ(textOf(answerTo('K', 0, "\1\1")), std::string("\0\1", 2)) << "the left one rests";
  passFrames(22);
  EXPECT_EQ(framesDrawn(kLeftEar), LightDriver::EAR_FRAMES);
  EXPECT_EQ(framesDrawn(kRightEar), LightDriver::EAR_FRAMES);
}

TEST_F(BodyVersion2Test, PowerRequestThatIsNotAllowedNamesTheSetting) {
  expectRefusal(answerTo('Q', 0), CODE_REFUSED, "ALLOW_SHUT_DOWN=yes in RCSERVER.CFG");
  expectRefusal(answerTo('R', 0), CODE_REFUSED, "ALLOW_REBOOT=yes in RCSERVER.CFG");
  EXPECT_TRUE(machine_->isOn());
}

TEST_F(BodyVersion2Test, ShutDownIsTheLastRequestAnswered) {
  startWith("ALLOW_SHUT_DOWN=yes");
  reconnect();
  expectRefusal(answerTo('Q', 0, "x"), CODE_REFUSED, "bad request");
  client_->send(frame('Q', 0, 1) + frame('H', 0, 2));
  machine_->runUntil([&] { return !machine_->isOn(); });
  const std::optional<Frame> answer = client_->nextFrame();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->header.kind, 'q');
  EXPECT_TRUE(answer->payload.empty());
  EXPECT_FALSE(client_->nextFrame());
  EXPECT_TRUE(client_->ended());
  EXPECT_FALSE(robot_.powered);
}

TEST_F(BodyVersion2Test, CapabilitiesHaveRebootIfItIsAllowed) {
  startWith("ALLOW_REBOOT=yes");
  reconnect();
  EXPECT_THAT(textOf(answerTo('H', 0)), HasSubstr(" R guard\n"));
}

}  // namespace
