#include "ros/camera/stream_meter.h"

#include <gmock/gmock.h>

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
  const StreamMeter::Reading reading = meter.read();
  EXPECT_DOUBLE_EQ(reading.picturesPerSecond(), 1.0);
  EXPECT_DOUBLE_EQ(reading.kilobytesPerSecond(), 2.0);
  EXPECT_DOUBLE_EQ(reading.mean_latency, 0.003);
  EXPECT_DOUBLE_EQ(reading.max_latency, 0.004);

  now += 1s;
  const StreamMeter::Reading idle = meter.read();
  EXPECT_EQ(idle.pictures, 0u);
  EXPECT_DOUBLE_EQ(idle.picturesPerSecond(), 0.0);
  EXPECT_DOUBLE_EQ(idle.max_latency, 0.0);
}

TEST(StreamMeter, DoesNotDivideByZero) {
  StreamMeter meter([] { return StreamMeter::SteadyTime{}; });
  EXPECT_DOUBLE_EQ(meter.read().picturesPerSecond(), 0.0);
  EXPECT_DOUBLE_EQ(meter.read().kilobytesPerSecond(), 0.0);
}

}  // namespace
}  // namespace aibo_driver::node
