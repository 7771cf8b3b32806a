#include "node/walk/get_up.h"

#include <gtest/gtest.h>

namespace aibo_driver::node {

using aibo_client::EndedHow;
using aibo_client::MotorState;
using aibo_client::PostureNow;
using movement::Movement;

namespace {

class GetUpTest : public ::testing::Test {
 protected:
  void end(EndedHow how, Movement::Kind kind = Movement::Kind::kWalk, const std::string& source = "/teleop") {
    movement::EndedMovement ended;
    ended.movement.kind = kind;
    ended.movement.source = source;
    ended.how = how;
    get_up_.ended(ended);
  }

  void fall() {
    get_up_.update({MotorState::kOn, PostureNow::kWalking});
    end(EndedHow::kFell);
    get_up_.update({MotorState::kOn, PostureNow::kFallen});
    EXPECT_EQ(orders_, 0) << "it has not lain for a second";
  }

  void goSoft() { get_up_.update({MotorState::kOff, PostureNow::kFallen}); }

  int orders_ = 0;
  GetUp get_up_{"/aibo/aibo_driver", [this] { ++orders_; }};
};

TEST_F(GetUpTest, AFallenRobotStandsUpOnceWhenItLiesStill) {
  fall();
  goSoft();
  EXPECT_EQ(orders_, 1);
  goSoft();
  EXPECT_EQ(orders_, 1);
  get_up_.update({MotorState::kOn, PostureNow::kFallen});
  end(EndedHow::kFell, Movement::Kind::kPosture, "/aibo/aibo_driver");
  goSoft();
  EXPECT_EQ(orders_, 1) << "it did not manage";
}

TEST_F(GetUpTest, ItStandsUpAgainAfterTheNextFall) {
  fall();
  goSoft();
  get_up_.update({MotorState::kOn, PostureNow::kStanding});
  end(EndedHow::kDone, Movement::Kind::kPosture, "/aibo/aibo_driver");
  get_up_.update({MotorState::kOn, PostureNow::kUnknown});
  end(EndedHow::kFell, Movement::Kind::kPosture);
  get_up_.update({MotorState::kOn, PostureNow::kFallen});
  goSoft();
  EXPECT_EQ(orders_, 2);
}

TEST_F(GetUpTest, TheRobotMayTellOfItsPostureBeforeTheEnd) {
  get_up_.update({MotorState::kOn, PostureNow::kFallen});
  end(EndedHow::kFell);
  goSoft();
  EXPECT_EQ(orders_, 1);
}

TEST_F(GetUpTest, ARobotThatIsLiftedWaits) {
  get_up_.update({MotorState::kOn, PostureNow::kWalking});
  end(EndedHow::kFell);
  get_up_.update({MotorState::kOn, PostureNow::kCarried});
  get_up_.update({MotorState::kOn, PostureNow::kFallen});
  goSoft();
  EXPECT_EQ(orders_, 0);
  get_up_.update({MotorState::kOn, PostureNow::kCarried});
  end(EndedHow::kFell);
  goSoft();
  EXPECT_EQ(orders_, 0);
}

TEST_F(GetUpTest, ARobotThatIsPutOnItsFeetOrCannotBeReachedWaits) {
  for (const PostureNow posture : {PostureNow::kLying, PostureNow::kUnknown}) {
    fall();
    get_up_.update({MotorState::kOn, posture});
    goSoft();
    EXPECT_EQ(orders_, 0);
  }
}

TEST_F(GetUpTest, ARobotThatIsLaidDownWithoutMovingItsLegsWaits) {
  get_up_.update({MotorState::kOn, PostureNow::kStanding});
  end(EndedHow::kStopped);
  end(EndedHow::kFell, Movement::Kind::kCommand);
  get_up_.update({MotorState::kOn, PostureNow::kFallen});
  goSoft();
  EXPECT_EQ(orders_, 0);
}

TEST_F(GetUpTest, OtherMovementsDoNotKeepItDown) {
  fall();
  end(EndedHow::kDone, Movement::Kind::kLookAt);
  end(EndedHow::kRefused);  // somebody goes on to steer
  goSoft();
  EXPECT_EQ(orders_, 1);
}

}  // namespace

}  // namespace aibo_driver::node
