#include "rcserver/joints/JointPath.h"

#include <gmock/gmock.h>

#include <functional>
#include <vector>

namespace {

JointPath standingAt(int position, int step_limit, int acceleration) {
  JointPath motion;
  motion.LimitStep(step_limit);
  motion.LimitAcceleration(acceleration);
  motion.Place(position);
  return motion;
}

void advance(JointPath& motion, int frames = 1) {
  for (int i = 0; i < frames; ++i) {
    motion.Advance(motion.WantedStep());
  }
}

// The steps until the joint stands.
std::vector<int> stepsOf(JointPath& motion) {
  std::vector<int> steps;
  while (motion.FramesLeft() > 0 && steps.size() < 100000) {
    advance(motion);
    steps.push_back(motion.Step());
  }
  return steps;
}

struct Row {
  const char* what;
  int step_limit;
  int acceleration;
  int target;
  int frames;  // that pass before the order
  std::function<void(JointPath&)> order;
  std::vector<int> steps;  // until it stands
};

TEST(JointPath, ChangesItsSpeedByItsAccelerationAtMost) {
  const Row rows[] = {
      {"speeds up, cruises and brakes", 30, 10, 150, 0, [](JointPath&) {}, {10, 20, 30, 30, 30, 20, 10}},
      {"reverses", 30, 10, 960, 5, [](JointPath& m) { m.Aim(0); }, {20, 10, 0, -10, -20, -30, -30, -30, -20, -10}},
      {"returns to where it cannot stop", 30, 10, 960, 3, [](JointPath& m) { m.Aim(70); }, {20, 10, 0, -10, -10}},
      {"stops", 35, 10, 1170, 4, [](JointPath& m) { m.Stop(1); }, {25, 15, 5}},
      {"stops faster than its low acceleration", 35, 1, 10000, 40, [](JointPath& m) { m.Stop(10); }, {25, 15, 5}},
      {"brakes to a lower limit",
       30,
       10,
       150,
       3,
       [](JointPath& m) { m.LimitStep(5); },
       {20, 10, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5}},
      {"takes a lower acceleration when it stands",
       30,
       10,
       150,
       3,
       [](JointPath& m) { m.LimitAcceleration(1); },
       {30, 30, 20, 10}},
      {"takes a higher acceleration at the next target",
       30,
       1,
       960,
       1,
       [](JointPath& m) {
         m.LimitAcceleration(10);
         m.Aim(147);
       },
       {11, 21, 28, 28, 28, 20, 10}},
  };
  for (const Row& row : rows) {
    JointPath motion = standingAt(0, row.step_limit, row.acceleration);
    motion.Aim(row.target);
    advance(motion, row.frames);
    row.order(motion);
    EXPECT_EQ(stepsOf(motion), row.steps) << row.what;
  }
}

}  // namespace
