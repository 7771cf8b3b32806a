#include "walk/get_up.h"

#include <gtest/gtest.h>

namespace aibo_driver::walk {
namespace {

using aibo_client::EndedHow;
using aibo_client::MotorState;
using aibo_client::PostureNow;
using movement::Movement;

class GetUpTest : public ::testing::Test {
 protected:
  void end(EndedHow how, Movement::Kind kind = Movement::Kind::kWalk, const std::string& source = "/teleop") {
    movement::EndedMovement ended;
    ended.movement.kind = kind;
    ended.movement.source = source;
    ended.how = how;
    get_up_.ended(ended, now_);
  }

  void update(const aibo_client::MotorsAndPosture& state) { get_up_.update(state, overruled_); }

  void fall() {
    update({MotorState::kOn, PostureNow::kWalking});
    end(EndedHow::kFell);
    update({MotorState::kOn, PostureNow::kFallen});
    EXPECT_EQ(orders_, 0) << "it has not lain for a second";
  }

  void goSoft() { update({MotorState::kOff, PostureNow::kFallen}); }

  movement::SteadyTime now_{std::chrono::seconds(100)};
  movement::SteadyTime overruled_{std::chrono::seconds(99)};
  int orders_ = 0;
  GetUp get_up_{"/aibo/aibo_driver", [this] { ++orders_; }};
};

TEST_F(GetUpTest, AFallenRobotStandsUpOnceWhenItLiesStill) {
  fall();
  goSoft();
  EXPECT_EQ(orders_, 1);
  goSoft();
  EXPECT_EQ(orders_, 1);
  update({MotorState::kOn, PostureNow::kFallen});
  end(EndedHow::kFell, Movement::Kind::kPosture, "/aibo/aibo_driver");
  goSoft();
  EXPECT_EQ(orders_, 1) << "it did not manage";
}

TEST_F(GetUpTest, ARobotThatFellWhileItTookAUsersPostureStandsUp) {
  update({MotorState::kOn, PostureNow::kUnknown});
  end(EndedHow::kFell, Movement::Kind::kPosture);
  update({MotorState::kOn, PostureNow::kFallen});
  goSoft();
  EXPECT_EQ(orders_, 1);
}

TEST_F(GetUpTest, ARobotThatIsLiftedWaits) {
  update({MotorState::kOn, PostureNow::kWalking});
  end(EndedHow::kFell);
  update({MotorState::kOn, PostureNow::kCarried});
  update({MotorState::kOn, PostureNow::kFallen});
  goSoft();
  EXPECT_EQ(orders_, 0);
  update({MotorState::kOn, PostureNow::kCarried});
  end(EndedHow::kFell);
  goSoft();
  EXPECT_EQ(orders_, 0);
}

TEST_F(GetUpTest, ARobotThatIsPutOnItsFeetOrCannotBeReachedWaits) {
  for (const PostureNow posture :
       {PostureNow::kLying, PostureNow::kStanding, PostureNow::kSitting, PostureNow::kUnknown}) {
    fall();
    update({MotorState::kOn, posture});
    goSoft();
    EXPECT_EQ(orders_, 0);
  }
}

TEST_F(GetUpTest, ARobotThatIsLaidDownWithoutMovingItsLegsWaits) {
  update({MotorState::kOn, PostureNow::kStanding});
  end(EndedHow::kStopped);
  end(EndedHow::kFell, Movement::Kind::kCommand);
  update({MotorState::kOn, PostureNow::kFallen});
  goSoft();
  EXPECT_EQ(orders_, 0);
}

// The robot does not say whether a user or the robot itself has switched the motors off.
TEST_F(GetUpTest, ARobotWhoseMotorsAUserSwitchedOffSinceTheFallWaits) {
  fall();
  overruled_ = now_ + std::chrono::milliseconds(300);
  goSoft();
  EXPECT_EQ(orders_, 0);
  overruled_ = now_;
  now_ += std::chrono::seconds(10);
  fall();
  goSoft();
  EXPECT_EQ(orders_, 1) << "the order was about the fall before";
}

}  // namespace

}  // namespace aibo_driver::walk
