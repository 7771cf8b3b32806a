// The driver's node with a robot that attacks it.

#include <aibo_driver/Sound.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "protocol/version2.h"
#include "support/picture_server.h"
#include "support/resources.h"
#include "support/ros/driver_process.h"
#include "support/ros/topics.h"
#include "support/test_pictures.h"
#include "support/version2_frames.h"

namespace {

using std::chrono::milliseconds;
using test_support::Bytes;
using test_support::DriverProcess;
using test_support::PictureServer;
using test_support::Resources;
using test_support::TopicListener;
using version2_frames::makeFrame;
using version2_frames::makePicture;
using version2_frames::makeTelemetry;
using Random = std::mt19937;
namespace version2 = protocol::version2;

constexpr int kLargest = std::numeric_limits<int>::max();

int uniform(Random& random, int lowest, int highest) {
  return std::uniform_int_distribution<int>(lowest, highest)(random);
}

std::uint8_t anyByte(Random& random) {
  return static_cast<std::uint8_t>(random());
}

Bytes anyBytes(Random& random, int most) {
  Bytes bytes(static_cast<std::size_t>(uniform(random, 1, most)));
  std::generate(bytes.begin(), bytes.end(), [&] { return anyByte(random); });
  return bytes;
}

void append(const std::string& text, Bytes* bytes) {
  bytes->insert(bytes->end(), text.begin(), text.end());
}

/// The frame of an `e` that nobody asked for, of any size.
Bytes report(const std::string& text) {
  Bytes payload = {0, version2::CODE_JOINT_FAULT};
  append(text, &payload);
  return makeFrame(version2::ERROR_MESSAGE, 0, payload);
}

Bytes end(std::uint8_t what, std::uint8_t order, const std::string& name, const std::string& reason) {
  Bytes payload = {what, version2::END_REFUSED, 0, order};
  append(name + "\n" + reason, &payload);
  return makeFrame(version2::END_PUSH, 0, payload);
}

// Largest text that fits into a frame, with room for a number.
std::string longText(char character) {
  return std::string(version2::MAX_PAYLOAD_TOWARDS_CLIENT - 40, character);
}

// Not a picture, or one that should not be decoded.
Bytes hostileJpeg(Random& random) {
  static const Bytes good = test_pictures::makeNumbered(1);
  Bytes jpeg = good;
  const std::size_t frame = test_pictures::findMarker(jpeg, 0xC0);
  switch (uniform(random, 0, 4)) {
    case 0:  // ever new sizes
      std::generate_n(jpeg.begin() + static_cast<std::ptrdiff_t>(frame) + 5, 4, [&] { return anyByte(random); });
      break;
    case 1:
      jpeg.resize(static_cast<std::size_t>(uniform(random, 1, static_cast<int>(jpeg.size()))));
      break;
    case 2:
      std::generate(jpeg.begin() + 2, jpeg.end(), [&] { return anyByte(random); });
      break;
    case 3: {  // a good one with escape sequences in a comment
      Bytes comment = {0xFF, 0xFE, 0x40, 0x02};
      comment.resize(0x4004, 0x1B);
      jpeg.insert(jpeg.begin() + 2, comment.begin(), comment.end());
      break;
    }
    default:  // progressive
      jpeg[frame + 1] = 0xC2;
  }
  return jpeg;
}

/// A flood that has a source of random numbers and a counter.
template <typename Make>
PictureServer::Flood flood(Make make) {
  return [make, random = Random(1), count = 0U]() mutable { return make(random, ++count); };
}

Bytes impossibleTelemetry(unsigned count) {
  const int value = count % 2 == 0 ? kLargest : -kLargest;
  std::vector<version2::TelemetryEntry> entries;
  for (const std::uint8_t joint : Bytes{1, 2, 3, 4, 11, 12, 13, 52, 99}) {
    entries.push_back({'J', joint, value});
    entries.push_back({'D', joint, value});
  }
  for (const std::uint8_t sensor : Bytes{5, 9, 14, 53, 54, 55, 61, 62, 63, 66, 67, 94, 200}) {
    entries.push_back({'S', sensor, value});
  }
  return makeFrame('t', 0, makeTelemetry(40 * count, entries));
}

Bytes endOfNothing(unsigned count) {
  const auto order = static_cast<std::uint8_t>(count / 3);
  return count % 3 == 0   ? end(version2::ENDED_JAM, 0, longText('j'), "")
         : count % 3 == 1 ? end(version2::ENDED_JOINTS, order, "", "r")
                          : end(version2::ENDED_MOTION, order, "NOD.MTN", "r");
}

Bytes frameOfAnySize(Random& random) {
  Bytes frame = makeFrame('e', 0, {});
  std::generate(frame.begin() + 4, frame.end(), [&] { return anyByte(random); });
  return frame;
}

/// What a hostile robot sends without end.
struct RobotAttack {
  std::string name;
  int version;  ///< of the protocol, 1 or 2
  PictureServer::Flood flood;
};

const std::vector<RobotAttack> kAttacks = {
    {"values", 1, flood([](Random&, unsigned) {
       return Bytes{'j', 2, 0xFF, 0x7F};
     })},
    {"pictures", 1, flood([](Random& random, unsigned) { return test_pictures::makeReply(hostileJpeg(random)); })},
    {"nonsense", 1, flood([](Random& random, unsigned) { return anyBytes(random, 3000); })},
    {"reports", 2, flood([](Random&, unsigned count) { return report(std::to_string(count) + longText('x')); })},
    {"escapes", 2, flood([](Random&, unsigned) { return report("\x1b[2J\x1b]0;you\x07"); })},
    {"ends", 2, flood([](Random&, unsigned count) { return endOfNothing(count); })},
    {"questions", 2, flood([](Random&, unsigned) { return makeFrame('h', 0, {}); })},
    {"values", 2, flood([](Random&, unsigned count) { return impossibleTelemetry(count); })},
    {"telemetry", 2, flood([](Random&, unsigned count) {
       return makeFrame('t', 0, makeTelemetry(4 * count, {{'J', 1, 0}}));
     })},
    {"pictures", 2,
     flood([](Random& random, unsigned count) { return makeFrame('f', 0, makePicture(hostileJpeg(random), count)); })},
    {"sizes", 2, flood([](Random& random, unsigned) { return frameOfAnySize(random); })},
    {"nonsense", 2, flood([](Random& random, unsigned) { return anyBytes(random, 3000); })},
};

/// A driver, a server that behaves well at first, and subscribers of everything.
class Hostile : public testing::TestWithParam<int> {
 protected:
  static constexpr milliseconds kAttackTime{400};
  static constexpr std::size_t kMostLog = 64 * 1024;     // bytes, for an attack
  static constexpr std::size_t kMostMemory = 48 * 1024;  // KB more than before all attacks
  static constexpr double kMostSpeed = 70;               // rad/s; three times the tail's, and noise
  static constexpr double kFarthest = 2.6;               // rad; the rotators, and 0.2

  bool goesOn() { return pictures_.waitForNext() && joints_.waitForNext() && images_.waitForNext(); }

  void attack(const RobotAttack& attack) {
    ASSERT_TRUE(goesOn()) << "before the attack";
    joints_.clear();
    battery_.clear();
    const std::size_t log = driver_.output().size();
    server_.flood(attack.flood);
    std::this_thread::sleep_for(kAttackTime);
    server_.flood(nullptr);
    ASSERT_TRUE(driver_.isRunning()) << driver_.output();
    EXPECT_TRUE(goesOn()) << "after the attack";
    judgeMessages();
    EXPECT_LT(driver_.output().size() - log, kMostLog);
    if (test_support::kMemoryCounts) {
      const Resources now = Resources::of(std::to_string(driver_.pid()));
      EXPECT_LT(now.resident_kilobytes, before_.resident_kilobytes + kMostMemory);
    }
  }

  void judgeMessages() {
    const ros::Time now = ros::Time::now();
    for (const auto& message : joints_.waitForCount(0)) {
      EXPECT_LE(message->header.stamp, now);
      for (const double position : message->position) {
        EXPECT_LT(std::abs(position), kFarthest);
      }
      for (const double velocity : message->velocity) {
        EXPECT_LT(std::abs(velocity), kMostSpeed);
      }
    }
    for (const auto& message : battery_.waitForCount(0)) {
      EXPECT_LE(message->percentage, 1.05F);
    }
  }

  const std::string name_ = "/hostile" + std::to_string(GetParam());
  PictureServer server_{GetParam(), milliseconds(10)};
  TopicListener<sensor_msgs::CompressedImage> pictures_{name_ + "/camera/image_raw/compressed"};
  TopicListener<sensor_msgs::Image> images_{name_ + "/camera/image_raw"};
  TopicListener<sensor_msgs::JointState> joints_{name_ + "/joint_states"};
  TopicListener<sensor_msgs::BatteryState> battery_{name_ + "/battery"};
  TopicListener<aibo_driver::Sound> sounds_{name_ + "/microphone"};
  DriverProcess driver_{name_, server_.port(), {"_adaptive:=true"}};
  Resources before_;
};

INSTANTIATE_TEST_SUITE_P(Versions, Hostile, testing::Values(1, 2));

TEST_P(Hostile, RobotsDoNotHarmTheDriver) {
  server_.setTelemetry(true);
  ASSERT_TRUE(goesOn());
  before_ = Resources::of(std::to_string(driver_.pid()));
  for (const RobotAttack& each : kAttacks) {
    if (each.version == GetParam()) {
      SCOPED_TRACE(each.name);
      pictures_.clear();
      images_.clear();
      attack(each);
    }
  }
}

}  // namespace
