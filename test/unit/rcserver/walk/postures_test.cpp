#include "rcserver/walk/Postures.h"

#include <gmock/gmock.h>

#include <array>
#include <vector>

#include "robot_model/robot_model.h"

namespace {

using protocol::version2::Posture;
using protocol::version2::POSTURE_REST;
using protocol::version2::POSTURE_SIT;
using protocol::version2::POSTURE_STAND;
using robot_model::Leg;
using robot_model::LegAngles;
using robot_model::Point;
using ::testing::ElementsAre;

constexpr double kDegree = 3.14159265358979323846 / 180;

using Legs = std::array<LegAngles, robot_model::NUMBER_OF_LEGS>;

class PosturesTest : public ::testing::Test {
 protected:
  Legs legs(Posture posture) const {
    Legs angles;
    std::copy(postures_.Legs(posture), postures_.Legs(posture) + angles.size(), angles.begin());
    return angles;
  }

  Legs between(Posture from, Posture to, double part) const {
    Legs angles = legs(from);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const LegAngles& end = postures_.Legs(to)[i];
      angles[i].rotator += (end.rotator - angles[i].rotator) * part;
      angles[i].elevator += (end.elevator - angles[i].elevator) * part;
      angles[i].knee += (end.knee - angles[i].knee) * part;
    }
    return angles;
  }

  std::vector<Postures::Stage> way(const Legs& here, Posture wanted, bool lies_down = false) const {
    std::vector<Postures::Stage> found(Postures::MAX_ROUTE);
    found.resize(static_cast<std::size_t>(postures_.FindRoute(here.data(), wanted, lies_down, found.data())));
    return found;
  }

  static std::vector<Postures::Stage> wayToBelly(FallWatch::Verdict verdict, int attempt) {
    std::vector<Postures::Stage> found(Postures::MAX_ROUTE);
    found.resize(static_cast<std::size_t>(Postures::FindRouteToBelly(verdict, attempt, found.data())));
    return found;
  }

  const Postures postures_{Gait()};
  const Legs straight_{};
  const Legs on_its_knees_ = {{{-90 * kDegree, 0, 120 * kDegree},
                               {90 * kDegree, 0, 120 * kDegree},
                               {-90 * kDegree, 0, 120 * kDegree},
                               {90 * kDegree, 0, 120 * kDegree}}};
};

TEST_F(PosturesTest, AreReachedThroughTheStandAndFromOthersByLyingDownFirst) {
  using P = Postures;
  const Legs sits = legs(POSTURE_SIT);
  const Legs rests = legs(POSTURE_REST);
  const Legs stands = legs(POSTURE_STAND);
  const struct {
    Legs here;
    Posture wanted;
    bool lies_down;
    std::vector<Postures::Stage> way;
  } rows[] = {
      {stands, POSTURE_SIT, false, {P::SIT}},
      {stands, POSTURE_REST, false, {P::REST}},
      {sits, POSTURE_STAND, false, {P::STAND}},
      {rests, POSTURE_STAND, false, {P::STAND}},
      {sits, POSTURE_REST, false, {P::STAND, P::REST}},
      {rests, POSTURE_SIT, false, {P::STAND, P::SIT}},
      {sits, POSTURE_SIT, false, {P::SIT}},
      {between(POSTURE_STAND, POSTURE_SIT, 0.8), POSTURE_REST, false, {P::STAND, P::REST}},
      {between(POSTURE_STAND, POSTURE_REST, 0.7), POSTURE_STAND, false, {P::STAND}},
      {between(POSTURE_STAND, POSTURE_REST, 0.7), POSTURE_REST, false, {P::REST}},
      {on_its_knees_, POSTURE_STAND, false, {P::SPREAD, P::FOLD, P::REST, P::STAND}},
      {on_its_knees_, POSTURE_SIT, false, {P::SPREAD, P::FOLD, P::REST, P::STAND, P::SIT}},
      {on_its_knees_, POSTURE_REST, false, {P::SPREAD, P::FOLD, P::REST}},
      {straight_, POSTURE_STAND, false, {P::STAND}},
      {straight_, POSTURE_STAND, true, {P::SPREAD, P::FOLD, P::REST, P::STAND}},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(way(row.here, row.wanted, row.lies_down), row.way) << &row - rows;
  }
  for (std::size_t leg = 0; leg < straight_.size(); ++leg) {
    Legs one_straight = rests;
    one_straight[leg] = straight_[leg];
    EXPECT_THAT(way(one_straight, POSTURE_REST), ElementsAre(P::SPREAD, P::FOLD, P::REST)) << leg;
  }
}

TEST_F(PosturesTest, ARobotThatLiesRollsOntoItsBelly) {
  EXPECT_THAT(wayToBelly(FallWatch::ON_LEFT_SIDE, 0), ElementsAre(Postures::REACH_LEFT, Postures::PUSH_LEFT));
  EXPECT_THAT(wayToBelly(FallWatch::ON_RIGHT_SIDE, 3), ElementsAre(Postures::REACH_RIGHT, Postures::PUSH_RIGHT));
  EXPECT_THAT(wayToBelly(FallWatch::UPSIDE_DOWN, 0), ElementsAre(Postures::TIP_RIGHT));
  EXPECT_THAT(wayToBelly(FallWatch::UPSIDE_DOWN, 1), ElementsAre(Postures::TIP_LEFT));
}

TEST_F(PosturesTest, CountAsTheStandWhileTheFeetAreUnderTheBody) {
  Legs walking;
  Gait gait;
  for (double phase = 0; phase < 1; phase += 0.05) {
    gait.FindPosture(phase, gait.Limited({0.2, 0, 0}), 1, walking.data());
    EXPECT_TRUE(postures_.Stands(walking.data())) << phase;
  }
  EXPECT_FALSE(postures_.Stands(legs(POSTURE_REST).data()));
  EXPECT_FALSE(postures_.Stands(legs(POSTURE_SIT).data()));
  EXPECT_FALSE(postures_.Stands(on_its_knees_.data()));
  for (const int leg : {0, 1, 2, 3}) {
    for (const double lift : {0.01, 0.045}) {
      Legs lifted = legs(POSTURE_STAND);
      const Leg which = static_cast<Leg>(leg);
      Point foot = findFoot(which, lifted[static_cast<std::size_t>(leg)]);
      foot.z += lift;
      lifted[static_cast<std::size_t>(leg)] = findLegAngles(which, foot);
      EXPECT_EQ(postures_.Stands(lifted.data()), lift < 0.03) << leg << " by " << lift;
    }
  }
}

}  // namespace
