// Guarded walks on a table with edges and a board, with the robot's own program on the simulated ERS-7.
// AIBO_WHOLE_CAMPAIGN lets it drive a hundred times, and prints what happened.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>

#include "protocol/hello.h"
#include "protocol/walk_requests.h"
#include "rcserver_fixture.h"
#include "simulator/ers7/simulated_ers7.h"
#include "support/whole_campaign.h"

namespace {

using namespace protocol::version2;
using simulated_ers7::SimulatedErs7;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using Velocity = protocol::version2::Velocity;

constexpr unsigned kFramesBetweenSteering = 12;

/// What happened on one or more drives.
struct Log {
  int falls = 0;
  double longest_push = 0;  ///< s; the board takes more than half of the way that the legs walk
  double way = 0;           ///< m; of the body
  double turned = 0;        ///< rad
  double over_edge = 0;     ///< s, with a foot on the floor's height beyond the edge
  std::map<std::string, int> ends;

  void add(const Log& other) {
    falls += other.falls;
    longest_push = std::max(longest_push, other.longest_push);
    way += other.way;
    turned += other.turned;
    over_edge += other.over_edge;
    for (const auto& [reason, count] : other.ends) {
      ends[reason] += count;
    }
  }
};

class GuardedWalkTest : public RCServerFixture {
 protected:
  void begin(std::uint64_t seed) {
    client_.reset();
    machine_.reset();
    SimulatedErs7::Options options;
    options.on_table = true;
    options.seed = seed;
    robot_ = std::make_unique<SimulatedErs7>(options);
    boot(*robot_);
    client_ = connect();
    client_->send(request('X', 2));
    ASSERT_TRUE(machine_->runUntil([this] { return !client_->take(protocol::VALUE_REPLY_SIZE).empty(); }));
    client_->send(frame('T', TELEMETRY_WITH_WALK, 1, {0, 4}));
    log_ = {};
    walked_ = pushed_ = 0;
    last_ = robot_->pose();
    take('E', POSTURE_STAND);
    pass(4);
  }

  void TearDown() override {
    machine_.reset();
    robot_.reset();
  }

  void take(char kind, int id) { client_->send(frame(kind, id, 2)); }

  void steer(const Velocity& velocity, double seconds, int options = STEER_GUARDED) {
    for (double passed = 0; passed < seconds; passed += kFramesBetweenSteering * 0.008) {
      client_->send(frame('S', options, 3, payloadOf(velocity)));
      pass(kFramesBetweenSteering * 0.008);
    }
  }

  void letGo() { steer({0, 0, 0}, 1.5); }

  void pass(double seconds) {
    for (double passed = 0; passed < seconds - 1e-9; passed += 0.008) {
      if (frames_++ % 100 == 0) {
        take('H', 0);
      }
      passFrames(1);
      listen();
      watch();
    }
  }

  void listen() {
    while (const auto next = client_->nextFrame()) {
      EndMessage end = {};
      Telemetry telemetry = {};
      if (next->header.kind == END_PUSH && decode(next->payload.data(), next->payload.size(), &end) == nullptr) {
        last_end_ = {end.reason, end.reason_size};
        ++log_.ends[last_end_];
      } else if (next->header.kind == TELEMETRY_PUSH && next->header.request_number == 0 &&
                 decode(next->payload.data(), next->payload.size(), &telemetry) == nullptr) {
        walked_ = 0;
        for (size_t i = 0; i < telemetry.count; ++i) {
          const TelemetryEntry& entry = telemetry.entries[i];
          if (entry.group == GROUP_WALK && (entry.id == WALK_FORWARD || entry.id == WALK_LEFT)) {
            walked_ = std::hypot(walked_, entry.value * 1e-6);
          }
        }
      } else if (next->header.kind == ERROR_MESSAGE && next->payload.size() > 2) {
        last_error_ = textOf(*next).substr(2);
      }
    }
  }

  void watch() {
    const simulated_ers7::Place& place = robot_->pose();
    const double way = std::hypot(place.x - last_.x, place.y - last_.y);
    log_.way += way;
    log_.turned += std::abs(place.yaw - last_.yaw);
    log_.falls += robot_->travel().hasFallenOff() ? 1 : 0;
    log_.over_edge += robot_->travel().isOverEdge() ? 0.008 : 0;
    last_ = place;
    const bool is_pushed = robot_->travel().isStopped() && walked_ > 0.01 && way / 0.008 < walked_ / 2;
    // A push goes on through the moments of a step in which the feet hardly move.
    pushed_ = is_pushed ? pushed_ + 0.008 : std::max(0.0, pushed_ - 0.004);
    log_.longest_push = std::max(log_.longest_push, pushed_);
  }

  void drive(std::uint64_t seed) {
    begin(seed);
    std::mt19937_64 random(seed);
    const auto draw = [&random](double least, double most) {
      return least + (most - least) * static_cast<double>(random() % 1000001) / 1e6;
    };
    for (double passed = 0; passed < 60 && log_.falls == 0;) {
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
    log_.falls = std::min(log_.falls, 1);
  }

  std::unique_ptr<SimulatedErs7> robot_;
  std::unique_ptr<TestClient> client_;
  Log log_;
  std::string last_end_;
  std::string last_error_;
  simulated_ers7::Place last_;
  double walked_ = 0;
  double pushed_ = 0;
  unsigned frames_ = 0;
};

TEST_F(GuardedWalkTest, AtAnEdgeItStopsTellsWhyAndCanTurnAndWalkBack) {
  begin(1);
  for (int time = 1; time <= 2; ++time) {
    steer({0.15, 0, 0}, 12);
    EXPECT_THAT(last_end_, HasSubstr("the floor ends ahead")) << "time " << time;
    EXPECT_THAT(last_error_, HasSubstr("the floor ends ahead: turn, or walk back; let go first"));
    const double edge = simulated_ers7::kTableX + simulated_ers7::kTableHalfLength;
    EXPECT_LT(robot_->pose().x, edge - 0.15);
    EXPECT_GT(robot_->pose().x, edge - 0.35);
    letGo();
    last_error_.clear();
    steer({0.05, 0, 0}, 0.05);
    EXPECT_EQ(last_error_, "the floor ends ahead: turn, or walk back") << "it does not begin";
    letGo();
    const double before = robot_->pose().x;
    last_end_ = "none";
    steer({-0.1, 0, 0}, 3);
    letGo();
    EXPECT_LT(robot_->pose().x, before - 0.2);
    EXPECT_EQ(last_end_, "") << "it was steered to a stand";
  }
  steer({0, 0, 0.8}, 4);
  letGo();
  EXPECT_EQ(last_end_, "");
  EXPECT_EQ(log_.over_edge, 0);
}

TEST_F(GuardedWalkTest, BeforeABoardItSlowsDownAndStops) {
  begin(1);
  steer({0, 0, 0.8}, 2.3);  // towards the board
  letGo();
  double fastest = 0;
  for (int i = 0; i < 100 && last_end_.empty(); ++i) {
    fastest = std::max(fastest, walked_);
    steer({0.1, 0, 0}, 0.09);
  }
  EXPECT_GT(fastest, 0.09);
  EXPECT_THAT(last_end_, HasSubstr("something is in the way ahead"));
  EXPECT_LT(log_.longest_push, 0.1);
  const double nose = robot_->pose().y + 0.17;
  EXPECT_GT(simulated_ers7::kTableHalfWidth - simulated_ers7::kBoardThickness - nose, 0.02);
}

TEST_F(GuardedWalkTest, AnObliqueEdgeThatTheChestSeesLateIsFeltWithAPaw) {
  begin(1);
  steer({0, 0, -0.8}, 0.55);
  letGo();
  steer({0.12, 0, 0}, 14);
  EXPECT_EQ(log_.falls, 0) << last_end_;
  EXPECT_THAT(last_end_, AnyOf(HasSubstr("paw finds no floor"), HasSubstr("the floor ends")));
}

TEST_F(GuardedWalkTest, AClientThatDoesNotAskForTheGuardWalksOn) {
  begin(1);
  steer({0.15, 0, 0}, 12, 0);
  EXPECT_GT(log_.falls, 0);
  EXPECT_THAT(last_end_, HasSubstr("the robot lies on its left side"));
}

TEST_F(GuardedWalkTest, HoweverItIsSteeredItNeitherFallsOffATableNorPushesAgainstABoard) {
  const unsigned drives = test_support::wantsWholeCampaign() ? 100 : 6;
  Log all;
  for (unsigned i = 1; i <= drives; ++i) {
    drive(i);
    EXPECT_EQ(log_.falls, 0) << "drive " << i << ", " << last_end_;
    EXPECT_LT(log_.longest_push, 1) << "drive " << i;
    all.add(log_);
  }
  std::cout << drives << " drives of 60 s: " << all.falls << " falls; longest push " << all.longest_push << " s; "
            << all.way << " m, " << all.turned << " rad; a foot beyond an edge for " << all.over_edge << " s\n";
  for (const auto& [reason, count] : all.ends) {
    std::cout << "  " << count << " x " << (reason.empty() ? "done" : reason) << "\n";
  }
}

}  // namespace
