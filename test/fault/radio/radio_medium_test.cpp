#include "radio/radio_medium.h"

#include <gtest/gtest.h>

#include <map>
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

RadioMedium::Bytes packet(std::uint8_t name = 0) {
  return RadioMedium::Bytes(1000, name);
}

/// When each packet arrives, by its name; those that are lost are not in it.
std::map<int, RadioMedium::Time> arrivals(RadioMedium& medium, RadioMedium::Time end = 1h) {
  std::map<int, RadioMedium::Time> times;
  while (const auto arrived = medium.receive(end)) {
    times[arrived->bytes[0]] = arrived->arrival;
  }
  return times;
}

TEST(RadioMedium, APacketTakesItsTimeOnTheAirAndTheDelay) {
  RadioMedium medium(plainRadio());
  medium.send(RadioMedium::kUp, packet(), 10ms);
  EXPECT_EQ(medium.nextEvent(10ms), 11500us) << "the end of its time on the air";
  EXPECT_FALSE(medium.receive(13499us));
  EXPECT_EQ(medium.nextEvent(12ms), 13500us);
  const auto arrived = medium.receive(13500us);
  ASSERT_TRUE(arrived);
  EXPECT_EQ(arrived->direction, RadioMedium::kUp);
  EXPECT_EQ(arrived->arrival, 13500us);
  EXPECT_EQ(arrived->bytes, packet());
  EXPECT_EQ(medium.nextEvent(14ms), std::nullopt);
}

TEST(RadioMedium, BothDirectionsShareTheAir) {
  RadioMedium medium(plainRadio());
  medium.send(RadioMedium::kUp, packet(1), 0ms);
  medium.send(RadioMedium::kDown, packet(2), 0ms);
  EXPECT_EQ(arrivals(medium), (std::map<int, RadioMedium::Time>{{1, 3500us}, {2, 5000us}}));
}

TEST(RadioMedium, TheStationsTakeTurns) {
  RadioMedium medium(plainRadio());
  for (const int name : {1, 2, 3}) {
    medium.send(RadioMedium::kUp, packet(static_cast<std::uint8_t>(name)), 0ms);
  }
  medium.send(RadioMedium::kDown, packet(4), 1ms);
  EXPECT_EQ(arrivals(medium), (std::map<int, RadioMedium::Time>{{1, 3500us}, {4, 5000us}, {2, 6500us}, {3, 8000us}}));
}

TEST(RadioMedium, DropsWhatTheQueueCannotHold) {
  RadioOptions options = plainRadio();
  options.queue_length = 2;
  RadioMedium medium(options);
  EXPECT_TRUE(medium.send(RadioMedium::kUp, packet(), 0ms));
  EXPECT_TRUE(medium.send(RadioMedium::kUp, packet(), 0ms));
  EXPECT_FALSE(medium.send(RadioMedium::kUp, packet(), 0ms));
  EXPECT_EQ(medium.lost(), 1u);
  EXPECT_TRUE(medium.send(RadioMedium::kDown, packet(), 0ms)) << "each station has its own queue";
  EXPECT_TRUE(medium.send(RadioMedium::kUp, packet(), 1500us)) << "the first packet has left the air";
}

TEST(RadioMedium, NothingGetsThroughAnOutage) {
  RadioOptions options = plainRadio();
  options.outages = {{100ms, 50ms}};
  RadioMedium medium(options);
  medium.send(RadioMedium::kUp, packet(1), 98ms);
  medium.send(RadioMedium::kUp, packet(2), 100ms);
  medium.send(RadioMedium::kDown, packet(3), 148ms);
  medium.send(RadioMedium::kDown, packet(4), 150ms);
  EXPECT_EQ(arrivals(medium), (std::map<int, RadioMedium::Time>{{1, 101500us}, {4, 153500us}}));
  EXPECT_EQ(medium.lost(), 2u);
}

TEST(RadioMedium, LosesItsShareAndTheSameWithTheSameSeed) {
  RadioOptions options = plainRadio();
  options.loss = 0.05;
  RadioMedium medium(options);
  RadioMedium same(options);
  constexpr int kPackets = 10000;
  for (int i = 0; i < kPackets; ++i) {
    const auto now = i * 10ms;
    medium.send(RadioMedium::kUp, packet(), now);
    same.send(RadioMedium::kUp, packet(), now);
    EXPECT_EQ(medium.receive(now + 9ms).has_value(), same.receive(now + 9ms).has_value());
  }
  EXPECT_NEAR(static_cast<double>(medium.lost()), 500, 100);
}

TEST(RadioMedium, JitterLetsNothingOvertake) {
  RadioOptions options = plainRadio();
  options.jitter = 50ms;
  RadioMedium medium(options);
  bool jitters = false;
  for (int i = 0; i < 200; ++i) {
    medium.send(RadioMedium::kUp, packet(static_cast<std::uint8_t>(i)), i * 5ms);
  }
  RadioMedium::Time last{0};
  int next = 0;
  while (const auto arrived = medium.receive(1h)) {
    EXPECT_EQ(arrived->bytes[0], next);
    EXPECT_GE(arrived->arrival, last);
    jitters = jitters || arrived->arrival > next * 5ms + 20ms;
    last = arrived->arrival;
    ++next;
  }
  EXPECT_EQ(next, 200);
  EXPECT_TRUE(jitters);
}

}  // namespace
}  // namespace fault_bench
