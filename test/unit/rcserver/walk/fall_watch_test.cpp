// When a robot counts as fallen or carried: docs/protocol.md, "Walking and postures".
#include "rcserver/walk/FallWatch.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace {

constexpr double kGravity = 9.80665;
constexpr double kDegree = 3.14159265358979323846 / 180;

FallWatch::Reading rolledBy(double degrees, bool paws = true) {
  return {0, kGravity * std::sin(degrees * kDegree), kGravity * std::cos(degrees * kDegree), {paws, paws, paws, paws}};
}

FallWatch::Reading pitchedBy(double degrees) {
  return {kGravity * std::sin(degrees * kDegree), 0, kGravity * std::cos(degrees * kDegree), {}};
}

struct Felt {
  FallWatch::Reading reading;
  unsigned frames;
  bool stands = true;
};

TEST(FallWatch, TellsHowTheRobotIsFromItsAccelerometerAndItsPaws) {
  const FallWatch::Reading two_paws = {0, 0, kGravity, {false, false, true, true}};
  const FallWatch::Reading three_paws = {0, 0, kGravity, {false, true, true, true}};
  const struct {
    const char* what;
    std::vector<Felt> felt;
    int times;
    FallWatch::Verdict verdict;
  } rows[] = {
      {"it sits", {{pitchedBy(25), 500}}, 1, FallWatch::UPRIGHT},
      {"it stands on a slope", {{rolledBy(-55), 500}}, 1, FallWatch::UPRIGHT},
      {"on its left side", {{rolledBy(-80), 80}}, 1, FallWatch::ON_LEFT_SIDE},
      {"on its right side", {{rolledBy(80), 80}}, 1, FallWatch::ON_RIGHT_SIDE},
      {"on its nose", {{pitchedBy(-80), 80}}, 1, FallWatch::ON_RIGHT_SIDE},
      {"on its tail", {{pitchedBy(65), 80}}, 1, FallWatch::ON_RIGHT_SIDE},
      {"on its back", {{rolledBy(170), 80}}, 1, FallWatch::UPSIDE_DOWN},
      {"on its back and its legs", {{rolledBy(140), 80}}, 1, FallWatch::ON_RIGHT_SIDE},
      {"upright again", {{rolledBy(80), 80}, {rolledBy(0), 80}}, 1, FallWatch::UPRIGHT},
      {"knocked twice", {{rolledBy(90), 46}, {rolledBy(0), 20}}, 2, FallWatch::UPRIGHT},
      {"it lies, and its legs shake it", {{rolledBy(100), 4}, {rolledBy(45), 4}}, 10, FallWatch::ON_RIGHT_SIDE},
      {"it tumbles", {{rolledBy(90), 20}, {rolledBy(180), 20}}, 4, FallWatch::UPSIDE_DOWN},
      {"no accelerometer", {{{0.5, -1, -0.5, {true, true, true, true}}, 500}}, 1, FallWatch::UPRIGHT},
      {"lifted", {{rolledBy(0), 20}, {rolledBy(0, false), 60}}, 1, FallWatch::CARRIED},
      {"lifted after it stood on three paws", {{three_paws, 20}, {rolledBy(0, false), 60}}, 1, FallWatch::CARRIED},
      {"set down", {{rolledBy(0), 20}, {rolledBy(0, false), 60}, {rolledBy(0), 60}}, 1, FallWatch::UPRIGHT},
      {"it walks", {{rolledBy(0), 4}, {rolledBy(0, false), 46}}, 10, FallWatch::UPRIGHT},
      {"hung up before its paws have touched anything", {{rolledBy(0, false), 500}}, 1, FallWatch::UPRIGHT},
      {"on its shanks", {{two_paws, 100}, {rolledBy(0, false), 500}}, 1, FallWatch::UPRIGHT},
      {"on its belly", {{rolledBy(0), 20}, {rolledBy(0, false), 500, false}}, 1, FallWatch::UPRIGHT},
  };
  for (const auto& row : rows) {
    FallWatch watch;
    unsigned frame = 0;
    for (int i = 0; i < row.times; ++i) {
      for (const Felt& felt : row.felt) {
        for (const unsigned end = frame + felt.frames; frame < end;) {
          watch.Look(felt.reading, felt.stands, frame += 4);  // a report every 4 frames
        }
      }
    }
    EXPECT_EQ(watch.Now(), row.verdict) << row.what;
  }
}

}  // namespace
