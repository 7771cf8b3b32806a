#include "node/walk/walk_commander.h"

#include <gmock/gmock.h>
#include <std_srvs/Trigger.h>

#include "node/services.h"
#include "support/fake_client.h"
#include "unit/driver/call_service.h"

namespace aibo_driver::node {
namespace {

using aibo_client::EndedHow;
using aibo_client::EndedKind;
using ::testing::ElementsAre;

class WalkCommanderTest : public ::testing::Test {
 protected:
  WalkCommanderTest() {
    client_.present.robot.capabilities = {"I", "S", "E"};
    client_.present.robot.walk_limits = {0.15, 0.1, 0.06, 1.2};
    aibo_client::Telemetry telemetry;
    telemetry.arrival = std::chrono::steady_clock::now();
    telemetry.joints = {{2, 0.0}, {11, 0.0}};
    measured_.update(telemetry);
    mover_.connected();
  }

  static movement::Order order(const std::string& source) { return {source, std::chrono::steady_clock::now()}; }

  movement::EndedMovement last() { return mover_.state().ended.back(); }

  void command(double forward, double left = 0, double turn = 0) {
    geometry_msgs::Twist twist;
    twist.linear.x = forward;
    twist.linear.y = left;
    twist.angular.z = turn;
    commander_.receive(twist, order("/teleop"));
  }

  // The velocities that were sent to the robot since the last call.
  std::vector<std::string> toldToWalk() {
    std::vector<std::string> told;
    for (const std::string& each : client_.told) {
      if (each.rfind("V ", 0) != 0) {
        told.push_back(each);
      }
    }
    client_.told.clear();
    return told;
  }

  // The robot accepts the velocity.
  void walk(double forward) {
    command(forward);
    mover_.steered({forward, 0, 0}, client_.order(), client_.order());
    toldToWalk();
  }

  // The robot ends the last order.
  void end(EndedKind kind, EndedHow how, const std::string& reason = "") {
    mover_.ended({kind, how, "", reason, client_.order()});
  }

  /// @param posture the name of its service
  std_srvs::Trigger::Response take(const std::string& posture) {
    return test_support::callService<std_srvs::Trigger>(postureServices(mover_), posture, {}, "/panel");
  }

  static walk::WalkSettings calibrated() {
    walk::WalkSettings settings;
    settings.scale = 1.25;
    settings.side_scale = 0.5;
    settings.turn_scale = 2;
    settings.timeout = std::chrono::milliseconds(400);
    return settings;
  }

  test_support::FakeClient client_;
  movement::JointTable table_{"ERS-7", 3.0};
  movement::MeasuredJoints measured_{table_};
  const walk::WalkSettings settings_ = calibrated();
  movement::Mover mover_{table_, measured_, client_, 0.5};
  WalkCommander commander_{settings_, client_, mover_};
};

TEST_F(WalkCommanderTest, SendsAVelocityWithinTheLimits) {
  command(0.3, 0, 0.5);
  EXPECT_THAT(toldToWalk(), ElementsAre("steer 0.00 0.00 0.00", "steer 0.15 0.00 0.16"));
  command(0.01, 0.02, -0.1);
  EXPECT_THAT(toldToWalk(), ElementsAre("steer 0.01 0.04 -0.05"));
}

TEST_F(WalkCommanderTest, RefusesWhatIsNotANumber) {
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    command(value);
    command(0, value);
    command(0, 0, -value);
    geometry_msgs::Twist twist;
    twist.linear.z = value;
    commander_.receive(twist, order("/teleop"));
    EXPECT_EQ(last().reason, "it has a value that is NaN or infinite. Without a good message the robot stops");
  }
  EXPECT_THAT(client_.told, testing::IsEmpty());
}

TEST_F(WalkCommanderTest, StopsWhenNothingCameForAWhile) {
  commander_.runOut();
  EXPECT_THAT(client_.told, testing::IsEmpty());
  walk(0.1);
  commander_.runOut();
  EXPECT_THAT(toldToWalk(), ElementsAre("steer 0.00 0.00 0.00"));
  end(EndedKind::kWalk, EndedHow::kDone);
  EXPECT_EQ(last().how, EndedHow::kStopped);
  EXPECT_EQ(last().reason, "no cmd_vel came for 0.4 s");
  walk(0.1);
  command(0);
  end(EndedKind::kWalk, EndedHow::kDone);
  EXPECT_EQ(last().how, EndedHow::kDone) << "that is over";
}

TEST_F(WalkCommanderTest, AnswersAPostureWhenItIsTaken) {
  client_.meanwhile = [this] {
    EXPECT_EQ(mover_.state().movements.at(0).kind, movement::Movement::Kind::kPosture);
    end(EndedKind::kPosture, EndedHow::kDone);
  };
  EXPECT_EQ(take("sit").message, "The robot sits.");
  EXPECT_THAT(toldToWalk(), ElementsAre("sit"));
  client_.meanwhile = [this] { end(EndedKind::kPosture, EndedHow::kDone); };
  EXPECT_TRUE(take("rest").success);
  EXPECT_THAT(toldToWalk(), ElementsAre("rest"));
  EXPECT_THAT(mover_.state().movements, testing::IsEmpty());
}

TEST_F(WalkCommanderTest, SaysWhyAPostureIsNotTaken) {
  client_.meanwhile = [this] { end(EndedKind::kPosture, EndedHow::kReplaced, "left_front_knee was commanded"); };
  auto response = take("stand");
  EXPECT_FALSE(response.success);
  EXPECT_EQ(response.message, "The robot does not stand: left_front_knee was commanded.");
  client_.meanwhile = [this] { mover_.disconnected(); };
  response = take("rest");
  EXPECT_FALSE(response.success);
  EXPECT_THAT(response.message, testing::HasSubstr("does not rest: the connection to the robot was lost"));
  client_.problem = "there is no robot";
  response = take("sit");
  EXPECT_FALSE(response.success);
  EXPECT_EQ(response.message, "The robot does not sit: there is no robot.");
  EXPECT_THAT(mover_.state().movements, testing::IsEmpty());
}

}  // namespace
}  // namespace aibo_driver::node
