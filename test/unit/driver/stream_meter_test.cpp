#include "node/camera/stream_meter.h"

#include <gmock/gmock.h>

#include "node/camera/camera_options.h"

namespace aibo_driver::node {
namespace {

using namespace std::chrono_literals;

TEST(StreamMeter, MeasuresRateBandwidthAndLatencySinceTheLastReading) {
  StreamMeter::SteadyTime now{100s};
  StreamMeter meter([&now] { return now; });
  now += 1s;
  meter.add(1000, now - 2ms);
  meter.add(3000, now - 4ms);
  now += 1s;
  const StreamMeter::Reading reading = meter.read(kCameraRate);
  EXPECT_DOUBLE_EQ(reading.picturesPerSecond(), 1.0);
  EXPECT_DOUBLE_EQ(reading.kilobytesPerSecond(), 2.0);
  EXPECT_DOUBLE_EQ(reading.mean_latency, 0.003);
  EXPECT_DOUBLE_EQ(reading.max_latency, 0.004);

  now += 1s;
  const StreamMeter::Reading idle = meter.read(kCameraRate);
  EXPECT_EQ(idle.pictures, 0u);
  EXPECT_DOUBLE_EQ(idle.picturesPerSecond(), 0.0);
  EXPECT_DOUBLE_EQ(idle.max_latency, 0.0);
}

class SlowStreamTest : public ::testing::Test {
 protected:
  // Lets a second pass in which this many pictures come.
  double slowForAfter(int pictures, double asked_rate = kCameraRate) {
    for (int i = 0; i < pictures; ++i) {
      meter_.add(1000, now_);
    }
    now_ += 1s;
    return meter_.read(asked_rate).slow_for;
  }

  StreamMeter::SteadyTime now_{100s};
  StreamMeter meter_{[this] { return now_; }};
};

TEST_F(SlowStreamTest, IsMeasuredFromHalfOfTheRateThatIsAskedFor) {
  EXPECT_DOUBLE_EQ(slowForAfter(30), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(15), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(14), 1);
  EXPECT_DOUBLE_EQ(slowForAfter(0), 2);
  EXPECT_DOUBLE_EQ(slowForAfter(14), 3);
  EXPECT_DOUBLE_EQ(slowForAfter(15), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(1), 1) << "it begins again";
}

TEST_F(SlowStreamTest, OfEveryThirdImageIsSlowWithHalfOfThose) {
  EXPECT_DOUBLE_EQ(slowForAfter(10, frameRateOf(3)), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(5, frameRateOf(3)), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(4, frameRateOf(3)), 1);
}

TEST_F(SlowStreamTest, IsNoneWhileNoStreamIsAskedFor) {
  EXPECT_DOUBLE_EQ(slowForAfter(1), 0) << "it may have begun a moment ago";
  EXPECT_DOUBLE_EQ(slowForAfter(1), 1);
  EXPECT_DOUBLE_EQ(slowForAfter(0, 0), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(14), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(14), 1);
}

TEST(StreamMeter, DoesNotDivideByZero) {
  StreamMeter meter([] { return StreamMeter::SteadyTime{}; });
  EXPECT_DOUBLE_EQ(meter.read(kCameraRate).picturesPerSecond(), 0.0);
  EXPECT_DOUBLE_EQ(meter.read(kCameraRate).kilobytesPerSecond(), 0.0);
}

}  // namespace
}  // namespace aibo_driver::node
