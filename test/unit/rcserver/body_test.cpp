// Sensors, LEDs, ears and power, in both versions of the protocol.
#include "protocol/units.h"
#include "rcserver/body/LightDriver.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::Each;
using ::testing::Field;

constexpr int kRangeNear = 53;
constexpr int kBattery = 66;
constexpr int kTemperature = 67;

constexpr int kHeadColor = 1;  // only on or off
constexpr int kFace1 = 7;      // intensity and mode
constexpr int kLeftEar = 1;
constexpr int kRightEar = 2;

class BodyTest : public Version1Fixture {
 protected:
  void SetUp() override {
    robot_.power_status.remainingCapacity = 87;
    robot_.power_status.temperature = 2982;  // 25.05 degrees Celsius
    start();
  }

  // The number of frames in which an ear was drawn.
  long framesDrawn(int ear) const {
    const std::vector<bool>& path = robot_.ears[static_cast<size_t>(ear - 1)].path;
    return std::count(path.begin(), path.end(), true);
  }
};

// SensorValues has the units of all kinds.
TEST_F(BodyTest, SensorsAndJointsAreReadInTheUnitsOfBothVersions) {
  robot_.sensor("range_near") = 123456;
  passFrames(kUntilMeasured);
  const int tail = FakeRobot::measured(robot_.joint("tail_tilt"));
  const std::tuple<int, int, int> rows[] = {{kRangeNear, 12, 123456},
                                            {kBattery, 87, 870000},
                                            {kTemperature, 2505, 25050000},
                                            {52, protocol::centidegreesFromMicroradians(tail), tail}};
  for (const auto& [id, version1, version2] : rows) {
    expectAnswer(request('S', id), 's', id, version1);
  }
  reconnect();
  answerTo('T', 0, payloadOf(TelemetryPeriod{4}));
  passFrames(8);
  const Frame pushed = nextPush(TELEMETRY_PUSH);
  std::map<int, int> values = valuesIn(pushed, GROUP_JOINT);
  values.merge(valuesIn(pushed, GROUP_SENSOR));
  EXPECT_EQ(values.size(), robot_.joints.size() + robot_.sensor_values.size());
  for (const auto& [id, version1, version2] : rows) {
    EXPECT_EQ(values[id], version2) << id;
  }
}

TEST_F(BodyTest, APartThatDoesNotOpenIsNamedAndTheOthersWork) {
  for (const char* const locator : {"PRM:/p1-Sensor:p1", "PRM:/r1/c1/c2/c3/l2-LED2:l2", "PRM:/r1/c1/c2/c3/e5-Joint4:15",
                                    "PRM:/r1/c1/c2/c3/c4-Joint2:14"}) {
    robot_.missing_locator = locator;
    start();
    EXPECT_THAT(console_.str(), testing::HasSubstr(locator));
    expectAnswer(request('S', 55), 's', 55, robot_.missing_locator == "PRM:/p1-Sensor:p1" ? 0 : 22);
    expectAnswer(request('L', 0, 200), 'l', 0, 200);
    expectAnswer(request('K', kRightEar, 1), 'k', kRightEar, 1);
    passFrames(kUntilMeasured);
    EXPECT_GT(robot_.leds.back().intensity, 0);
    EXPECT_GT(framesDrawn(kRightEar), 0);
  }
  robot_.missing_locator = "PRM:/p1-Sensor:p1";
  start();
  reconnect();
  answerTo('T', 0, payloadOf(TelemetryPeriod{4}));
  passFrames(8);
  const std::map<int, int> told = valuesIn(nextPush(TELEMETRY_PUSH), GROUP_SENSOR);
  EXPECT_EQ(told.count(55), 0U) << "it has not measured anything";
  EXPECT_EQ(told.count(kRangeNear), 1U);
}

TEST_F(BodyTest, TheBlockHoldsWhatIsIncludedByAscendingIdentifier) {
  for (size_t i = 0; i < robot_.sensor_values.size(); ++i) {
    robot_.sensor_values[i] = static_cast<int>(10000 * (i + 1));
  }
  passFrames(kUntilMeasured);
  std::map<int, int> all;  // by identifier
  for (int identifier = 1; identifier < 256; ++identifier) {
    const protocol::ValueReply reply = answerTo(request('S', identifier));
    if (reply.letter == 's') {
      all[identifier] = reply.value;
    }
  }
  EXPECT_EQ(all.size(), 36U);
  for (const int included : {0, 1}) {
    std::string expected;
    for (const auto& [identifier, value] : all) {
      if (identifier != 2 && identifier != kBattery) {
        expected += request('S', 0, value).substr(2);
      } else {
        expectAnswer(request('S', identifier, included), 's', identifier, included);
        expected += included == 1 ? request('S', 0, value).substr(2) : "";
      }
    }
    expected += std::string("s\0\0\0", 4);
    client_->send(request('S', 0));
    std::vector<uint8_t> block;
    EXPECT_TRUE(machine_->runUntil([&] { return (block = client_->take(expected.size())).size() == expected.size(); }));
    EXPECT_EQ(std::string(block.begin(), block.end()), expected);
  }
}

TEST_F(BodyTest, EveryLedIsSetByItsIdentifier) {
  for (size_t i = 0; i < robot_.leds.size(); ++i) {
    const robot_model::Led& led = robot_.model.leds[i];
    const bool is_switch = led.kind == robot_model::LED2;
    expectAnswer(request('L', led.identifier, 0x7f40), 'l', led.identifier, is_switch ? 255 : 0x40);
    passFrames(kUntilMeasured);
    EXPECT_EQ(robot_.leds[i].intensity, is_switch ? 1 : 0x40) << led.name;
    expectAnswer(request('L', led.identifier, 0x100), 'l', led.identifier, 0);
    passFrames(kUntilMeasured);
    EXPECT_EQ(robot_.leds[i].intensity, 0) << led.name;
  }
}

TEST_F(BodyTest, AllLedsAndTheFaceWithAMode) {
  const struct {
    std::string bytes;
    int face;  // its intensity
    int mode;
    bool is_for_all;
  } rows[] = {
      {request('L', 0, 200), 200, oled3_MODE_A, true},     {request('Y', 2, 100), 100, oled3_MODE_B, true},
      {request('L', kFace1, 50), 50, oled3_MODE_B, false}, {request('L', 0, 60), 60, oled3_MODE_B, true},
      {request('Y', 1, 60), 60, oled3_MODE_A, true},       {request('Y', 1, 0), 0, oled3_MODE_A, true},
  };
  for (const auto& row : rows) {
    expectAnswer(row.bytes, static_cast<char>(std::tolower(row.bytes[0])), row.bytes[1], row.face);
    passFrames(kUntilMeasured);
    EXPECT_EQ(robot_.led("face_1").intensity, row.face);
    EXPECT_EQ(robot_.led("face_1").mode, row.mode);
    EXPECT_EQ(robot_.led("face_14").intensity == row.face, row.is_for_all);
    EXPECT_EQ(robot_.led("wireless").intensity, row.face == 0 ? 0 : 1);
  }
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

TEST_F(BodyTest, EarIsDrawnForItsTimeAndLetGo) {
  expectAnswer(request('K', kRightEar, 1), 'k', kRightEar, 1);
  passFrames(20);
  expectAnswer(request('K', kRightEar, 1), 'k', kRightEar, 0);  // it rests
  passFrames(16);
  EXPECT_EQ(framesDrawn(kRightEar), 16) << "128 ms";
  expectAnswer(request('K', kRightEar, 1), 'k', kRightEar, 1);
  passFrames(100);
  EXPECT_EQ(framesDrawn(kRightEar), 2 * 16);
  EXPECT_EQ(framesDrawn(kLeftEar), 0);
  EXPECT_FALSE(robot_.ears[1].drawn);
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

TEST_F(BodyTest, ShuttingDownAndRebootingNeedTheSettings) {
  startWith("ALLOW_REBOOT=yes");
  expectError(request('Q', 0, 0));
  startWith("ALLOW_SHUT_DOWN=yes");
  expectError(request('R', 0, 0));
  passFrames(10);
  EXPECT_TRUE(robot_.powered);
  EXPECT_TRUE(machine_->isOn());
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
  EXPECT_EQ(robot_.times_switched_off, times + 1);
}

TEST_F(BodyTest, RebootAnswersAndServesTheNextClient) {
  startWith("ALLOW_REBOOT=yes");
  const int times = robot_.times_switched_off;
  const int port = machine_->hostPort(protocol::RCSERVER_PORT);
  client_->send(request('R', 0, 0));
  machine_->runUntil([&] { return robot_.times_switched_off > times; });
  EXPECT_TRUE(machine_->isOn());
  const std::optional<Reply> reply = client_->next();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->letter, 'r');
  EXPECT_TRUE(client_->ended());
  EXPECT_THAT(console_.str(), testing::HasSubstr("The robot boots again\n"));
  EXPECT_EQ(machine_->hostPort(protocol::RCSERVER_PORT), port);
  passFrames(kUntilMeasured);
  client_ = connectServed();
  expectAnswer(request('S', kBattery), 's', kBattery, 87);
}

TEST_F(BodyTest, UploadOfAnObjectIsAlwaysRefused) {
  startWith("ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\nALLOW_SHUT_DOWN=yes\nALLOW_REBOOT=yes");
  expectError(request('C', 0) + std::string("RCSERVER.BIN\0\0\2\0", 16) + "WW");
  expectAnswer(request('S', kBattery), 's', kBattery, 87);
}

TEST_F(BodyTest, LedsAreSetTogether) {
  reconnect();
  answerTo('L', 0, payloadOf(LedValues{2, {{kHeadColor, 3, LED_MODE_B}, {kFace1, 77, LED_MODE_B}}}));
  passFrames(kUntilMeasured);
  EXPECT_EQ(robot_.led("head_color").intensity, 1);
  EXPECT_EQ(robot_.led("face_1").intensity, 77);
  EXPECT_EQ(robot_.led("face_1").mode, oled3_MODE_B);
}

TEST_F(BodyTest, MotorsThatCannotBeSwitchedOnStayOffUntilTheyCan) {
  const std::string on(1, '\1');
  const std::string off(1, '\0');
  reconnect();
  const struct {
    bool& fault;
    const char* words;
  } cases[] = {{robot_.refuses_power, "there is no power for the motors"},
               {robot_.joint("mouth").is_mute, "mouth does not report its position, so the motors stay off"}};
  for (const auto& [fault, words] : cases) {
    answerTo('O', 0, order(off));
    fault = true;
    expectRefusal(answerTo('O', 0, order(on)), CODE_REFUSED, "cannot switch its motors on");
    expectRefusal(answerTo('E', POSTURE_STAND, order()), CODE_REFUSED, "cannot switch its motors on");
    EXPECT_THAT(console_.str(), testing::HasSubstr(words));
    passFrames(kUntilMeasured);
    EXPECT_EQ(textOf(answerTo('O', 0)), off) << words;
    EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::gain, false))) << words;
    fault = false;
    EXPECT_EQ(textOf(answerTo('O', 0, order(on))), on) << words;
    passFrames(kUntilMeasured);
    EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::gain, true))) << words;
  }
}

}  // namespace
