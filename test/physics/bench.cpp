#include "bench.h"

#include "objects/HostSettings.h"
#include "simulator/object_catalog.h"

namespace physics {
namespace {

namespace version2 = protocol::version2;

constexpr unsigned kFramesPerSecond = 125;
constexpr unsigned kFramesBetweenSteering = 12;

/// The time for the server to boot, and for an answer.
constexpr unsigned kPatience = 100;

}  // namespace

Bench::Bench(const World& world) : robot_(world) {
  HostSettings host;
  host.memory_stick = MEMORY_STICK;
  setHostSettings(host);
  openr_host::MachineOptions options;
  options.ports = {{protocol::RCSERVER_PORT, 0}, {openr_host::kConsolePort, 0}};
  options.memory_stick = host.memory_stick;
  options.catalog = objectCatalog();
  machine_ = std::make_unique<openr_host::Machine>(options, clock_, robot_);
  machine_->boot();
  connect();
}

void Bench::connect() {
  client_ = std::make_unique<test_support::TestClient>(machine_->hostPort(protocol::RCSERVER_PORT));
  const protocol::BasicGetCommand ask = version2::versionRequest();
  client_->send({ask.command, static_cast<char>(ask.identifier)});
  const bool agreed = machine_->runUntil([this] {
    const auto answer = client_->next();
    return answer && version2::agreesToVersion2(answer->value);
  });
  if (!agreed) {
    throw std::runtime_error("the server does not answer");
  }
  request(version2::REQUEST_HELLO, 0, {});
  request(version2::REQUEST_TELEMETRY, version2::TELEMETRY_PLAIN, {0, 1});
  for (unsigned i = 0; i < kPatience; ++i) {
    passFrame();
  }
}

void Bench::request(char kind, int id, const std::vector<unsigned char>& payload) {
  const version2::FrameHeader header = {kind, static_cast<unsigned char>(id), ++last_number_,
                                        static_cast<unsigned>(payload.size())};
  unsigned char bytes[version2::FRAME_HEADER_SIZE];
  encode(header, bytes);
  client_->send(std::string(bytes, bytes + sizeof(bytes)) + std::string(payload.begin(), payload.end()));
}

void Bench::steer(const Velocity& velocity) {
  if (!steering_) {  // a walk begins only after zeros
    order(version2::REQUEST_STEER, 0, version2::SteeringOrder{version2::NEVER_TOO_OLD, {0, 0, 0}});
  }
  wanted_ = velocity;
  steering_ = true;
}

void Bench::take(version2::Posture posture) {
  steering_ = false;
  order(version2::REQUEST_POSTURE, posture, version2::PostureOrder{version2::NEVER_TOO_OLD});
}

void Bench::switchMotors(bool on) {
  order(version2::REQUEST_MOTORS, 0, version2::MotorOrder{version2::NEVER_TOO_OLD, on});
}

void Bench::passFrame() {
  if (clock_.frame() % kFramesPerSecond == 0) {
    request(version2::REQUEST_HELLO, 0, {});
  }
  if (steering_ && clock_.frame() % kFramesBetweenSteering == 0) {
    order(version2::REQUEST_STEER, 0, version2::SteeringOrder{version2::NEVER_TOO_OLD, wanted_});
  }
  clock_.step();
  machine_->runPending();
  listen();
}

void Bench::listen() {
  while (const auto frame = client_->nextFrame()) {
    hear(*frame);
  }
  if (client_->ended()) {
    throw std::runtime_error("the server has closed the connection");
  }
}

void Bench::hear(const test_support::Frame& frame) {
  const unsigned char* payload = frame.payload.data();
  const size_t size = frame.payload.size();
  version2::EndMessage end = {};
  version2::ErrorMessage error = {};
  if (version2::isError(frame.header.kind, size)) {
    decode(payload, size, &error);
    errors_.emplace_back(error.text, error.text_size);
  } else if (frame.header.kind == version2::END_PUSH && decode(payload, size, &end) == nullptr) {
    ends_.push_back({end.what, end.how, {end.name, end.name_size}, {end.reason, end.reason_size}});
  } else if (frame.header.kind == version2::TELEMETRY_PUSH && frame.header.request_number == 0) {
    hearTelemetry(frame);
  }
}

void Bench::hearTelemetry(const test_support::Frame& frame) {
  version2::Telemetry telemetry = {};
  if (decode(frame.payload.data(), frame.payload.size(), &telemetry) != nullptr) {
    throw std::runtime_error("the server sends telemetry that cannot be read");
  }
  const std::map<int, double*> values = {{version2::WALK_FORWARD, &step_.velocity.forward},
                                         {version2::WALK_LEFT, &step_.velocity.left},
                                         {version2::WALK_TURN, &step_.velocity.turn},
                                         {version2::WALK_PHASE, &step_.phase}};
  for (const version2::TelemetryEntry& entry : std::vector(telemetry.entries, telemetry.entries + telemetry.count)) {
    if (entry.group == version2::GROUP_WALK && values.count(entry.id) > 0) {
      *values.at(entry.id) = entry.value * 1e-6;
    } else if (entry.group == version2::GROUP_WALK && entry.id == version2::WALK_STATE) {
      step_.state = entry.value;
    }
  }
}

End Bench::awaitEnd(int what, double seconds) {
  for (unsigned i = 0; i < seconds * kFramesPerSecond; ++i) {
    while (ends_awaited_ < ends_.size()) {
      const End& end = ends_[ends_awaited_++];
      if (end.what == what) {
        return end;
      }
    }
    passFrame();
  }
  return {};
}

}  // namespace physics
