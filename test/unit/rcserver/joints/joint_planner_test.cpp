#include "rcserver/joints/JointPlanner.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr int kFramesPerSecond = 125;

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
}

int joint(const std::string& name) {
  return findJointByName(ers7(), name.c_str());
}

int microradians(double degrees) {
  return static_cast<int>(std::lround(degrees * 17453.2925));
}

std::vector<int> allJoints() {
  std::vector<int> joints;
  for (int i = 0; i < ers7().number_of_joints; ++i) {
    joints.push_back(i);
  }
  return joints;
}

bool isFollower(int joint) {
  const robot_model::Coupling* const couplings = ers7().couplings;
  return std::any_of(couplings, couplings + ers7().number_of_couplings,
                     [joint](const robot_model::Coupling& coupling) { return coupling.follower == joint; });
}

// The positions of all joints.
std::vector<int> postureOf(const JointPlanner& planner) {
  std::vector<int> posture;
  for (const int i : allJoints()) {
    posture.push_back(planner.Position(i));
  }
  return posture;
}

// Frames until all joints have arrived; at most `patience`.
int runUntilAllHaveArrived(JointPlanner& planner, int patience = 100000) {
  const std::vector<int> joints = allJoints();
  const auto moves = [&planner](int joint) { return planner.FramesLeft(joint) > 0; };
  int frames = 0;
  for (; frames < patience && std::any_of(joints.begin(), joints.end(), moves); ++frames) {
    planner.NextFrame();
  }
  return frames;
}

void run(JointPlanner& planner, int frames) {
  for (int i = 0; i < frames; ++i) {
    planner.NextFrame();
  }
}

struct JointTarget {
  int joint;
  int position;
};

// Sends joints to positions, which are replaced by those accepted.
void setTargets(JointPlanner& planner, std::vector<JointTarget>& targets, int duration) {
  for (const JointTarget& target : targets) {
    planner.Aim(target.joint, target.position);
  }
  planner.Go(duration);
  for (JointTarget& target : targets) {
    target.position = planner.Target(target.joint);
  }
}

// Returns the position accepted.
int setTarget(JointPlanner& planner, int joint, int position) {
  planner.Aim(joint, position);
  planner.Go(0);
  return planner.Target(joint);
}

// Random commands, which depend only on the seed.
class RandomClient {
 public:
  explicit RandomClient(unsigned seed) : random_(seed) {}

  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  // From slow to fast, each order of magnitude equally often.
  int magnitude(double low, double high) {
    return static_cast<int>(std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random_)));
  }

  // Somewhat more than the joint's range; for a follower, mostly where it depends on its leaders.
  int position(int joint) {
    const robot_model::Joint& limits = ers7().joints[joint];
    const bool low = isFollower(joint) && between(0, 3) > 0;
    return between(limits.mechanical_lowest, low ? microradians(6) : limits.mechanical_highest);
  }

  std::vector<JointTarget> targets() {
    std::vector<JointTarget> some = targetsForAll();
    std::shuffle(some.begin(), some.end(), random_);
    some.resize(static_cast<size_t>(between(1, static_cast<int>(some.size()))));
    return some;
  }

  std::vector<JointTarget> targetsForAll() {
    std::vector<JointTarget> targets;
    for (const int i : allJoints()) {
      targets.push_back({i, position(i)});
    }
    return targets;
  }

  void follow(JointPlanner& planner) {
    for (const JointTarget& target : targetsForAll()) {
      planner.Aim(target.joint, target.position);
    }
    planner.Follow();
  }

  void command(JointPlanner& planner) {
    const int joint = between(0, ers7().number_of_joints - 1);
    switch (between(0, 9)) {
      case 0:
        planner.SetSpeedLimit(joint, magnitude(10000, 20e6));
        break;
      case 1:
        planner.SetAccelerationLimit(joint, magnitude(100000, defaultAcceleration(ers7().joints[joint])));
        break;
      case 2:
        planner.Hold(joint);
        break;
      case 3:
        setTarget(planner, joint, position(joint));
        break;
      case 4:
        if (between(0, 9) == 0) {
          planner.HoldAll();
        }
        break;
      default: {
        std::vector<JointTarget> command = targets();
        setTargets(planner, command, between(0, 1) * between(0, 2000));
      }
    }
  }

 private:
  std::mt19937 random_;
};

// Lets frames pass and checks the guarantees of JointPlanner in each.
class Inspector {
 public:
  /// @param follows targets that move are given, so that joints may speed up faster
  Inspector(JointPlanner& planner, bool follows)
      : planner_(planner),
        posture_(postureOf(planner)),
        steps_(posture_.size(), 0),
        acceleration_(follows ? JointPlanner::FOLLOWING : 1) {}

  void nextFrame() {
    planner_.NextFrame();
    const std::vector<int> before = posture_;
    posture_ = postureOf(planner_);
    for (const int i : allJoints()) {
      SCOPED_TRACE(ers7().joints[i].name);
      const auto index = static_cast<size_t>(i);
      const int step = posture_[index] - before[index];
      EXPECT_GE(posture_[index], robot_model::lowestPosition(ers7(), i, posture_.data()));
      EXPECT_LE(posture_[index], ers7().joints[i].highest);
      const bool brakes = std::abs(step) < std::abs(steps_[index]);
      EXPECT_TRUE(brakes || std::abs(step) * kFramesPerSecond <= planner_.SpeedLimit(i)) << step;
      const int highest = robot_model::defaultAcceleration(ers7().joints[i]) * acceleration_;
      EXPECT_LE(std::abs(step - steps_[index]), highest / (kFramesPerSecond * kFramesPerSecond));
      steps_[index] = step;
    }
  }

 private:
  JointPlanner& planner_;
  std::vector<int> posture_;
  std::vector<int> steps_;
  const int acceleration_;  // a multiple of the default
};

TEST(JointPlanner, AcceptsPositionsAndLimitsWithinTheRobotsOwn) {
  JointPlanner planner(ers7());
  const int pan = joint("head_pan");
  EXPECT_EQ(setTarget(planner, pan, 100000), 100000);
  EXPECT_EQ(setTarget(planner, pan, 2000000000), microradians(88));
  EXPECT_EQ(setTarget(planner, pan, -2000000000), microradians(-88));
  EXPECT_EQ(planner.SetSpeedLimit(pan, 20000000), 10057460);
  EXPECT_EQ(planner.SetSpeedLimit(pan, 0), 125);
  EXPECT_EQ(planner.SetAccelerationLimit(pan, 2000000000), 1257182500);
  EXPECT_EQ(planner.SetAccelerationLimit(pan, -1), 15625);
}

TEST(JointPlanner, NeverExceedsALimitWhateverIsCommandedOrFollowed) {
  for (const bool follows : {false, true}) {
    JointPlanner planner(ers7());
    RandomClient client(1);
    Inspector inspector(planner, follows);
    for (int i = 0; i < 5000 && !HasFailure(); ++i) {
      SCOPED_TRACE("command " + std::to_string(i));
      client.command(planner);
      const bool follows_now = follows && client.between(0, 1) == 0;
      for (int frame = client.between(0, 1) * client.between(0, 30); frame > 0; --frame) {
        if (follows_now) {
          client.follow(planner);
        }
        inspector.nextFrame();
      }
    }
  }
}

TEST(JointPlanner, ArrivesExactlyWhateverWasCommandedBefore) {
  JointPlanner planner(ers7());
  RandomClient client(2);
  for (int i = 0; i < 200; ++i) {
    for (int command = 0; command < 20; ++command) {
      client.command(planner);
      run(planner, client.between(0, 10));
    }
    for (const int joint : allJoints()) {
      planner.SetSpeedLimit(joint, ers7().joints[joint].highest_speed);
      planner.SetAccelerationLimit(joint, defaultAcceleration(ers7().joints[joint]));
    }
    std::vector<JointTarget> targets = client.targetsForAll();
    setTargets(planner, targets, 0);
    // Within three seconds, every joint can wait for the whole way of another one.
    ASSERT_LE(runUntilAllHaveArrived(planner), 3 * kFramesPerSecond);
    for (const JointTarget& target : targets) {
      ASSERT_EQ(planner.Position(target.joint), target.position) << ers7().joints[target.joint].name;
    }
    const std::vector<int> there = postureOf(planner);
    run(planner, 3);
    ASSERT_EQ(postureOf(planner), there);
  }
}

TEST(JointPlanner, LetsJointsWithADurationArriveTogether) {
  JointPlanner planner(ers7());
  std::vector<JointTarget> targets = {{joint("head_pan"), 1000000},
                                      {joint("tail_pan"), -300000},
                                      {joint("left_front_knee"), 2000000},
                                      {joint("neck_tilt"), -100000}};
  setTargets(planner, targets, 1001);
  for (int frame = 1; frame < 126; ++frame) {
    planner.NextFrame();
    for (const JointTarget& target : targets) {
      ASSERT_NE(planner.Position(target.joint), target.position) << "frame " << frame;
    }
  }
  planner.NextFrame();
  for (const JointTarget& target : targets) {
    EXPECT_EQ(planner.Position(target.joint), target.position) << ers7().joints[target.joint].name;
  }
}

TEST(JointPlanner, FitsCoupledTargetsToEachOther) {
  struct Row {
    std::vector<std::pair<const char*, double>> wanted;  // in degrees, commanded together
    const char* follower;
    double accepted;
  };
  const Row rows[] = {
      {{{"left_front_rotator", -60}, {"left_front_elevator", -10}}, "left_front_elevator", -2},
      {{{"left_front_elevator", -10}, {"left_front_rotator", 100}}, "left_front_elevator", -2},
      {{{"right_hind_elevator", -10}, {"right_hind_rotator", 10}}, "right_hind_elevator", -10},
      {{{"head_tilt", -15}}, "head_tilt", -5},
      {{{"head_tilt", -15}, {"neck_tilt", -50}}, "head_tilt", 5},
      {{{"head_tilt", -15}, {"mouth", -50}}, "head_tilt", 5},
  };
  for (const Row& row : rows) {
    JointPlanner together(ers7());
    JointPlanner one_after_the_other(ers7());
    for (const auto& [name, degrees] : row.wanted) {
      together.Aim(joint(name), microradians(degrees));
      setTarget(one_after_the_other, joint(name), microradians(degrees));
    }
    together.Go(0);
    EXPECT_EQ(together.Target(joint(row.follower)), microradians(row.accepted)) << row.follower;
    EXPECT_EQ(one_after_the_other.Target(joint(row.follower)), microradians(row.accepted)) << row.follower;
  }
}

// How far a joint is below its lower limit.
int depth(const std::vector<int>& posture, int joint) {
  return std::max(0, robot_model::lowestPosition(ers7(), joint, posture.data()) - posture[static_cast<size_t>(joint)]);
}

TEST(JointPlanner, LeavesAForbiddenPostureWithoutGoingDeeper) {
  RandomClient client(8);
  for (int i = 0; i < 300; ++i) {
    JointPlanner planner(ers7());
    for (const int joint : allJoints()) {
      planner.SetPosition(joint, client.position(joint));
    }
    const std::vector<int> found = postureOf(planner);
    std::vector<JointTarget> targets = client.targetsForAll();
    setTargets(planner, targets, client.between(0, 1) * 500);
    for (int frame = 0; frame < 3 * kFramesPerSecond; ++frame) {
      planner.NextFrame();
      const std::vector<int> posture = postureOf(planner);
      for (const int joint : allJoints()) {
        ASSERT_LE(depth(posture, joint), depth(found, joint)) << ers7().joints[joint].name << ", frame " << frame;
      }
    }
    for (const int joint : allJoints()) {
      ASSERT_EQ(planner.Position(joint), planner.Target(joint)) << ers7().joints[joint].name;
    }
  }
}

void advance(JointPath& motion, int frames) {
  for (int i = 0; i < frames; ++i) {
    motion.Advance(motion.WantedStep());
  }
}

struct Path {
  const char* what;
  int step_limit;
  int acceleration;
  int target;
  int frames;  // that pass before the order
  std::function<void(JointPath&)> order;
  std::vector<int> steps;  // until it stands
};

TEST(JointPath, ChangesItsSpeedByItsAccelerationAtMost) {
  const Path rows[] = {
      {"speeds up, cruises and brakes", 30, 10, 150, 0, [](JointPath&) {}, {10, 20, 30, 30, 30, 20, 10}},
      {"reverses", 30, 10, 960, 5, [](JointPath& m) { m.Aim(0); }, {20, 10, 0, -10, -20, -30, -30, -30, -20, -10}},
      {"returns to where it cannot stop", 30, 10, 960, 3, [](JointPath& m) { m.Aim(70); }, {20, 10, 0, -10, -10}},
      {"stops", 35, 10, 1170, 4, [](JointPath& m) { m.Stop(1); }, {25, 15, 5}},
      {"stops faster than its low acceleration", 35, 1, 10000, 40, [](JointPath& m) { m.Stop(10); }, {25, 15, 5}},
      {"brakes to a lower limit", 30, 10, 120, 3, [](JointPath& m) { m.LimitStep(5); }, {20, 10, 5, 5, 5, 5, 5, 5}},
  };
  for (const Path& row : rows) {
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
