#include "remote_control/ended_movements.h"

#include <gmock/gmock.h>

namespace aibo_driver::remote_control {
namespace {

std::vector<EndedMovement> ended(const std::string& letters) {
  std::vector<EndedMovement> all;
  for (const char letter : letters) {
    all.emplace_back().reason = letter;
  }
  return all;
}

TEST(EndedMovements, AreNewIfTheMessageBeforeDidNotHaveThem) {
  EXPECT_EQ(endedBetween(ended(""), ended("ab")), ended("ab"));
  EXPECT_EQ(endedBetween(ended("ab"), ended("ab")), ended(""));
  EXPECT_EQ(endedBetween(ended("ab"), ended("abc")), ended("c"));
  EXPECT_EQ(endedBetween(ended("abcdefgh"), ended("bcdefghi")), ended("i")) << "the oldest is left out";
  EXPECT_EQ(endedBetween(ended("aab"), ended("aaba")), ended("a"));
  EXPECT_EQ(endedBetween(ended("ab"), ended("bcd")), ended("cd")) << "only the newest is still there";
  EXPECT_EQ(endedBetween(ended("abc"), ended("ab")), ended("ab")) << "another driver with fewer of them";
  EXPECT_EQ(endedBetween(ended("ab"), ended("xy")), ended("xy")) << "another driver";
}

TEST(EndedMovements, AreToldIfTheyDidNotArriveAndNobodyWantedThat) {
  EndedMovement each;
  each.movement.kind = Movement::COMMAND;
  each.reason = "the motors are off";
  each.how = EndedMovement::REFUSED;
  EXPECT_EQ(complaintAbout(each), "joints: the motors are off");
  for (const auto& [kind, name] : {std::pair<int, const char*>(Movement::TRAJECTORY, "trajectory"),
                                   {Movement::WALK, "walk"},
                                   {Movement::LOOK_AT, "look there"}}) {
    each.movement.kind = static_cast<std::uint8_t>(kind);
    EXPECT_EQ(complaintAbout(each), name + QString(": the motors are off"));
  }
  each.movement.kind = Movement::MOTION;
  each.movement.name = "NOD.MTN";
  each.how = EndedMovement::NOT_REACHED;
  EXPECT_EQ(complaintAbout(each), "NOD.MTN: the motors are off");
  for (const auto how : {EndedMovement::DONE, EndedMovement::REPLACED, EndedMovement::STOPPED}) {
    each.how = how;
    EXPECT_EQ(complaintAbout(each), "");
  }
}

}  // namespace
}  // namespace aibo_driver::remote_control
