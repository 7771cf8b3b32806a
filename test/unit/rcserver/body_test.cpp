// Sensors, LEDs, ears and power, in both versions of the protocol.
#include "protocol/units.h"
#include "rcserver/body/LightDriver.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using robot_model::Sensor;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Field;

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

TEST_F(BodyTest, SensorsAndJointsAreReadInTheUnitsOfVersion1) {
  robot_.sensor("range_near") = 123456;
  robot_.sensor("acceleration_up_down") = -9806650;
  robot_.sensor("head_touch") = 17;
  robot_.sensor("paw_left_front") = 1;
  passFrames(kUntilMeasured);
  const std::pair<int, int> rows[] = {
      {kRangeNear, 12},
      {kAccelerationUpDown, -981},
      {kHeadTouch, 17},
      {kPawLeftFront, 1},
      {kBattery, 87},
      {kTemperature, 2505},
      {52, protocol::centidegreesFromMicroradians(FakeRobot::measured(robot_.joint("tail_tilt")))}};
  for (const auto& [id, value] : rows) {
    expectAnswer(request('S', id), 's', id, value);
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

TEST_F(SensorBlockTest, HoldsJointsAndSensorsByAscendingIdentifierUnlessTheyAreLeftOut) {
  for (size_t i = 0; i < robot_.sensor_values.size(); ++i) {
    robot_.sensor_values[i] = static_cast<int>(10000 * (i + 1));
  }
  passFrames(kUntilMeasured);
  expectAnswer(request('S', 2, 0), 's', 2, 0);
  expectAnswer(request('S', kBattery, 0), 's', kBattery, 0);
  EXPECT_EQ(readBlock(34), readOneByOne({2, kBattery}));
  expectAnswer(request('S', 2, 1), 's', 2, 1);
  expectAnswer(request('S', kBattery, 1), 's', kBattery, 1);
  EXPECT_EQ(readBlock(36), readOneByOne({}));
}

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
  EXPECT_THAT(robot_.leds, Each(Field(&FakeRobot::FakeLed::intensity, testing::AnyOf(1, 200))));
  EXPECT_EQ(robot_.led("face_14").intensity, 200);
  EXPECT_EQ(robot_.led("wireless").intensity, 1);
  expectAnswer(request('Y', 2, 100), 'y', 2, 100);
  passFrames(kUntilMeasured);
  EXPECT_THAT(robot_.leds, Each(Field(&FakeRobot::FakeLed::intensity, testing::AnyOf(1, 100))));
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

TEST_F(BodyTest, UploadOfAnObjectIsAlwaysRefused) {
  startWith("ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\nALLOW_SHUT_DOWN=yes\nALLOW_REBOOT=yes");
  expectError(request('C', 0) + std::string("RCSERVER.BIN\0\0\2\0", 16) + "WW");
  expectAnswer(request('S', kBattery), 's', kBattery, 87);
}

class BodyVersion2Test : public BodyTest {
 protected:
  void SetUp() override {
    BodyTest::SetUp();
    reconnect();
  }

  // The next telemetry: values of sensors by identifier.
  std::vector<TelemetryEntry> sensorTelemetry() {
    answerTo('T', 0, payloadOf(TelemetryPeriod{4}));
    passFrames(8);
    const auto telemetry = payloadIn<Telemetry>(*nextFrame());
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

TEST_F(BodyVersion2Test, TelemetryHasAllSensorsThatMeasureInMillionths) {
  robot_.missing_locator = "PRM:/p1-Sensor:p1";
  start();
  reconnect();
  robot_.sensor("range_near") = 123456;
  robot_.sensor("head_touch") = 17;
  robot_.sensor("paw_left_front") = 1;
  passFrames(kUntilMeasured);
  const std::vector<TelemetryEntry> sensors = sensorTelemetry();
  EXPECT_EQ(sensors.size(), 17U);
  EXPECT_THAT(sensors, testing::Not(Contains(Field(&TelemetryEntry::id, testing::Eq(55)))));
  EXPECT_THAT(sensors, Contains(IsSensor(kRangeNear, 123456)));
  EXPECT_THAT(sensors, Contains(IsSensor(kHeadTouch, 17000000)));
  EXPECT_THAT(sensors, Contains(IsSensor(kPawLeftFront, 1)));
  EXPECT_THAT(sensors, Contains(IsSensor(kBattery, 870000)));
  EXPECT_THAT(sensors, Contains(IsSensor(kTemperature, 25050000)));
}

TEST_F(BodyVersion2Test, LedsAreSetTogether) {
  answerTo('L', 0, payloadOf(LedValues{2, {{kHeadColor, 3, LED_MODE_B}, {kFace1, 77, LED_MODE_B}}}));
  passFrames(kUntilMeasured);
  EXPECT_EQ(robot_.led("head_color").intensity, 1);
  EXPECT_EQ(robot_.led("face_1").intensity, 77);
  EXPECT_EQ(robot_.led("face_1").mode, oled3_MODE_B);
}

TEST_F(BodyVersion2Test, MotorsThatCannotBeSwitchedOnStayOffUntilTheyCan) {
  const struct {
    bool& fault;
    const char* words;
  } cases[] = {{robot_.refuses_power, "there is no power for the motors"},
               {robot_.joint("mouth").is_mute, "mouth does not report its position, so the motors stay off"}};
  for (const auto& [fault, words] : cases) {
    answerTo('O', 0, order(off_));
    fault = true;
    expectRefusal(answerTo('O', 0, order(on_)), CODE_REFUSED, "cannot switch its motors on");
    expectRefusal(answerTo('E', POSTURE_STAND, order()), CODE_REFUSED, "cannot switch its motors on");
    EXPECT_THAT(console_.str(), testing::HasSubstr(words));
    passFrames(kUntilMeasured);
    EXPECT_EQ(textOf(answerTo('O', 0)), off_) << words;
    EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::gain, false))) << words;
    fault = false;
    EXPECT_EQ(textOf(answerTo('O', 0, order(on_))), on_) << words;
    passFrames(kUntilMeasured);
    EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::gain, true))) << words;
  }
}

TEST_F(BodyVersion2Test, ShutDownIsTheLastRequestAnswered) {
  startWith("ALLOW_SHUT_DOWN=yes");
  reconnect();
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

}  // namespace
