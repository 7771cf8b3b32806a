// Resolution and rate of the stream, and the camera's settings.
#include <gmock/gmock.h>

#include <string>

#include "client/fault.h"
#include "client/version1_session.h"
#include "client/version2_session.h"
#include "session_fixture.h"
#include "support/version2_frames.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using testing::HasSubstr;
using version2_frames::makeFrame;

namespace {

class CameraRequestsTest : public SessionFixture {
 protected:
  Session& session() override { return session_; }

  void begin(const std::string& capabilities) {
    EXPECT_EQ("H 0 -", request());
    receive(makeFrame('h', number_, version2_frames::makeHello(capabilities)));
  }

  /// What the session sends now: kind, id and payload, as in "W 73 1 0 0 1"; "" if nothing.
  std::string request() {
    const Bytes bytes = session_.nextRequest(wish_, now_);
    if (bytes.empty()) {
      return "";
    }
    const version2_frames::Frame frame = version2_frames::split(bytes);
    number_ = frame.header.request_number;
    return version2_frames::textOf(frame) + (frame.payload.empty() ? " -" : "");
  }

  /// The robot sets its camera as it is asked to at the beginning of a connection.
  void answerSettings() {
    for (const int id : {1, 2, 3, 4, 5}) {
      const std::string sent = request();
      Bytes reply = makeFrame('g', number_, {static_cast<std::uint8_t>(sent.back() - '0')});
      reply[1] = static_cast<std::uint8_t>(id);
      receive(reply);
    }
  }

  void refuse(int code) { receive(makeFrame('e', number_, version2_frames::makeError(code, "not supported: it"))); }

  void live(milliseconds time) {
    const TimePoint end = now_ + time;
    while (now_ < end) {
      pass(std::min(end, session_.nextDeadline()) - now_);
      if (request() == "H 0 -") {
        receive(makeFrame('h', number_, version2_frames::makeHello("H F W G")));
      }
    }
  }

  std::future<Answer> takePictureOf(std::optional<Resolution> resolution) {
    return add(callForPicture(0, resolution), milliseconds(2000));
  }

  int number_ = 0;  // of the request that was sent last
  Version2Session session_{connection_, now_};
};

TEST_F(CameraRequestsTest, TheStreamIsRequestedAgainWhenItsFormatChanges) {
  begin("H F W");
  wish_.streaming = true;
  wish_.format = {Resolution::kDouble, 3};
  EXPECT_EQ("W 73 1 3 0 3", request());
  EXPECT_EQ("", request());
  wish_.format.every_nth_image = 300;
  EXPECT_EQ("W 73 1 3 1 44", request());
  wish_.format = StreamFormat();
  EXPECT_EQ("W 73 1 0 0 1", request());
  EXPECT_EQ("", request());
}

TEST_F(CameraRequestsTest, RobotWithoutDoubleResolutionStreamsFullOneAndTheLogSaysSo) {
  begin("H F W");
  wish_.streaming = true;
  wish_.format = {Resolution::kDouble, 2};
  EXPECT_EQ("W 73 1 3 0 2", request());
  refuse(2);
  EXPECT_EQ("W 73 1 0 0 2", request());
  EXPECT_EQ("", request());
  EXPECT_EQ(1, logged("double resolution; they have 208x160 pixels"));
  takePictureOf(std::nullopt);
  EXPECT_EQ("F 73 0", request()) << "like the stream's";
  wish_.format.resolution = Resolution::kLow;
  EXPECT_EQ("W 73 1 2 0 2", request());
  wish_.format.resolution = Resolution::kDouble;
  EXPECT_EQ("W 73 1 0 0 2", request());
  EXPECT_THROW(refuse(2), ProtocolException) << "it was not the resolution";
}

TEST_F(CameraRequestsTest, ARefusalOfDoubleResolutionMayComeAfterTheNextRequests) {
  begin("H F W");
  wish_.streaming = true;
  wish_.format = {Resolution::kDouble, 1};
  EXPECT_EQ("W 73 1 3 0 1", request());
  const int first = number_;
  wish_.jpeg_quality = 50;
  EXPECT_EQ("W 50 1 3 0 1", request());
  const int second = number_;
  wish_.format.resolution = Resolution::kLow;
  EXPECT_EQ("W 50 1 2 0 1", request());
  for (const int number : {first, second}) {
    receive(makeFrame('e', number, version2_frames::makeError(2, "no")));
  }
  EXPECT_EQ("", request());
  EXPECT_EQ(1, logged("double resolution; they have 208x160 pixels"));
}

TEST_F(CameraRequestsTest, AStreamOfFewImagesIsNotTakenForASilentOne) {
  begin("H F W");
  wish_.streaming = true;
  wish_.format.every_nth_image = 15;
  EXPECT_EQ("W 73 1 0 0 15", request());
  receive(makeFrame('w', number_, {1, 0, 0, 15}));
  live(milliseconds(500 + 14 * 48 - 1));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(2)); }));
}

TEST_F(CameraRequestsTest, AStreamOfMoreImagesThanBeforeHasTimeForItsFirst) {
  begin("H F W G");
  answerSettings();
  wish_.streaming = true;
  wish_.format.every_nth_image = 100;
  request();
  receive(makeFrame('w', number_, {1, 0, 0, 100}));
  live(milliseconds(3000));
  wish_.format.every_nth_image = 1;
  EXPECT_EQ("W 73 1 0 0 1", request());
  receive(makeFrame('w', number_, {1, 0, 0, 1}));
  live(milliseconds(499));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(1)); }));
}

TEST_F(CameraRequestsTest, APictureHasTheStreamsResolutionOrItsOwn) {
  begin("H F W");
  wish_.format.resolution = Resolution::kLow;
  takePictureOf(std::nullopt);
  EXPECT_EQ("F 73 2", request());
  takePictureOf(Resolution::kDouble);
  EXPECT_EQ("F 73 3", request());
}

TEST_F(CameraRequestsTest, APictureOfAnotherResolutionThanTheStreamsIsForItsCallerAlone) {
  begin("H F W");
  wish_.streaming = true;
  EXPECT_EQ("W 73 1 0 0 1", request());
  receive(makeFrame('w', number_, {1, 0, 0, 1}));
  for (const bool other : {false, true}) {
    auto answer = takePictureOf(other ? Resolution::kMiddle : Resolution::kHigh);
    request();
    receive(makeFrame('f', number_, version2_frames::makePicture(test_pictures::makeNumbered(1), 1)));
    ASSERT_TRUE(done(answer));
    EXPECT_TRUE(answer.get().picture);
    EXPECT_EQ(1u, pictures_.size()) << "the first one only";
  }
  EXPECT_EQ(2u, counters_.pictures);
  wish_.streaming = false;
  request();
  takePictureOf(Resolution::kMiddle);
  request();
  receive(makeFrame('f', number_, version2_frames::makePicture(test_pictures::makeNumbered(2), 2)));
  EXPECT_EQ(2u, pictures_.size()) << "the stream is off";
}

TEST_F(CameraRequestsTest, SettingsAreSentAtTheBeginningAndWhenTheyChange) {
  begin("H F W G");
  wish_.streaming = true;
  wish_.camera.gain = 3;
  for (const char* each : {"G 1 3", "G 2 3", "G 3 2", "G 4 0", "G 5 0", "W 73 1 0 0 1", ""}) {
    EXPECT_EQ(each, request());
  }
  wish_.camera.shutter_speed = 1;
  wish_.camera.auto_white_balance = true;
  for (const char* each : {"G 3 1", "G 5 1", ""}) {
    EXPECT_EQ(each, request());
  }
}

TEST_F(CameraRequestsTest, ASettingThatTheRobotRefusesIsLoggedAndTheRestGoesOn) {
  begin("H F W G");
  EXPECT_EQ("G 1 3", request());
  refuse(0);
  EXPECT_EQ(1, logged("refused to set its camera"));
  EXPECT_EQ("G 2 2", request());
}

TEST_F(CameraRequestsTest, TheValueInForceIsReadBack) {
  begin("H F W G");
  answerSettings();
  EXPECT_TRUE(log_.empty());
  wish_.camera.gain = 3;
  EXPECT_EQ("G 2 3", request());
  Bytes other = makeFrame('g', number_, {1});
  other[1] = 2;
  receive(other);
  EXPECT_EQ(1, logged("has set camera setting 2 to 1 instead of 3"));
  wish_.camera.gain = 2;
  request();
  Bytes bad = makeFrame('g', number_, {7});
  bad[1] = 2;
  EXPECT_THROW(receive(bad), ProtocolException);
}

TEST_F(CameraRequestsTest, TheAnswerToAnOlderRequestIsNoOtherValueThanTheOneAskedFor) {
  begin("H F W G");
  answerSettings();
  std::vector<Bytes> replies;
  for (const int gain : {3, 1}) {
    wish_.camera.gain = gain;
    EXPECT_EQ("G 2 " + std::to_string(gain), request());
    replies.push_back(makeFrame('g', number_, {static_cast<std::uint8_t>(gain)}));
    replies.back()[1] = 2;
  }
  receive(replies[0]);
  receive(replies[1]);
  EXPECT_TRUE(log_.empty());
}

TEST_F(CameraRequestsTest, AServerWithoutCameraSettingsIsNotSentAnyAndTheLogSaysSoOnce) {
  begin("H F W");
  EXPECT_EQ("", request());
  EXPECT_EQ(0, logged("to set the camera"));
  wish_.camera.gain = 1;
  EXPECT_EQ("", request());
  EXPECT_EQ("", request());
  EXPECT_EQ(1, logged("to set the camera"));
}

TEST_F(CameraRequestsTest, APictureHasTheSettingsThatTheRobotTells) {
  begin("H F W");
  wish_.streaming = true;
  request();
  Bytes payload = version2_frames::makePicture(test_pictures::makeNumbered(1), 1);
  receive(makeFrame('f', 0, payload));
  payload[15] = 0x9b;  // docs/protocol.md
  receive(makeFrame('f', 0, payload));
  payload[15] = 0x7d;
  receive(makeFrame('f', 0, payload));
  ASSERT_EQ(3u, pictures_.size());
  EXPECT_FALSE(pictures_[0]->settings);
  ASSERT_TRUE(pictures_[1]->settings);
  CameraSettings expected;
  expected.shutter_speed = 1;
  expected.auto_white_balance = true;
  EXPECT_TRUE(*pictures_[1]->settings == expected);
  expected.white_balance = 1;
  expected.gain = expected.shutter_speed = 3;
  expected.auto_exposure = true;
  expected.auto_white_balance = false;
  EXPECT_TRUE(pictures_[2]->settings == expected);
}

class CameraRequestsVersion1Test : public SessionFixture {
 protected:
  Session& session() override { return session_; }

  ServerHabits habits_;
  Version1Session session_{connection_, habits_, Version1Session::VersionAnswer::kRefused, now_};
};

TEST_F(CameraRequestsVersion1Test, ASettingChangesNoByteAndTheLogSaysThatItHasNoEffect) {
  wish_.streaming = true;
  const Bytes toggle = session_.nextRequest(wish_, now_);
  EXPECT_EQ(Bytes({'W', 73}), toggle);
  EXPECT_TRUE(log_.empty());
  wish_.format = {Resolution::kDouble, 4};
  wish_.camera.gain = 3;
  wish_.colors.on = true;
  wish_.microphone.on = true;
  EXPECT_TRUE(session_.nextRequest(wish_, now_).empty());
  EXPECT_TRUE(session_.nextRequest(wish_, now_).empty());
  for (const char* each :
       {"for resolution and rate", "to set the camera", "to detect colours", "for its microphones"}) {
    EXPECT_EQ(1, logged(std::string("version 1 of the protocol, which has no request ") + each)) << each;
  }
}

TEST_F(CameraRequestsVersion1Test, APictureOfAnotherResolutionIsRefused) {
  auto answer = add(callForPicture(0, Resolution::kDouble), milliseconds(2000));
  ASSERT_TRUE(done(answer));
  EXPECT_THAT(answer.get().problem, HasSubstr("cannot take a picture of this resolution. It needs an RCServer"));
  EXPECT_TRUE(session_.nextRequest(wish_, now_).empty());
}

}  // namespace
