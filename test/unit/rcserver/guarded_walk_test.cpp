// Guarded walks on a table with edges and a board, with the robot's own program on the simulated ERS-7.
// AIBO_WHOLE_CAMPAIGN lets it drive a hundred times.

#include <cmath>
#include <cstdlib>

#include "rcserver_fixture.h"
#include "simulator/ers7/simulated_ers7.h"

namespace {

using namespace protocol::version2;
using simulated_ers7::SimulatedErs7;
using Velocity = protocol::version2::Velocity;

constexpr unsigned kFramesBetweenSteering = 12;

class GuardedWalkTest : public FakeRobotFixture {
 protected:
  void begin(std::uint64_t seed) {
    machine_.reset();
    SimulatedErs7::Options options;
    options.on_table = true;
    options.seed = seed;
    walker_ = std::make_unique<SimulatedErs7>(options);
    boot(*walker_);
    passFrames(kUntilMeasured);
    connectVersion2();
    client_->send(frame('T', TELEMETRY_PLAIN, 1, {0, 4}));
    longest_push_ = walked_ = pushed_ = 0;
    last_ = walker_->pose();
    client_->send(frame('E', POSTURE_STAND, 2, order()));
    pass(4);
    steer({0, 0, 0}, 1.5);  // it lets go
  }

  void TearDown() override {
    machine_.reset();
    walker_.reset();
  }

  void steer(const Velocity& velocity, double seconds) {
    for (double passed = 0; passed < seconds; passed += kFramesBetweenSteering * 0.008) {
      client_->send(frame('S', STEER_GUARDED, 3, payloadOf(SteeringOrder{NEVER_TOO_OLD, velocity})));
      pass(kFramesBetweenSteering * 0.008);
    }
  }

  void pass(double seconds) {
    for (double passed = 0; passed < seconds - 1e-9; passed += 0.008) {
      if (frames_++ % 100 == 0) {
        client_->send(frame('H', 0, 2));
      }
      passFrames(1);
      listen();
      watch();
    }
  }

  void listen() {
    for (const Frame& next : arrived()) {
      if (next.header.kind == END_PUSH) {
        last_end_ = textOf(next);
      } else if (next.header.kind == TELEMETRY_PUSH && next.header.request_number == 0) {
        std::map<int, int> values = valuesIn(next, GROUP_WALK);
        walked_ = std::hypot(values[WALK_FORWARD], values[WALK_LEFT]) * 1e-6;
      }
    }
  }

  void watch() {
    const simulated_ers7::Place& place = walker_->pose();
    const double way = std::hypot(place.x - last_.x, place.y - last_.y);
    last_ = place;
    const bool is_pushed = walker_->travel().isStopped() && walked_ > 0.01 && way / 0.008 < walked_ / 2;
    // A push goes on through the moments of a step in which the feet hardly move.
    pushed_ = is_pushed ? pushed_ + 0.008 : std::max(0.0, pushed_ - 0.004);
    longest_push_ = std::max(longest_push_, pushed_);  // s
  }

  void drive(std::uint64_t seed) {
    begin(seed);
    std::mt19937_64 random(seed);
    const auto draw = [&random](double least, double most) {
      return least + (most - least) * static_cast<double>(random() % 1000001) / 1e6;
    };
    for (double passed = 0; passed < 60 && !walker_->travel().hasFallenOff();) {
      const double seconds = draw(0.5, 4);
      const double kind = draw(0, 1);
      Velocity velocity = {0, 0, 0};
      if (kind < 0.5) {
        velocity = {draw(0.03, 0.3), 0, draw(0, 1) < 0.5 ? 0 : draw(-0.6, 0.6)};
      } else if (kind < 0.65) {
        velocity.forward = draw(-0.1, 0);
      } else if (kind < 0.75) {
        velocity.left = draw(-0.06, 0.06);
      } else if (kind < 0.9) {
        velocity.turn = draw(-1.2, 1.2);
      } else {
        velocity = {draw(-0.1, 0.3), draw(-0.06, 0.06), draw(-1.2, 1.2)};
      }
      steer(velocity, seconds);
      steer({0, 0, 0}, 0.1);
      passed += seconds + 0.1;
    }
  }

  std::unique_ptr<SimulatedErs7> walker_;
  double longest_push_ = 0;  ///< s; the board takes more than half of the way that the legs walk
  std::string last_end_;
  simulated_ers7::Place last_;
  double walked_ = 0;
  double pushed_ = 0;
  unsigned frames_ = 0;
};

TEST_F(GuardedWalkTest, HoweverItIsSteeredItNeitherFallsOffATableNorPushesAgainstABoard) {
  for (unsigned i = 1; i <= (std::getenv("AIBO_WHOLE_CAMPAIGN") != nullptr ? 100 : 6); ++i) {
    drive(i);
    EXPECT_FALSE(walker_->travel().hasFallenOff()) << "drive " << i << ", " << last_end_;
    EXPECT_LT(longest_push_, 1) << "drive " << i;
  }
}

}  // namespace
