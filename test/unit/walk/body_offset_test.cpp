#include "walk/body_offset.h"

#include <gmock/gmock.h>

#include "rcserver/walk/Gait.h"
#include "rcserver/walk/Postures.h"

namespace aibo_driver::walk {
namespace {

const movement::JointTable kErs7{"ERS-7", movement::kUsualSpeedLimit};

struct RobotsStand {
  RobotsStand() { gait.FindPosture(0, {0, 0, 0}, 0, legs.data()); }

  // A height, roll and pitch of the body above the floor on which the feet stand.
  Eigen::Isometry3d bodyAt(const BodyOffset& offset) const {
    const StepParameters& step = gait.Parameters().in_place;
    return Eigen::Translation3d(0, 0, step.height + offset.height) *
           Eigen::AngleAxisd(step.nose_down + offset.pitch, Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(offset.roll, Eigen::Vector3d::UnitX());
  }

  const Gait gait;
  const Postures postures{gait};
  std::array<LegAngles, kLegs> legs;
};

struct BodyOffsetRow {
  const char* name;
  BodyOffset wanted;
  BodyOffset possible;
  const char* limit;
};

const std::vector<BodyOffsetRow> kBodyOffsets = {
    {"stand", {0, 0, 0}, {0, 0, 0}, ""},
    {"higher", {0.02, 0, 0}, {0.02, 0, 0}, ""},
    {"lower", {-0.02, 0, 0}, {-0.02, 0, 0}, ""},
    {"right side down", {0, 0.1, 0}, {0, 0.1, 0}, ""},
    {"left side down", {0, -0.1, 0}, {0, -0.1, 0}, ""},
    {"nose down", {0, 0, 0.15}, {0, 0, 0.15}, ""},
    {"nose up", {0, 0, -0.12}, {0, 0, -0.12}, ""},
    {"all", {0.01, 0.05, -0.05}, {0.01, 0.05, -0.05}, ""},
    {"too high", {0.1, 0, 0}, {0.02695, 0, 0}, "the legs are too short"},
    {"too low", {-0.1, 0, 0}, {-0.02363, 0, 0}, "left_hind_knee is at its limit"},
    {"too far to the right", {0, 0.5, 0}, {0, 0.13023, 0}, "the robot would not stand any more"},
    {"too far down", {0, 0, 0.5}, {0, 0, 0.18978}, "the robot would not stand any more"},
    {"too far up", {0, 0, -0.5}, {0, 0, -0.15038}, "the robot would not stand any more"},
    {"upside down", {0, 3.1, 0}, {0, 0.13023, 0}, "the robot would not stand any more"},
    {"lower and nose up, the same part of both",
     {-0.2, 0, -1},
     {-0.01783, 0, -0.08916},
     "left_hind_knee is at its limit"},
    {"huge", {1e300, 0, 0}, {0, 0, 0}, "the legs are too short"},
};

TEST(BodyOffset, MovesTheBodyAsFarAsPossibleAndTheFeetStayOnTheFloor) {
  for (const BodyOffsetRow& row : kBodyOffsets) {
    const RobotsStand stand;
    const OffsetLegs found = findLegs(row.wanted, kErs7);
    EXPECT_EQ(found.limit, row.limit) << row.name;
    for (std::size_t i = 0; i < kLegs; ++i) {
      const Leg leg = static_cast<Leg>(i);
      const Eigen::Vector3d foot = stand.bodyAt(row.possible) * footOf(leg, found.angles[i]);
      const Eigen::Vector3d before = stand.bodyAt({}) * footOf(leg, stand.legs[i]);
      EXPECT_LT((foot - before).norm(), 5e-5) << row.name << ", leg " << i;
    }
    EXPECT_TRUE(stand.postures.Stands(found.angles.data())) << row.name << ": the robot says that it stands";
  }
}

}  // namespace
}  // namespace aibo_driver::walk
