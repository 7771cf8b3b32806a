#include "rcserver/joints/JointPath.h"

#include <gmock/gmock.h>

#include <functional>
#include <vector>

namespace {

void advance(JointPath& motion, int frames) {
  for (int i = 0; i < frames; ++i) {
    motion.Advance(motion.WantedStep());
  }
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
    JointPath motion;
    motion.LimitStep(row.step_limit);
    motion.LimitAcceleration(row.acceleration);
    motion.Place(0);
    motion.Aim(row.target);
    advance(motion, row.frames);
    row.order(motion);
    std::vector<int> steps;
    while (motion.FramesLeft() > 0 && steps.size() < 1000) {
      advance(motion, 1);
      steps.push_back(motion.Step());
    }
    EXPECT_EQ(steps, row.steps) << row.what;
  }
}

}  // namespace
