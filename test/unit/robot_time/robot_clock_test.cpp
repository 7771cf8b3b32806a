#include "robot_time/robot_clock.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <random>

namespace aibo_driver::robot_time {
namespace {

using namespace std::chrono_literals;
using SteadyTime = RobotClock::SteadyTime;

constexpr double kShortestDelay = 0.005;  // s

SteadyTime at(double seconds) {
  return SteadyTime(std::chrono::duration_cast<SteadyTime::duration>(std::chrono::duration<double>(seconds)));
}

double secondsOf(SteadyTime time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

struct Statistics {
  double mean = 0;
  double deviation = 0;
};

Statistics statisticsOf(const std::vector<double>& values) {
  Statistics statistics;
  for (const double value : values) {
    statistics.mean += value / static_cast<double>(values.size());
  }
  for (const double value : values) {
    statistics.deviation += std::pow(value - statistics.mean, 2) / static_cast<double>(values.size());
  }
  statistics.deviation = std::sqrt(statistics.deviation);
  return statistics;
}

/// A robot whose clock drifts by 100 ppm, behind a radio that delays each message by 5 to 50 ms, but never overtakes.
class RobotBehindRadio {
 public:
  explicit RobotBehindRadio(unsigned seed) : random_(seed) {}

  /// Telemetry every 4 frames, and some pictures.
  void run(double seconds) {
    for (const double end = now_ + seconds; now_ < end;) {
      send(4, &telemetry_errors);
      if (++sent_ % 3 == 0) {
        send(0, &picture_errors);
      }
    }
  }

  /// No message comes through, but the robot goes on.
  void pass(double seconds) {
    const auto frames = static_cast<std::uint32_t>(seconds / kFramePeriod);
    now_ += frames * kFramePeriod;
    frame_ += frames;
  }

  /// Messages sent now arrive after this time at the earliest.
  void holdUp(double seconds) { radio_free_ = now_ + seconds; }

  void reconnect() { ++connection_number_; }

  void forget() {
    before_arrival = true;
    telemetry_errors.clear();
    picture_errors.clear();
  }

  /// The clock's time minus the true time of measurement, for the frames sent.
  std::vector<double> telemetry_errors;
  std::vector<double> picture_errors;
  RobotClock clock;
  bool monotonic = true;
  bool before_arrival = true;

 private:
  static constexpr double kFramePeriod = 0.008 * (1 + 100e-6);

  void send(std::uint32_t frames, std::vector<double>* errors) {
    frame_ += frames;
    now_ += frames * kFramePeriod;
    radio_free_ = std::max(radio_free_, now_ + kShortestDelay + random_delay_(random_));
    const SteadyTime time = clock.timeOf(connection_number_, frame_, at(radio_free_));
    errors->push_back(secondsOf(time) - now_);
    monotonic = monotonic && (!last_ || time > *last_ || (frames == 0 && time == *last_));
    before_arrival = before_arrival && time <= at(radio_free_);
    last_ = time;
  }

  std::mt19937 random_;
  std::uniform_real_distribution<double> random_delay_{0, 0.045};
  std::uint64_t connection_number_ = 1;
  std::uint32_t frame_ = 0U - 45 * 125;  // the numbers begin again after 45 s
  double now_ = 5000.4321;
  double radio_free_ = 0;
  int sent_ = 0;
  std::optional<SteadyTime> last_;
};

/// Checks that the next minute is as accurate as promised after 30 s, with the same times for both.
void expectAccurate(RobotBehindRadio& robot) {
  robot.forget();
  robot.run(60);
  const Statistics telemetry = statisticsOf(robot.telemetry_errors);
  const Statistics pictures = statisticsOf(robot.picture_errors);
  EXPECT_LT(telemetry.deviation, 0.002);
  EXPECT_LT(pictures.deviation, 0.002);
  EXPECT_NEAR(telemetry.mean, kShortestDelay, 0.002) << "late by the shortest delay, which cannot be measured";
  EXPECT_NEAR(pictures.mean, telemetry.mean, 0.0002);
  EXPECT_TRUE(robot.monotonic);
  EXPECT_TRUE(robot.before_arrival);
}

TEST(RobotClock, Keeps2MillisecondsAfter30SecondsOfJitterAndDrift) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    RobotBehindRadio robot(seed);
    robot.run(30);
    expectAccurate(robot);  // meanwhile, the frame numbers begin again
    EXPECT_EQ(robot.clock.read().timelines, 1u);
  }
}

TEST(RobotClock, GoesOnAfterALongOutage) {
  for (const double outage : {3.0, 3600.0}) {
    SCOPED_TRACE(outage);
    RobotBehindRadio robot(1);
    robot.run(60);
    robot.pass(outage);
    robot.reconnect();
    robot.forget();
    robot.run(5);
    EXPECT_NEAR(statisticsOf(robot.telemetry_errors).mean, kShortestDelay, 0.020);
    robot.run(25);
    expectAccurate(robot);
    EXPECT_EQ(robot.clock.read().timelines, 1u);
  }
}

TEST(RobotClock, IsNotMovedByABurstOfDelayedMessages) {
  RobotBehindRadio robot(1);
  robot.run(60);
  robot.forget();
  robot.holdUp(3);
  robot.run(5);
  EXPECT_LT(statisticsOf(robot.telemetry_errors).deviation, 0.002);
  EXPECT_EQ(robot.clock.read().timelines, 1u);
  expectAccurate(robot);
}

TEST(RobotClock, GoesOnOrBeginsATimelineAsInThisTable) {
  struct Message {
    std::uint64_t connection;
    std::uint32_t frame;
    double arrival;
    double time;
  };
  const std::pair<const char*, std::vector<Message>> rows[] = {
      {"the robot was restarted", {{1, 20, 100, 100}, {2, 2, 100.5, 100.5}}},
      {"its frames have not gone on for all the time", {{2, 2, 100.5, 100.5}, {3, 127, 103, 103}}},
      {"the computer was suspended for 58 s", {{1, 1000, 100, 100}, {1, 8500, 102, 102}, {1, 8504, 102.05, 102.032}}},
      {"the process may have stalled", {{1, 1000, 100, 100}, {1, 1004, 103, 100.032}, {1, 1250, 105, 102}}},
      {"its frames stood still for 3 s",
       {{1, 1000, 100, 100}, {1, 1004, 103, 100.032}, {1, 1250, 105, 102}, {1, 1275, 105.2, 105.2}}},
      {"a message of an older connection",
       {{1, 5000, 100, 100}, {2, 100, 110, 110}, {1, 5004, 100.04, 100.04}, {2, 104, 110.05, 110.032}}},
      {"a picture after later telemetry",
       {{1, 1000, 100, 100}, {1, 1004, 100.032, 100.032}, {1, 1002, 100.04, 100.016}}},
  };
  for (const auto& [name, messages] : rows) {
    RobotClock clock;
    for (const Message& each : messages) {
      EXPECT_NEAR(secondsOf(clock.timeOf(each.connection, each.frame, at(each.arrival))), each.time, 1e-3) << name;
    }
  }
}

TEST(RobotClock, ReportsHowLongMessagesWereDelayed) {
  RobotClock clock;
  clock.timeOf(1, 1000, at(100));
  clock.timeOf(1, 1004, at(100.062));
  const RobotClock::Reading reading = clock.read();
  EXPECT_EQ(reading.messages, 2u);
  EXPECT_NEAR(reading.mean_delay, 0.015, 1e-6);
  EXPECT_NEAR(reading.longest_delay, 0.030, 1e-6);
  EXPECT_EQ(clock.read().messages, 0u) << "each reading starts again";
}

}  // namespace
}  // namespace aibo_driver::robot_time
