// What a hostile robot sends.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "hostile/attacks.h"
#include "protocol/color_requests.h"
#include "protocol/sound_requests.h"
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

// Colours that nobody asked for, of more pixels than there are.
Bytes impossibleColors(Random& random, unsigned count) {
  version2::ColorRegions colors = {count, 4 * count, 65535, 65535, 8, random() % 2 == 0, {}, nullptr, 0};
  for (std::uint8_t channel = 0; channel < 8; ++channel) {
    colors.regions[channel] = {channel, 0xFFFFFFFF, 65535, 65535, 65535, 65535, 65535, 65535};
  }
  Bytes payload = version2_frames::encoded(colors);
  if (colors.has_plane) {
    payload.insert(payload.end(), 3000, 0x81);
  }
  return makeFrame(version2::COLORS_PUSH, 0, payload);
}

// What it hears in pieces of a sample and of a second, of any time, and ends of sounds that nobody plays.
Bytes impossibleSound(Random& random, unsigned count) {
  const Bytes samples(count % 8 == 0 ? 64000 : 4, 1);
  const auto frame_number = static_cast<unsigned>(random());
  const bool is_end = count % 3 == 0;
  Bytes frame = makeFrame(
      version2::SOUND_PUSH, 0,
      is_end ? version2_frames::encoded(version2::SoundEnd{anyByte(random), count, count, count})
             : version2_frames::encoded(version2::HeardSound{
                   frame_number, static_cast<unsigned short>(samples.size() / 4), 2, samples.data(), samples.size()}));
  frame[1] = is_end ? version2::SOUND_SPEAKER : version2::SOUND_MICROPHONE;
  return frame;
}

std::string nonsenseHello(Random& random, unsigned count) {
  const std::string tail =
      "\nserver=x\nframe_number=4294967295\ncapabilities=\nlimits=1:-2147483647:2147483647:2147483647\n";
  switch (uniform(random, 0, 5)) {
    case 0:
      return "robot=ERS-" + std::to_string(count) + tail;
    case 1:
      return "robot=ERS-7\nrobot=ERS-7" + tail;
    case 2:
      return "robot=\x1b[2J" + tail;
    case 3:
      return std::string(200000, '=') + "\n";
    case 4:
      return "robot=" + std::string(127, '%') + tail;
    default:
      return "";
  }
}

/// First a byte that no server sends: the client says hello only over a new connection.
std::function<Misbehaviour(unsigned)> hello() {
  return [](unsigned seed) {
    const auto random = std::make_shared<Random>(seed);
    const auto count = std::make_shared<unsigned>(0);
    const auto reconnects = std::make_shared<bool>(false);
    Misbehaviour misbehaviour = flood([=](bool) { return std::exchange(*reconnects, true) ? Bytes() : Bytes(8, 'Z'); });
    misbehaviour.answer = [=](const Request& request) -> std::optional<Bytes> {
      if (!request.version2 || request.kind != version2::REQUEST_HELLO) {
        return std::nullopt;
      }
      Bytes payload;
      append(nonsenseHello(*random, ++*count), &payload);
      return makeFrame('h', request.number, payload);
    };
    return misbehaviour;
  };
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
  const auto error = [](Random&, unsigned count) { return Bytes{'e', 0, static_cast<std::uint8_t>(count), 0}; };
  const auto picture = [](Random& random, unsigned) { return test_pictures::makeReply(hostileJpeg(random)); };
  const auto size = [](Random& random, unsigned) {
    return Bytes{'f', anyByte(random), anyByte(random), anyByte(random), 0};
  };
  const auto nonsense = [](Random& random, unsigned) { return anyBytes(random, 3000); };
  return {
      {"errors", "errors that answer nothing", 1, floodOf(error)},
      {"values", "impossible values, asked for or not", 1, [](unsigned) { return version1Values(); }},
      {"pictures", "damaged and dangerous JPEGs", 1, floodOf(picture)},
      {"sizes", "pictures that announce any size", 1, floodOf(size)},
      {"nonsense", "random bytes", 1, floodOf(nonsense)},
      {"half", "half a picture, then silence", 1,
       [](unsigned) {
         return half({'f', 0, 0, 9, 0, 0xFF, 0xD8});
       }},
  };
}

std::vector<RobotAttack> version2Attacks() {
  const auto reports = [](Random&, unsigned count) { return report(std::to_string(count) + longText('x')); };
  const auto new_reports = [](Random&, unsigned count) { return report("head_pan " + std::to_string(count)); };
  const auto escapes = [](Random&, unsigned) { return report("\x1b[2J\x1b]0;you\x07"); };
  const auto ends = [](Random&, unsigned count) {
    return count % 3 == 0 ? end(version2::ENDED_JAM, longText('j'), "") : end(version2::ENDED_MOTION, "NOD.MTN", "r");
  };
  const auto new_ends = [](Random&, unsigned count) {
    return end(version2::ENDED_MOTION, "M" + std::to_string(count) + ".MTN", longText('r'));
  };
  const auto html = [](Random&, unsigned count) {
    const std::string text = "<img src=\"/dev/stdin\">" + std::to_string(count);
    return count % 2 == 0 ? report(text) : end(version2::ENDED_MOTION, text, text);
  };
  const auto values = [](Random&, unsigned count) { return impossibleTelemetry(count); };
  const auto colors = [](Random& random, unsigned count) { return impossibleColors(random, count); };
  const auto sound = [](Random& random, unsigned count) { return impossibleSound(random, count); };
  const auto telemetry = [](Random&, unsigned count) {
    return makeFrame('t', 0, makeTelemetry(4 * count, {{'J', 1, 0}, {'J', 2, 0}, {'S', 66, 500000}}));
  };
  const auto stamps = [](Random& random, unsigned count) {
    const auto frame = static_cast<unsigned>(random());
    return count % 8 == 0 ? makeFrame('f', 0, version2_frames::makePicture(test_pictures::makeNumbered(1), frame))
                          : makeFrame('t', 0, makeTelemetry(frame, {{'J', 2, 0}}));
  };
  const auto pictures = [](Random& random, unsigned count) {
    return makeFrame('f', 0, version2_frames::makePicture(hostileJpeg(random), count));
  };
  const auto sizes = [](Random& random, unsigned) {
    Bytes frame = makeFrame('e', 0, {});
    std::generate(frame.begin() + 4, frame.end(), [&] { return anyByte(random); });
    return frame;
  };
  const auto replies = [](Random& random, unsigned) {
    return makeFrame(static_cast<char>(uniform(random, 'a', 'z')), uniform(random, 1, 65535), anyBytes(random, 60));
  };
  const auto nonsense = [](Random& random, unsigned) { return anyBytes(random, 3000); };
  return {
      {"reports", "reports of 256 KB", 2, floodOf(reports)},
      {"new-reports", "reports that are never the same", 2, floodOf(new_reports)},
      {"escapes", "reports with control characters", 2, floodOf(escapes)},
      {"ends", "ends of motions and faults that never began", 2, floodOf(ends)},
      {"new-ends", "ends that are never the same, of 256 KB", 2, floodOf(new_ends)},
      {"html", "texts that look like HTML", 2, floodOf(html)},
      {"values", "impossible values", 2, floodOf(values)},
      {"colors", "colours of more pixels than there are", 2, floodOf(colors)},
      {"sound", "sound of any time, in pieces of any size", 2, floodOf(sound)},
      {"telemetry", "measurements as fast as the network allows", 2, floodOf(telemetry)},
      {"stamps", "frame numbers that jump", 2, floodOf(stamps)},
      {"pictures", "damaged and dangerous JPEGs", 2, floodOf(pictures)},
      {"hello", "a hello of nonsense", 2, hello()},
      {"sizes", "frames that announce any size", 2, floodOf(sizes)},
      {"replies", "replies to requests that were not made", 2, floodOf(replies)},
      {"nonsense", "random bytes", 2, floodOf(nonsense)},
      {"half", "half a frame, then silence", 2,
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

const RobotAttack& findRobotAttack(const std::string& name, int version) {
  for (const RobotAttack& attack : robotAttacks()) {
    if (attack.version == version && attack.name == name) {
      return attack;
    }
  }
  throw std::invalid_argument("there is no attack '" + name + "' in version " + std::to_string(version));
}

}  // namespace hostile
