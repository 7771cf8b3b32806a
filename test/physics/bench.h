/// @file bench.h
/// The robot's own program on a robot with weight, and a client that steers it.
#ifndef TEST_PHYSICS_BENCH_H
#define TEST_PHYSICS_BENCH_H

#include <memory>
#include <string>
#include <vector>

#include "physical_ers7.h"
#include "protocol/version2.h"
#include "protocol/walk_requests.h"
#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/machine.h"
#include "support/raw_client.h"

namespace physics {

using protocol::version2::Velocity;

/// What the robot says about its walk in a frame.
struct Step {
  Velocity velocity{};
  double phase = 0;  ///< 0..1
  int state = 0;     ///< protocol::version2::WalkState
};

/// An end that the robot pushes.
struct End {
  int what;
  int how;
  std::string name;
  std::string reason;
};

/// All on one thread and in stepped time, so that each run is the same to the last bit.
class Bench {
 public:
  /// Boots RCServer on the robot, and connects a client of version 2 that asks for telemetry in every frame. The motors
  /// are on.
  /// @throw std::runtime_error if the server does not answer
  explicit Bench(const World& world = World());

  PhysicalErs7& robot() { return robot_; }

  /// From now on, the client steers ten times a second.
  void steer(const Velocity& velocity);

  /// Asks for a posture.
  void take(protocol::version2::Posture posture);

  void switchMotors(bool on);

  /// One frame passes.
  void passFrame();

  /// Passes frames until something of this kind has ended since the last call.
  /// @param what protocol::version2::ENDED_WALK, for example
  /// @return the end; its `what` is 0 if none came in this time
  End awaitEnd(int what, double seconds);

  /// What the robot said last.
  const Step& step() const { return step_; }

  /// Ends that the robot has pushed, and texts of its errors, all since the beginning.
  const std::vector<End>& ends() const { return ends_; }
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  void request(char kind, int id, const std::vector<unsigned char>& payload);
  template <typename Payload>
  void order(char kind, int id, const Payload& content) {
    std::vector<unsigned char> payload(protocol::version2::encodedSize(content));
    encode(content, payload.data());
    request(kind, id, payload);
  }
  void connect();
  void listen();
  void hear(const test_support::Frame& frame);
  void hearTelemetry(const test_support::Frame& frame);

  PhysicalErs7 robot_;
  openr_host::SteppedClock clock_;
  std::unique_ptr<openr_host::Machine> machine_;
  std::unique_ptr<test_support::TestClient> client_;
  unsigned short last_number_ = 0;
  bool steering_ = false;
  Velocity wanted_{};
  Step step_;
  std::vector<End> ends_;
  std::size_t ends_awaited_ = 0;
  std::vector<std::string> errors_;
};

}  // namespace physics

#endif  // TEST_PHYSICS_BENCH_H
