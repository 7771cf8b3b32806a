#include "protocol/camera_settings.h"

#include <gmock/gmock.h>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;

const char* decodeValue(int id, const Bytes& bytes) {
  CameraValue value{static_cast<unsigned char>(id), 0};
  return decode(bytes.data(), bytes.size(), &value);
}

TEST(CameraValue, IsOneByteOfTheValuesThatSonyGives) {
  EXPECT_EQ(encoded(CameraValue{SETTING_GAIN, 2}), hex("02"));
  for (const int id : {SETTING_WHITE_BALANCE, SETTING_GAIN, SETTING_SHUTTER_SPEED}) {
    EXPECT_THAT(decodeValue(id, hex("00")), HasSubstr("1, 2 or 3"));
    EXPECT_THAT(decodeValue(id, hex("01")), IsNull());
    EXPECT_THAT(decodeValue(id, hex("03")), IsNull());
    EXPECT_THAT(decodeValue(id, hex("04")), HasSubstr("1, 2 or 3"));
  }
  for (const int id : {SETTING_AUTO_EXPOSURE, SETTING_AUTO_WHITE_BALANCE}) {
    EXPECT_THAT(decodeValue(id, hex("00")), IsNull());
    EXPECT_THAT(decodeValue(id, hex("01")), IsNull());
    EXPECT_THAT(decodeValue(id, hex("02")), HasSubstr("neither off (0) nor on (1)"));
  }
}

TEST(CameraSettings, FitIntoSixteenBits) {
  EXPECT_EQ(packCameraSettings(CameraSettings()), 0);
  EXPECT_EQ(packCameraSettings(CameraSettings{{1, 0, 0, 0, 0}}), 0x01);
  EXPECT_EQ(packCameraSettings(CameraSettings{{3, 2, 1, 0, 1}}), 0x9b);
  for (unsigned packed = 0; packed <= 0xffff; ++packed) {
    CameraSettings settings{};
    if (unpackCameraSettings(static_cast<unsigned short>(packed), &settings) == nullptr) {
      EXPECT_EQ(packCameraSettings(settings), packed);
      EXPECT_EQ(settings.areKnown(), packed != 0);
      for (int id = 1; packed != 0 && id <= NUMBER_OF_CAMERA_SETTINGS; ++id) {
        EXPECT_THAT(problemOfCameraValue(id, settings.values[id - 1]), IsNull());
      }
    }
  }
}

}  // namespace
}  // namespace version2
}  // namespace protocol
