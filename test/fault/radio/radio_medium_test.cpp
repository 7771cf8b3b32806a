#include "radio/radio_medium.h"

#include <gtest/gtest.h>

#include <optional>

namespace fault_bench {
namespace {

using namespace std::chrono_literals;

// 1000 bytes at 8 Mbit/s are 1 ms on the air.
RadioOptions plainRadio() {
  RadioOptions options;
  options.bits_per_second = 8e6;
  options.overhead = 500us;
  options.delay = 2ms;
  options.jitter = 0us;
  return options;
}

constexpr std::size_t kPacket = 1000;

TEST(RadioMedium, APacketTakesItsTimeOnTheAirAndTheDelay) {
  RadioMedium medium(plainRadio());
  EXPECT_EQ(medium.send(RadioMedium::kUp, kPacket, 10ms), 10ms + 500us + 1ms + 2ms);
}

TEST(RadioMedium, BothDirectionsShareTheAir) {
  RadioMedium medium(plainRadio());
  EXPECT_EQ(medium.send(RadioMedium::kUp, kPacket, 0ms), 3500us);
  EXPECT_EQ(medium.send(RadioMedium::kDown, kPacket, 0ms), 5000us);
}

TEST(RadioMedium, DropsWhatTheQueueCannotHold) {
  RadioOptions options = plainRadio();
  options.queue_length = 2;
  RadioMedium medium(options);
  EXPECT_TRUE(medium.send(RadioMedium::kUp, kPacket, 0ms));
  EXPECT_TRUE(medium.send(RadioMedium::kUp, kPacket, 0ms));
  EXPECT_FALSE(medium.send(RadioMedium::kUp, kPacket, 0ms));
  EXPECT_TRUE(medium.send(RadioMedium::kUp, kPacket, 1500us)) << "the first packet has left the air";
}

TEST(RadioMedium, NothingGetsThroughAnOutage) {
  RadioOptions options = plainRadio();
  options.outages = {{100ms, 50ms}};
  RadioMedium medium(options);
  EXPECT_TRUE(medium.send(RadioMedium::kUp, kPacket, 98ms));
  EXPECT_FALSE(medium.send(RadioMedium::kUp, kPacket, 100ms));
  EXPECT_FALSE(medium.send(RadioMedium::kDown, kPacket, 148ms));
  EXPECT_TRUE(medium.send(RadioMedium::kDown, kPacket, 150ms));
}

TEST(RadioMedium, LosesItsShareAndTheSameWithTheSameSeed) {
  RadioOptions options = plainRadio();
  options.loss = 0.05;
  RadioMedium medium(options);
  RadioMedium same(options);
  constexpr int kPackets = 10000;
  int lost = 0;
  for (int i = 0; i < kPackets; ++i) {
    const auto now = i * 10ms;
    const auto arrival = medium.send(RadioMedium::kUp, kPacket, now);
    EXPECT_EQ(arrival, same.send(RadioMedium::kUp, kPacket, now));
    lost += arrival ? 0 : 1;
  }
  EXPECT_NEAR(lost, 500, 100);
}

TEST(RadioMedium, JitterLetsNothingOvertake) {
  RadioOptions options = plainRadio();
  options.jitter = 50ms;
  RadioMedium medium(options);
  RadioMedium::Time last{0};
  bool jitters = false;
  for (int i = 0; i < 1000; ++i) {
    const auto now = i * 5ms;
    const auto arrival = medium.send(RadioMedium::kUp, kPacket, now);
    ASSERT_TRUE(arrival);
    EXPECT_GE(*arrival, last);
    jitters = jitters || *arrival > now + 20ms;
    last = *arrival;
  }
  EXPECT_TRUE(jitters);
}

}  // namespace
}  // namespace fault_bench
