// The letters and numbers of docs/protocol.md. Client and server share their names, so with a wrong value they would
// still understand each other, but no client or robot from before.
#include <gmock/gmock.h>

#include <climits>
#include <string>
#include <utility>
#include <vector>

#include "protocol/camera_settings.h"
#include "protocol/color_requests.h"
#include "protocol/file_list.h"
#include "protocol/motion_requests.h"
#include "protocol/picture_datagram.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/units.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "protocol/walk_requests.h"

namespace protocol {
namespace {

using ::testing::ElementsAre;

template <typename... Values>
std::vector<unsigned long> numbers(Values... values) {
  return {static_cast<unsigned long>(values)...};
}

TEST(WireNumbers, LettersOfVersion1) {
  EXPECT_EQ((std::string{REQUEST_PICTURE, REQUEST_STREAM_TOGGLE, REQUEST_NEWER_VERSION, REQUEST_JOINT, REQUEST_SENSOR,
                         REQUEST_MAX_VELOCITY, REQUEST_MAX_ACCELERATION, REQUEST_LED, REQUEST_FACE_LEDS, REQUEST_EARS,
                         REQUEST_SHUT_DOWN, REQUEST_REBOOT, REQUEST_UPLOAD_MOTION, REQUEST_DELETE_MOTION,
                         REQUEST_PLAY_MOTION, REQUEST_UPLOAD_OBJECT, REPLY_PICTURE, REPLY_ERROR}),
            "FWXJSVALYKQRUDPCfe");
}

TEST(WireNumbers, LettersOfVersion2) {
  using namespace version2;
  EXPECT_EQ((std::string{REQUEST_HELLO, version2::REQUEST_PICTURE, REQUEST_STREAM, REQUEST_JOINTS, REQUEST_SPEED_LIMITS,
                         REQUEST_TELEMETRY, REQUEST_MOTORS, REQUEST_HOLD, REQUEST_LEDS, version2::REQUEST_EARS,
                         REQUEST_DATAGRAMS, REQUEST_UPLOAD}),
            "HFWJVTOILKBU");
  EXPECT_EQ((std::string{REQUEST_DELETE, REQUEST_PLAY, REQUEST_LIST, REQUEST_SAVE_PICTURE, REQUEST_PICTURES,
                         REQUEST_STEER, REQUEST_POSTURE, version2::REQUEST_SHUT_DOWN, version2::REQUEST_REBOOT,
                         REQUEST_CAMERA, REQUEST_COLORS, REQUEST_SOUND}),
            "DPNMYSEQRGZA");
  EXPECT_EQ((std::string{PICTURE, TELEMETRY_PUSH, END_PUSH, MOTORS_AND_POSTURE_PUSH, ERROR_MESSAGE, COLORS_PUSH,
                         SOUND_PUSH, GROUP_JOINT, GROUP_SENSOR, GROUP_DUTY, GROUP_WALK, DATAGRAM_MARK}),
            "ftioezaJSDWb");
}

TEST(WireNumbers, Identifiers) {
  using namespace version2;
  EXPECT_THAT(numbers(ERROR_REFUSED, ERROR_FILE_MISSING, ERROR_NOT_A_MOTION), ElementsAre(0, 1, 2));
  EXPECT_THAT(numbers(CODE_REFUSED, CODE_FILE_MISSING, CODE_NOT_SUPPORTED, CODE_JOINT_FAULT, CODE_POWER, CODE_TOO_OLD),
              ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(numbers(ENDED_MOTION, ENDED_WALK, ENDED_POSTURE, ENDED_JAM, ENDED_JOINTS), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(numbers(END_DONE, END_REPLACED, END_STOPPED, END_REFUSED, END_FELL), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(
      numbers(POSTURE_UNKNOWN, POSTURE_STAND, POSTURE_SIT, POSTURE_REST, POSTURE_WALK, POSTURE_FALLEN, POSTURE_CARRIED),
      ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_THAT(numbers(LAYER_HIGH, LAYER_MIDDLE, LAYER_LOW, LAYER_DOUBLE), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(numbers(TELEMETRY_PLAIN, TELEMETRY_WITH_DUTY), ElementsAre(0, 1));
  EXPECT_THAT(numbers(HOLD_EVERYTHING, HOLD_JOINTS, LED_MODE_A, LED_MODE_B), ElementsAre(0, 1, 0, 1));
  EXPECT_THAT(numbers(WALK_FORWARD, WALK_LEFT, WALK_TURN, WALK_PHASE, WALK_STATE), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(numbers(WALK_STATE_NONE, WALK_STATE_GETS_READY, WALK_STATE_WALKS), ElementsAre(0, 1, 2));
  EXPECT_THAT(numbers(STEER_GUARDED, LEAVE_OUT_MISSING_JOINTS), ElementsAre(1, 1));
  EXPECT_THAT(numbers(COLORS_OFF, COLORS_ON, COLORS_TABLE), ElementsAre(0, 1, 2));
  EXPECT_THAT(numbers(SOUND_MICROPHONE, SOUND_SPEAKER, SOUND_VOLUME, MICROPHONE_ON, SOUND_FIRST),
              ElementsAre(1, 2, 3, 1, 2));
  EXPECT_THAT(numbers(LIST_PICTURES, FETCH_PICTURE, DELETE_PICTURE), ElementsAre(1, 2, 3));
  EXPECT_THAT(numbers(SETTING_WHITE_BALANCE, SETTING_GAIN, SETTING_SHUTTER_SPEED, SETTING_AUTO_EXPOSURE,
                      SETTING_AUTO_WHITE_BALANCE),
              ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(numbers(ALL_IDENTIFIERS, FACE_MODE_A, SERVER_DEFAULT_QUALITY, VOLUME_OF_ROBOT, MAX_VOLUME),
              ElementsAre(0, 1, 255, 255, 3));
}

TEST(WireNumbers, SizesAndTimes) {
  using namespace version2;
  EXPECT_THAT(numbers(RCSERVER_PORT, DEFAULT_JPEG_QUALITY, MAX_JPEG_QUALITY, VERSION), ElementsAre(54321, 85, 100, 2));
  EXPECT_THAT(numbers(MAX_PAYLOAD_TOWARDS_CLIENT, MAX_PAYLOAD_TOWARDS_ROBOT, MAX_STICK_PICTURE_SIZE),
              ElementsAre(262144, 65536, 131072));
  EXPECT_THAT(numbers(MAX_LISTED_FILES, MAX_JOINTS, MAX_LEDS, MAX_TELEMETRY_ENTRIES, MAX_COLOR_CHANNELS),
              ElementsAre(256, 32, 32, 128, 8));
  EXPECT_THAT(numbers(MAX_DATAGRAM_SIZE, KEPT_PICTURES), ElementsAre(1372, 3));
  EXPECT_THAT(numbers(SPEAKER_CAPACITY, SPEAKER_TIMEOUT_MS, STEERING_TIMEOUT_MS), ElementsAre(16384, 2000, 500));
  EXPECT_THAT(numbers(FILE_READING_FRAMES, ARRIVED, ARRIVAL_FRAMES), ElementsAre(625, 50000, 250));
  EXPECT_THAT(numbers(COLOR_SEGMENTS, COLOR_CENTROID_SCALE, MAX_COLOR_PLANE_WIDTH, MAX_COLOR_PLANE_HEIGHT),
              ElementsAre(32, 64, 104, 80));
}

// Units on the wire: docs/protocol.md, "Sensors" and "Requests of version 1".
using namespace robot_model;

TEST(Angles, OfVersion1AreHundredthsOfADegree) {
  const struct {
    int centidegrees;
    int microradians;
  } rows[] = {{0, 0},          {1, 175},         {-1, -175},         {-7500, -1308997},
              {8800, 1535890}, {13000, 2268928}, {-11500, -2007129}, {-300, -52360}};
  for (const auto& row : rows) {
    EXPECT_EQ(microradiansFromCentidegrees(static_cast<short>(row.centidegrees)), row.microradians);
    EXPECT_EQ(centidegreesFromMicroradians(row.microradians), row.centidegrees);
  }
  for (int centidegrees = SHRT_MIN; centidegrees <= SHRT_MAX; ++centidegrees) {
    const short value = static_cast<short>(centidegrees);
    ASSERT_EQ(centidegreesFromMicroradians(microradiansFromCentidegrees(value)), value);
  }
}

TEST(Angles, AreRoundedToTheNearestAndLimited) {
  const std::pair<int, int> rows[] = {{87, 0},          {88, 1},           {-87, 0},         {-88, -1},
                                      {5719095, 32767}, {10057460, 32767}, {INT_MAX, 32767}, {-5719270, -32768},
                                      {INT_MIN, -32768}};
  for (const auto& [microradians, centidegrees] : rows) {
    EXPECT_EQ(centidegreesFromMicroradians(microradians), centidegrees) << microradians;
  }
}

TEST(SensorValues, HaveTheUnitsOfTheDocument) {
  const struct {
    SensorKind kind;
    int measured;
    int version1;
    int version2;
    double si;
  } rows[] = {
      {SENSOR_DISTANCE, 230000, 23, 230000, 0.23},
      {SENSOR_ACCELERATION, -9810000, -981, -9810000, -9.81},
      {SENSOR_ACCELERATION, 19610000, 1961, 19610000, 19.61},
      {SENSOR_FORCE, 980000, 98, 980000, 0.98},
      {SENSOR_TEMPERATURE, 38250000, 3825, 38250000, 38.25},
      {SENSOR_CHARGE, 870000, 87, 870000, 0.87},
      {SENSOR_TOUCH, 14, 14, 14000000, 14},
      {SENSOR_SWITCH, 0, 0, 0, 0},
      {SENSOR_SWITCH, 1, 1, 1, 1},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(version1SensorValue(row.kind, row.measured), row.version1) << row.kind;
    EXPECT_EQ(version2SensorValue(row.kind, row.measured), row.version2) << row.kind;
    EXPECT_DOUBLE_EQ(sensorValueFromVersion1(row.kind, static_cast<short>(row.version1)), row.si) << row.kind;
    EXPECT_DOUBLE_EQ(sensorValueFromVersion2(row.kind, row.version2), row.si) << row.kind;
  }
}

TEST(SensorValues, AreRoundedToTheNearestAndLimited) {
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, 234999), 23);
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, 235000), 24);
  EXPECT_EQ(version1SensorValue(SENSOR_ACCELERATION, -5000), -1);
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, INT_MAX), 32767);
  EXPECT_EQ(version1SensorValue(SENSOR_ACCELERATION, INT_MIN), -32768);
  EXPECT_EQ(version1SensorValue(SENSOR_TOUCH, 100000), 32767);
  EXPECT_EQ(version2SensorValue(SENSOR_TOUCH, 2148), INT_MAX);
  EXPECT_EQ(version2SensorValue(SENSOR_TOUCH, INT_MIN), INT_MIN);
}

}  // namespace
}  // namespace protocol
