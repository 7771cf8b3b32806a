// Joints are commanded in time whatever the camera does, on a processor as slow as the robot's. An ERS-7 needs 9 to
// 14 ms to compress a picture, by counted instructions; the report of 2006 measured 32 to 64 ms.

#include "picture_checks.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;

constexpr unsigned char kPanJoint = 2;
constexpr int kEncodeTime = 64;  // ms

class TimingTest : public FakeRobotFixture {
 protected:
  void SetUp() override {
    handler_time_ = [](const std::string& object) {
      return std::chrono::milliseconds(object == "PictureEncoder" ? kEncodeTime : 0);
    };
    start();
    connectVersion2();
    answerTo('T', 0, payloadOf(TelemetryPeriod{4}));
    answerTo('W', 85, kStreamOn);
    passFrames(25);
    arrived();
  }
};

TEST_F(TimingTest, AMotionTelemetryAndTheStreamKeepTheirRatesWhileThePictureEncoderIsSlow) {
  const int before = robot_.joint("head_pan").position;
  const int wanted = 1000000;
  std::vector<int>& path = robot_.joint("head_pan").path;
  path.clear();
  send(frame('J', 0, 1000, order(payloadOf(JointTargets{2000, 1, {{kPanJoint, wanted}}}))));
  std::map<char, int> counts;
  for (unsigned i = 0; i < 2 * kFramesASecond; ++i) {
    passFrames(1);
    for (const Frame& next : arrived()) {
      ++counts[next.header.kind];
      if (next.header.kind == 'f') {
        const Picture picture = pictureIn(next);
        EXPECT_NEAR(brightnessOf(picture.jpeg).level, FakeRobot::brightness(picture.image.image_count), 3);
      }
    }
  }
  EXPECT_NEAR(counts['t'], 62, 1);
  EXPECT_NEAR(counts['f'], 2000 / kEncodeTime, 2);
  passFrames(10);
  const auto arrival = static_cast<int>(std::find(path.begin(), path.end(), wanted) - path.begin());
  EXPECT_NEAR(8 * arrival, 2000, 60);
  const int fastest = wanted / 200;  // of a trapezoid that takes 250 frames
  for (size_t i = 1; i < path.size(); ++i) {
    ASSERT_LE(path[i] - path[i - 1], fastest) << "frame " << i;
    ASSERT_TRUE(path[i] > path[i - 1] || path[i] == before || path[i] == wanted) << "stands still in frame " << i;
  }
}

}  // namespace
