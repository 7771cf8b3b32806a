#include "ros/joints/joint_mover.h"

#include <gmock/gmock.h>

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "support/fake_client.h"

namespace aibo_driver::node {
namespace {

using movement::Movement;
using movement::MovementEnd;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr int kHeadPan = 2;

// Lets a test do something while a motion is being played.
class PlayingClient : public test_support::FakeClient {
 public:
  std::function<void()> while_playing;

  std::string playMotion(const std::string& name, int repetitions, Milliseconds timeout,
                         const OrderTerms& terms) override {
    std::string changes = FakeClient::playMotion(name, repetitions, timeout, terms);
    if (while_playing) {
      while_playing();
    }
    return changes;
  }
};

// The speed limit is 3.0 rad/s, the approach speed 0.5 rad/s.
class JointMoverTest : public ::testing::Test {
 protected:
  JointMoverTest() {
    client_.present.robot.capabilities = {"I"};
    measure(0.0);
  }

  void measure(double pan, milliseconds age = milliseconds(0)) {
    Telemetry telemetry;
    telemetry.arrival = steady_clock::now() - age;
    telemetry.joints = {{kHeadPan, pan}, {1, 0.0}};
    measured_.update(telemetry);
  }

  void useVersion1() {
    client_.can_hold = false;
    client_.present.protocol_version = 1;
    client_.present.robot.capabilities.clear();
  }

  JointMover::Fate startPan(double position, double time, milliseconds wait = milliseconds(0)) {
    return mover_.start({{"head_pan"}, {{time, {position}, {}}}}, wait, "test");
  }

  void commandPan(double position) { mover_.command({"head_pan"}, {position}, {}, "test", mover_.epoch()); }

  std::string refusal(const std::function<void()>& work) {
    try {
      work();
    } catch (const Exception& error) {
      return error.what();
    }
    return "none";
  }

  MovementEnd lastEnd() { return mover_.state().last ? mover_.state().last->how : MovementEnd::kUnknown; }

  PlayingClient client_;
  movement::JointTable table_{"ERS-7", 3.0};
  movement::MeasuredJoints measured_{table_};
  bool telemetry_ = true;
  JointMover mover_{table_, measured_, client_, DriverParameters(), [this] { return telemetry_; }};
};

TEST_F(JointMoverTest, SendsWhereTheJointsOfATrajectoryShouldBeSoon) {
  startPan(1.0, 1.0);
  EXPECT_THAT(client_.told, ElementsAre("V 2:3.00", "J 2:0.10 in 96"));
  EXPECT_TRUE(mover_.goOn());
}

TEST_F(JointMoverTest, HoldsByTheRobotsRequest) {
  const JointMover::Fate fate = startPan(1.0, 1.0);
  client_.told.clear();
  mover_.hold("stop was called");
  EXPECT_THAT(client_.told, ElementsAre("hold"));
  EXPECT_EQ(mover_.look(fate).end, MovementEnd::kStopped);
  EXPECT_FALSE(mover_.goOn());
  EXPECT_THAT(client_.told, ElementsAre("hold")) << "nothing goes on";
}

TEST_F(JointMoverTest, HoldsATrajectoryOfAVersion1ServerWhereItWasSent) {
  useVersion1();
  startPan(1.0, 1.0);
  client_.told.clear();
  measure(-0.3);  // it lags behind
  mover_.hold("stop was called");
  EXPECT_THAT(client_.told, ElementsAre("J 2:0.10 in 0"));
}

TEST_F(JointMoverTest, HoldsACommandOfAVersion1ServerOnItsWay) {
  useVersion1();
  measure(0.5);
  commandPan(-1.0);
  client_.told.clear();
  mover_.hold("stop was called");
  EXPECT_THAT(client_.told, ElementsAre("J 2:0.50 in 0")) << "not at its target, and at its speed";
}

TEST_F(JointMoverTest, StopsMotionsOfAVersion1ServerIfOneWasPlayed) {
  useVersion1();
  mover_.hold("stop was called");
  EXPECT_THAT(client_.told, IsEmpty());
  mover_.play("NOD.MTN", 1, seconds(1));
  client_.told.clear();
  mover_.hold("stop was called");
  EXPECT_THAT(client_.told, ElementsAre("stop "));
  ++client_.connections;
  client_.told.clear();
  mover_.hold("stop was called");
  EXPECT_THAT(client_.told, IsEmpty()) << "the robot has stopped it when the connection ended";
}

TEST_F(JointMoverTest, CannotHoldWithoutARobotAndEndsEverythingAnyway) {
  const JointMover::Fate fate = startPan(1.0, 1.0);
  client_.problem = "there is no robot";
  EXPECT_THAT(refusal([this] { mover_.hold("stop was called"); }), HasSubstr("there is no robot"));
  EXPECT_EQ(mover_.look(fate).end, MovementEnd::kStopped);
}

TEST_F(JointMoverTest, CancelsOneTrajectoryOnly) {
  const JointMover::Fate pan = startPan(1.0, 1.0);
  const JointMover::Fate neck = mover_.start({{"neck_tilt"}, {{1.0, {-0.5}, {}}}}, milliseconds(0), "test");
  client_.told.clear();
  mover_.cancel(pan, "the goal was cancelled");
  EXPECT_THAT(client_.told, ElementsAre("hold 2"));
  EXPECT_EQ(mover_.look(pan).end, MovementEnd::kStopped);
  EXPECT_FALSE(mover_.look(neck).end);
  mover_.cancel(pan, "the goal was cancelled");
  EXPECT_THAT(client_.told, ElementsAre("hold 2")) << "it is over";
}

TEST_F(JointMoverTest, SendsNothingThatWasAskedForBeforeAStop) {
  const std::uint64_t before = mover_.epoch();
  mover_.hold("stop was called");
  client_.told.clear();
  mover_.command({"head_pan"}, {0.5}, {}, "test", before);
  EXPECT_THAT(client_.told, IsEmpty());
}

TEST_F(JointMoverTest, RefusesEverythingNewWhileBlocked) {
  mover_.block();
  commandPan(0.5);
  EXPECT_THAT(refusal([this] { startPan(1.0, 1.0); }), HasSubstr("was stopped after"));
  EXPECT_THAT(refusal([this] { mover_.play("NOD.MTN", 1, seconds(1)); }), HasSubstr("was stopped after"));
  EXPECT_THAT(client_.told, IsEmpty());
  mover_.unblock();
  startPan(1.0, 1.0);
  EXPECT_THAT(client_.told, SizeIs(2));
}

TEST_F(JointMoverTest, AMotionThatBeginsDuringAStopIsStopped) {
  client_.while_playing = [this] { mover_.hold("stop was called"); };
  EXPECT_THAT(refusal([this] { mover_.play("NOD.MTN", 1, seconds(1)); }), HasSubstr("everything was stopped"));
  EXPECT_EQ(client_.told.back(), "stop NOD.MTN");
}

TEST_F(JointMoverTest, IsStoppedFromAnotherThreadWithoutSendingMore) {
  std::atomic<bool> stopped{false};
  std::atomic<int> sent_after{0};
  std::atomic<bool> going{true};
  class CountingClient : public test_support::FakeClient {
   public:
    std::function<void()> on_joints;
    void commandJoints(const std::vector<JointTarget>&, Milliseconds, const OrderTerms&) override { on_joints(); }
    void setJointSpeedLimits(const std::vector<JointSpeedLimit>&) override {}
    void hold(const std::vector<int>&, Milliseconds) override {}
  } client;
  client.on_joints = [&] { sent_after += stopped ? 1 : 0; };
  JointMover mover(table_, measured_, client, DriverParameters(), [] { return true; });
  std::thread joint_thread([&] {
    while (going) {
      const std::uint64_t epoch = mover.epoch();
      mover.command({"head_pan"}, {0.5}, {}, "test", epoch);
      mover.goOn();
    }
  });
  for (int i = 0; i < 200; ++i) {
    mover.block();
    mover.hold("stop was called");
    stopped = true;
    std::this_thread::yield();
    stopped = false;
    mover.unblock();
  }
  going = false;
  joint_thread.join();
  EXPECT_EQ(sent_after, 0);
}

TEST_F(JointMoverTest, RefusesTrajectoriesOfOldMeasurements) {
  measure(0.0, milliseconds(500));
  EXPECT_THAT(refusal([this] { startPan(1.0, 1.0); }), HasSubstr("head_pan was last measured 0.5 s ago"));
  useVersion1();
  EXPECT_EQ(refusal([this] { startPan(1.0, 1.0); }), "none") << "it reports one joint after the other";
  measure(0.0, milliseconds(2500));
  EXPECT_THAT(refusal([this] { startPan(1.0, 2.0); }), HasSubstr("head_pan was last measured 2.5 s ago"));
}

TEST_F(JointMoverTest, RefusesTrajectoriesAtOnceWithoutTelemetry) {
  telemetry_ = false;
  EXPECT_THAT(refusal([this] { startPan(1.0, 1.0); }), HasSubstr("telemetry_rate is 0"));
}

TEST_F(JointMoverTest, RefusesTrajectoriesAndCommandsForARobotOfAnotherDesign) {
  client_.present.robot.design = "ERS-210";
  EXPECT_THAT(refusal([this] { startPan(1.0, 1.0, milliseconds(60000)); }), HasSubstr("it is an ERS-210"));
  commandPan(1.0);
  EXPECT_THAT(client_.told, IsEmpty());
}

TEST_F(JointMoverTest, EndsEverythingOverANewConnection) {
  const JointMover::Fate fate = startPan(1.0, 1.0);
  ++client_.connections;
  client_.told.clear();
  EXPECT_FALSE(mover_.goOn());
  EXPECT_THAT(client_.told, IsEmpty());
  EXPECT_THAT(mover_.look(fate).reason, HasSubstr("connection to the robot was lost"));
}

TEST_F(JointMoverTest, ACommandEndsATrajectoryAndSaysSo) {
  const JointMover::Fate fate = startPan(1.0, 1.0);
  commandPan(0.3);
  EXPECT_EQ(mover_.look(fate).reason, "head_pan was commanded to go elsewhere");
  EXPECT_EQ(lastEnd(), MovementEnd::kReplaced);
}

TEST_F(JointMoverTest, ApproachesAgainAfterTheMotorsWereSwitched) {
  commandPan(0.0);
  commandPan(0.2);  // the joint is measured at 0: the approach is over
  commandPan(0.3);
  EXPECT_EQ(client_.told.back(), "J 2:0.30 in 0");
  client_.told.clear();
  mover_.prepareForMotors();
  commandPan(1.0);
  EXPECT_THAT(client_.told, ElementsAre("V 2:0.50", "J 2:1.00 in 0"));
}

TEST_F(JointMoverTest, PlaysAMotionWithTheSpeedLimitsOfAllJointsAndEndsTrajectories) {
  commandPan(0.1);
  const JointMover::Fate trajectory = startPan(1.0, 1.0);
  client_.told.clear();
  mover_.play("NOD.MTN", 2, seconds(1));
  EXPECT_EQ(client_.told.back(), "play NOD.MTN 2");
  client_.told.pop_back();
  EXPECT_THAT(client_.told, SizeIs(table_.size() - 1)) << "that of the trajectory's joint is in force";
  EXPECT_THAT(client_.told, Each(StartsWith("V ")));
  EXPECT_EQ(mover_.look(trajectory).reason, "play_motion was called");
}

TEST_F(JointMoverTest, KnowsWhatMotionPlaysUntilTheRobotReportsItsEnd) {
  const JointMover::Fate motion = mover_.play("NOD.MTN", 1, seconds(1));
  ASSERT_THAT(mover_.state().movements, SizeIs(1));
  EXPECT_EQ(mover_.state().movements[0].name, "NOD.MTN");
  mover_.motionEnded({EndedKind::kMotion, EndedHow::kDone, "WAG.MTN", ""});
  mover_.motionEnded({EndedKind::kJam, EndedHow::kDone, "NOD.MTN", ""});
  EXPECT_FALSE(mover_.look(motion).end);
  mover_.motionEnded({EndedKind::kMotion, EndedHow::kReplaced, "NOD.MTN", "head_tilt was commanded"});
  EXPECT_EQ(mover_.look(motion).end, MovementEnd::kReplaced);
  EXPECT_EQ(mover_.look(motion).reason, "head_tilt was commanded");
  EXPECT_THAT(mover_.state().movements, IsEmpty());
  EXPECT_EQ(lastEnd(), MovementEnd::kReplaced);
}

TEST_F(JointMoverTest, AMotionMayEndBeforeTheCallReturns) {
  client_.while_playing = [this] { mover_.motionEnded({EndedKind::kMotion, EndedHow::kDone, "NOD.MTN", ""}); };
  const JointMover::Fate motion = mover_.play("NOD.MTN", 1, seconds(1));
  EXPECT_EQ(mover_.look(motion).end, MovementEnd::kDone);
}

TEST_F(JointMoverTest, AMotionThatIsRefusedDoesNotPlay) {
  client_.problem = "there is no such motion";
  EXPECT_THAT(refusal([this] { mover_.play("NOD.MTN", 1, seconds(1)); }), HasSubstr("no such motion"));
  EXPECT_THAT(mover_.state().movements, IsEmpty());
}

TEST_F(JointMoverTest, DoesNotKnowHowLongAMotionOfAnOlderServerPlays) {
  useVersion1();
  const JointMover::Fate motion = mover_.play("NOD.MTN", 1, seconds(1));
  EXPECT_EQ(mover_.look(motion).end, MovementEnd::kUnknown);
  EXPECT_THAT(mover_.state().movements, IsEmpty());
}

TEST_F(JointMoverTest, EndsMotionsWithTheConnection) {
  const JointMover::Fate motion = mover_.play("NOD.MTN", 1, seconds(1));
  mover_.disconnected();
  EXPECT_EQ(mover_.look(motion).end, MovementEnd::kStopped);
  EXPECT_THAT(mover_.state().movements, IsEmpty());
}

TEST_F(JointMoverTest, TellsWhenSomethingBeginsAndChanges) {
  int begun = 0;
  int changed = 0;
  mover_.setListener({[&] { ++changed; }, [&] { ++begun; }});
  commandPan(0.1);
  EXPECT_EQ(begun, 1);
  startPan(0.5, 1.0);
  EXPECT_EQ(begun, 2);
  changed = 0;
  mover_.hold("stop was called");
  EXPECT_GE(changed, 1);
}

}  // namespace
}  // namespace aibo_driver::node
