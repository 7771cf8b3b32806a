#include "support/fake_client.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <optional>
#include <utility>

#include "aibo_client/exceptions.h"

// The linker takes these functions instead of the library's, because it sees them first. Others, such as the
// constructors, are the library's.
namespace aibo_client {

using std::chrono::milliseconds;
using test_support::FakeClient;

namespace {

FakeClient& fake(RcServerClient* client) {
  return static_cast<FakeClient&>(*client);
}

void tell(RcServerClient* client, const std::string& request, milliseconds timeout = milliseconds(0)) {
  fake(client).timeout = timeout;
  if (!fake(client).problem.empty()) {
    throw NetworkException(fake(client).problem);
  }
  fake(client).told.push_back(request);
}

// The answer to a request, for a caller that waits for it.
template <typename Answer>
auto answer(RcServerClient* client, Answer get) {
  return std::async(std::launch::deferred, [client, get] {
    if (fake(client).meanwhile) {
      std::exchange(fake(client).meanwhile, nullptr)();
    }
    return get();
  });
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", std::abs(value) < 0.005 ? 0 : value);  // without -0.00
  return text;
}

}  // namespace

void RcServerClient::setStreaming(bool on) {
  tell(this, on ? "stream" : "no stream");
}
void RcServerClient::setJpegQuality(int quality) {
  tell(this, "quality " + std::to_string(quality));
}
int RcServerClient::jpegQuality() const {
  return 83;
}
void RcServerClient::setStreamFormat(const StreamFormat& format) {
  tell(this,
       "format " + std::to_string(static_cast<int>(format.resolution)) + " " + std::to_string(format.every_nth_image));
}
void RcServerClient::setPictureTransport(PictureTransport transport) {
  tell(this, transport == PictureTransport::kUdp ? "udp" : "tcp");
}
PicturePtr RcServerClient::takePicture(int quality, milliseconds timeout, std::optional<Resolution> resolution) {
  tell(this,
       "picture " + std::to_string(quality) +
           (resolution ? " of resolution " + std::to_string(static_cast<int>(*resolution)) : ""),
       timeout);
  Picture picture = *fake(this).picture;
  picture.quality = fake(this).stream_quality.value_or(quality);
  return std::make_shared<Picture>(picture);
}
void RcServerClient::commandJoints(const std::vector<JointTarget>& targets, milliseconds duration,
                                   const OrderTerms& terms) {
  std::string text = "J";
  for (const JointTarget& target : targets) {
    if (target.speed > 0) {
      setJointSpeedLimits({{target.id, target.speed}});
    }
    text += " " + std::to_string(target.id) + ":" + number(target.position);
  }
  tell(this, text + " in " + std::to_string(duration.count()));
  fake(this).terms = terms;
}
void RcServerClient::setJointSpeedLimits(const std::vector<JointSpeedLimit>& limits) {
  for (const JointSpeedLimit& limit : limits) {
    double& in_force = fake(this).speed_limits[{fake(this).connections, limit.id}];
    if (in_force != limit.speed) {
      tell(this, "V " + std::to_string(limit.id) + ":" + number(limit.speed));
      in_force = limit.speed;
    }
  }
}
std::future<bool> RcServerClient::beginMotors(bool on, milliseconds timeout, const OrderTerms& terms) {
  tell(this, on ? "motors on" : "motors off", timeout);
  fake(this).terms = terms;
  return answer(this, [this, on] { return on == fake(this).motors_work; });
}
std::future<void> RcServerClient::beginHold(const std::vector<int>& joints, milliseconds timeout) {
  if (!fake(this).can_hold) {
    throw CommandException("it has no request to hold joints");
  }
  std::string text = "hold";
  for (const int joint : joints) {
    text += " " + std::to_string(joint);
  }
  tell(this, text, timeout);
  return answer(this, [] {});
}
void RcServerClient::steer(const WalkVelocity& velocity, const OrderTerms& terms) {
  if (!velocity.isZero()) {
    fake(this).terms = terms;
  }
  const bool is_named_zero = velocity.isZero() && terms.number != 0;  // zeros are no order
  tell(this, "steer " + number(velocity.forward) + " " + number(velocity.left) + " " + number(velocity.turn) +
                 (is_named_zero ? " with a number" : ""));
}
std::future<void> RcServerClient::beginPosture(Posture posture, milliseconds timeout, const OrderTerms& terms) {
  constexpr const char* kNames[] = {"", "stand", "sit", "rest"};
  tell(this, kNames[static_cast<int>(posture)], timeout);
  fake(this).terms = terms;
  return answer(this, [] {});
}
void RcServerClient::commandLeds(const std::vector<LedCommand>& commands) {
  std::string text = "LEDs";
  for (const LedCommand& led : commands) {
    text += " " + std::to_string(led.id) + ":" + std::to_string(led.intensity) + (led.mode == LedMode::kB ? "B" : "");
  }
  tell(this, text);
}
void RcServerClient::commandEars(bool left, bool right) {
  tell(this, std::string("ears ") + (left ? "1" : "0") + (right ? "1" : "0"));
}
std::future<std::string> RcServerClient::beginMotion(const std::string& name, int repetitions, milliseconds timeout,
                                                     const OrderTerms& terms) {
  tell(this, "play " + name + " " + std::to_string(repetitions), timeout);
  fake(this).terms = terms;
  return answer(this, [this] { return fake(this).motion_changes; });
}
void RcServerClient::stopMotion(const std::string& name, milliseconds timeout) {
  tell(this, "stop " + name, timeout);
}
void RcServerClient::uploadMotion(const std::string& name, const std::vector<std::uint8_t>& content,
                                  milliseconds timeout) {
  tell(this, "upload " + name + " " + std::to_string(content.size()), timeout);
}
void RcServerClient::deleteMotion(const std::string& name, milliseconds timeout) {
  tell(this, "delete " + name, timeout);
}
std::vector<std::string> RcServerClient::listMotions(milliseconds timeout) {
  tell(this, "list", timeout);
  return fake(this).motions;
}
std::string RcServerClient::takePictureOnRobot(int quality, milliseconds timeout) {
  tell(this, "picture on robot " + std::to_string(quality), timeout);
  return "AIBO0001.JPG";
}
std::vector<std::string> RcServerClient::listPictures(milliseconds timeout) {
  tell(this, "list pictures", timeout);
  return {"AIBO0001.JPG", "MINE.JPG"};
}
std::vector<std::uint8_t> RcServerClient::fetchPicture(const std::string& name, milliseconds timeout) {
  tell(this, "fetch " + name, timeout);
  return fake(this).picture->jpeg;
}
void RcServerClient::deletePicture(const std::string& name, milliseconds timeout) {
  tell(this, "delete " + name, timeout);
}
SoundProgress RcServerClient::playSamples(std::uint64_t sound, const std::vector<std::int16_t>& samples, bool is_last,
                                          milliseconds timeout) {
  FakeClient& client = fake(this);
  tell(this, "samples " + std::to_string(samples.size()) + (is_last ? " last" : ""), timeout);
  client.played.insert(client.played.end(), samples.begin(), samples.end());
  client.sounds += sound == 0 ? 1 : 0;
  if (client.on_samples) {
    client.on_samples(is_last);
  }
  return {sound == 0 ? client.sounds : sound, client.room_for_samples};
}
void RcServerClient::stopSound(milliseconds timeout) {
  tell(this, "stop sound", timeout);
}
void RcServerClient::shutDownRobot(milliseconds timeout) {
  tell(this, "shut down", timeout);
}
void RcServerClient::rebootRobot(milliseconds timeout) {
  tell(this, "reboot", timeout);
}
MotorsAndPosture RcServerClient::motorsAndPosture() const {
  return static_cast<const FakeClient*>(this)->state;
}
ConnectionStatus RcServerClient::status() const {
  return static_cast<const FakeClient*>(this)->present;
}
std::string RcServerClient::robotDesign() const {
  return status().robot.design;
}
ClientStatistics RcServerClient::statistics() const {
  ClientStatistics statistics;
  statistics.connections = static_cast<const FakeClient*>(this)->connections;
  return statistics;
}

}  // namespace aibo_client
