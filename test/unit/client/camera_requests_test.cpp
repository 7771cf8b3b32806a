// Resolution and rate of the stream, and the camera's settings.
#include "version2_fixture.h"

using namespace aibo_client;
using namespace test_support;
using std::chrono::milliseconds;

namespace {

using CameraRequestsTest = Version2SessionFixture;

TEST_F(CameraRequestsTest, TheStreamIsRequestedAgainWheneverItShouldDiffer) {
  begin();
  wanted_.streaming = true;
  const struct {
    int quality;
    StreamFormat format;
    const char* sent;
  } rows[] = {
      {73, {Resolution::kHigh, 1}, "W 73 1 0 0 1"},      {40, {Resolution::kHigh, 1}, "W 40 1 0 0 1"},
      {40, {Resolution::kDouble, 3}, "W 40 1 3 0 3"},    {40, {Resolution::kDouble, 300}, "W 40 1 3 1 44"},
      {40, {Resolution::kMiddle, 300}, "W 40 1 1 1 44"}, {40, {Resolution::kLow, 1}, "W 40 1 2 0 1"},
  };
  for (const auto& row : rows) {
    wanted_.jpeg_quality = row.quality;
    wanted_.format = row.format;
    EXPECT_EQ(row.sent, request());
    EXPECT_EQ("", request());
  }
  wanted_.streaming = false;
  EXPECT_EQ("W 40 0 2 0 1", request());
  wanted_.jpeg_quality = 50;
  EXPECT_EQ("", request()) << "the stream is off";
}

TEST_F(CameraRequestsTest, ARobotWithoutDoubleResolutionStreamsHighOneAndTheLogSaysSo) {
  begin();
  wanted_.streaming = true;
  wanted_.format = {Resolution::kDouble, 2};
  EXPECT_EQ("W 73 1 3 0 2", request());
  const Frame first = frame_;
  wanted_.jpeg_quality = 50;
  EXPECT_EQ("W 50 1 3 0 2", request());
  refuse(first, "not supported", 2);
  refuse("not supported", 2);
  EXPECT_EQ("W 50 1 0 0 2", request());
  EXPECT_EQ("", request());
  EXPECT_EQ(1, logged("double resolution; they have 208x160 pixels"));
  takePicture(0);
  EXPECT_EQ("F 50 0", request()) << "like the stream's";
}

TEST_F(CameraRequestsTest, AStreamOfFewImagesIsNotTakenForASilentOne) {
  begin();
  wanted_.format.every_nth_image = 15;
  stream();
  live(milliseconds(500 + 14 * 48 - 1));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(2)); }));
}

TEST_F(CameraRequestsTest, APictureHasTheStreamsResolutionUnlessAnotherIsAskedFor) {
  begin();
  wanted_.streaming = true;
  wanted_.format.resolution = Resolution::kLow;
  EXPECT_EQ("W 73 1 2 0 1", request());
  takePicture(0);
  EXPECT_EQ("F 73 2", request());
  takePicture(0, milliseconds(2000), Resolution::kMiddle);
  EXPECT_EQ("F 73 1", request());
}

TEST_F(CameraRequestsTest, APictureOfAnotherResolutionIsForItsCallerAlone) {
  begin();
  stream();
  const auto delivered_for = [this](Resolution resolution) {
    const std::size_t before = pictures_.size();
    auto taken = takePicture(0, milliseconds(2000), resolution);
    request();
    answer(version2_frames::makePicture(test_pictures::makeNumbered(1), 1));
    EXPECT_TRUE(taken.get().picture);
    return pictures_.size() - before;
  };
  EXPECT_EQ(1u, delivered_for(Resolution::kHigh));
  EXPECT_EQ(0u, delivered_for(Resolution::kMiddle));
  EXPECT_EQ(2u, counters_.pictures);
  wanted_.streaming = false;
  request();
  EXPECT_EQ(1u, delivered_for(Resolution::kMiddle)) << "the stream is off";
}

TEST_F(CameraRequestsTest, SettingsAreSentAtTheBeginningAndWhenTheyChange) {
  sayHello();
  wanted_.streaming = true;
  wanted_.camera.gain = 3;
  for (const char* each : {"G 1 3", "G 2 3", "G 3 2", "G 4 0", "G 5 0", "W 73 1 0 0 1", ""}) {
    EXPECT_EQ(each, request());
  }
  wanted_.camera.shutter_speed = 1;
  wanted_.camera.auto_white_balance = true;
  for (const char* each : {"G 3 1", "G 5 1", ""}) {
    EXPECT_EQ(each, request());
  }
}

TEST_F(CameraRequestsTest, ASettingThatTheRobotRefusesIsLoggedAndTheRestGoesOn) {
  sayHello();
  EXPECT_EQ("G 1 3", request());
  refuse("it does not");
  EXPECT_EQ(1, logged("refused to set its camera"));
  EXPECT_EQ("GGGG", requests());
  wanted_.colors.on = true;
  EXPECT_EQ("Z", requests());
  refuse("it does not");
  EXPECT_EQ(1, logged("to detect colours: it does not"));
}

TEST_F(CameraRequestsTest, APictureHasTheSettingsThatTheRobotTells) {
  begin();
  stream();
  test_pictures::Bytes payload = version2_frames::makePicture(test_pictures::makeNumbered(1), 1);
  for (const std::uint8_t settings : test_pictures::Bytes{0, 0x9b, 0x7d}) {  // docs/protocol.md
    payload[15] = settings;
    push('f', payload);
  }
  ASSERT_EQ(3u, pictures_.size());
  EXPECT_FALSE(pictures_[0]->settings);
  CameraSettings expected;
  expected.shutter_speed = 1;
  expected.auto_white_balance = true;
  EXPECT_TRUE(pictures_[1]->settings == expected);
  expected.white_balance = 1;
  expected.gain = expected.shutter_speed = 3;
  expected.auto_exposure = true;
  expected.auto_white_balance = false;
  EXPECT_TRUE(pictures_[2]->settings == expected);
}

}  // namespace
