// What a hostile robot sends.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "hostile/attacks.h"
#include "protocol/version2.h"
#include "support/test_pictures.h"
#include "support/version2_frames.h"

namespace hostile {
namespace {

using test_support::Bytes;
using test_support::Request;
using version2_frames::makeFrame;
using version2_frames::makeTelemetry;
using Misbehaviour = test_support::PictureServer::Misbehaviour;
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

Bytes end(std::uint8_t what, const std::string& name, const std::string& reason) {
  Bytes payload = {what, version2::END_REFUSED, 0, 0};
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

Misbehaviour flood(std::function<Bytes(bool)> more) {
  return {std::move(more), nullptr};
}

/// A flood that has a source of random numbers and a counter.
template <typename Make>
std::function<Misbehaviour(unsigned)> floodOf(Make make) {
  return [make](unsigned seed) {
    const auto random = std::make_shared<Random>(seed);
    const auto count = std::make_shared<unsigned>(0);
    return flood([=](bool) { return make(*random, ++*count); });
  };
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

/// Half a message, then nothing any more, not even answers.
Misbehaviour half(const Bytes& begin) {
  const auto is_sent = std::make_shared<bool>(false);
  return {[=](bool) { return std::exchange(*is_sent, true) ? Bytes() : begin; },
          [](const Request&) { return std::optional<Bytes>(Bytes()); }};
}

/// The largest values as the answer to every request of version 1, and the same unasked.
Misbehaviour version1Values() {
  return {[](bool) {
            return Bytes{'j', 2, 0xFF, 0x7F};
          },
          [](const Request& request) -> std::optional<Bytes> {
            if (request.kind != 'J' && request.kind != 'S') {
              return std::nullopt;
            }
            return Bytes{static_cast<std::uint8_t>(request.kind + 'a' - 'A'), static_cast<std::uint8_t>(request.id),
                         0xFF, 0x7F};
          }};
}

std::vector<RobotAttack> version1Attacks() {
  const auto picture = [](Random& random, unsigned) { return test_pictures::makeReply(hostileJpeg(random)); };
  const auto nonsense = [](Random& random, unsigned) { return anyBytes(random, 3000); };
  return {
      {"values", 1, [](unsigned) { return version1Values(); }},
      {"pictures", 1, floodOf(picture)},
      {"nonsense", 1, floodOf(nonsense)},
      {"half", 1,
       [](unsigned) {
         return half({'f', 0, 0, 9, 0, 0xFF, 0xD8});
       }},
  };
}

std::vector<RobotAttack> version2Attacks() {
  const auto reports = [](Random&, unsigned count) { return report(std::to_string(count) + longText('x')); };
  const auto escapes = [](Random&, unsigned) { return report("\x1b[2J\x1b]0;you\x07"); };
  const auto ends = [](Random&, unsigned count) {
    return count % 3 == 0 ? end(version2::ENDED_JAM, longText('j'), "") : end(version2::ENDED_MOTION, "NOD.MTN", "r");
  };
  const auto values = [](Random&, unsigned count) { return impossibleTelemetry(count); };
  const auto telemetry = [](Random&, unsigned count) {
    return makeFrame('t', 0, makeTelemetry(4 * count, {{'J', 1, 0}, {'J', 2, 0}, {'S', 66, 500000}}));
  };
  const auto pictures = [](Random& random, unsigned count) {
    return makeFrame('f', 0, version2_frames::makePicture(hostileJpeg(random), count));
  };
  const auto sizes = [](Random& random, unsigned) {
    Bytes frame = makeFrame('e', 0, {});
    std::generate(frame.begin() + 4, frame.end(), [&] { return anyByte(random); });
    return frame;
  };
  const auto nonsense = [](Random& random, unsigned) { return anyBytes(random, 3000); };
  return {
      {"reports", 2, floodOf(reports)},
      {"escapes", 2, floodOf(escapes)},
      {"ends", 2, floodOf(ends)},
      {"values", 2, floodOf(values)},
      {"telemetry", 2, floodOf(telemetry)},
      {"pictures", 2, floodOf(pictures)},
      {"sizes", 2, floodOf(sizes)},
      {"nonsense", 2, floodOf(nonsense)},
      {"half", 2,
       [](unsigned) {
         return half({'f', 0, 0, 0, 0, 0, 9, 0, 1, 2, 3});
       }},
  };
}

}  // namespace

const std::vector<RobotAttack>& robotAttacks() {
  static const std::vector<RobotAttack> attacks = [] {
    std::vector<RobotAttack> all = version2Attacks();
    for (RobotAttack& attack : version1Attacks()) {
      all.push_back(std::move(attack));
    }
    return all;
  }();
  return attacks;
}

}  // namespace hostile
