#include "trial.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <random>

#include "rcserver/walk/Gait.h"

namespace physics {
namespace {

using Axes = Record::Axes;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kFrame = 0.008;
constexpr unsigned kFramesPerSecond = 125;
constexpr std::size_t kFirstJoint = 4;  ///< of the legs, in the robot's table
constexpr std::size_t kLegJoints = 12;

/// Until the robot has reached its speed; this time is not measured.
constexpr double kRunUp = 1.5;

constexpr double kFastestTrot = 0.2;  ///< m/s; GaitParameters::highest

/// What must hold.
constexpr double kSpeedError = 0.1;                 ///< of the commanded speed, or
constexpr Axes kSmallError = {0.005, 0.005, 0.06};  ///< this if it is more: m/s, m/s, radian/s
constexpr Axes kHighestDrift = {0.01, 0.01, 0.06};  ///< where nothing is commanded
constexpr double kLowestLift = 0.006;
constexpr double kHighestTilt = 0.26;  ///< 15 degrees
constexpr double kHighestCommandedSpeed = 0.97;
constexpr double kHighestShareAtFullDuty = 0.03;
constexpr double kFall = 0.785;  ///< 45 degrees
constexpr double kStandingTilt = 0.15;
constexpr double kLongestRise = 30;    ///< seconds
constexpr double kMotorsComeOn = 0.2;  ///< seconds; then joints are commanded to where they are

/// A speed of a joint that the floor may add to its limit: a foot that comes down is pushed.
constexpr double kHighestJointSpeed = 1.1;

/// Commanded less than this, in parts of a unit of its axis, is a drift rather than a walk.
constexpr Axes kLeastCommand = {0.01, 0.01, 0.1};

double headingOf(const Isometry3d& pose) {
  return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
}

/// How the body got from one pose to the next, in its own directions.
Axes wayBetween(const Isometry3d& from, const Isometry3d& to) {
  const double turn = std::remainder(headingOf(to) - headingOf(from), 2 * M_PI);
  const Vector3d way =
      Eigen::AngleAxisd(-headingOf(from) - turn / 2, Vector3d::UnitZ()) * (to.translation() - from.translation());
  return {way.x(), way.y(), turn};
}

/// The value that this share of all values does not exceed.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0;
  }
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

using LegJoints = std::array<double, kLegJoints>;

/// By how much each joint of the legs is commanded out of its limits or couplings.
LegJoints beyondLimits(const PhysicalErs7& robot) {
  std::array<int, robot_model::MAX_JOINTS> posture{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(robot.model().number_of_joints); ++i) {
    posture[i] = static_cast<int>(std::lround(robot.reference(i) * 1e6));
  }
  auto allowed = posture;
  robot_model::clampPosture(robot.model(), allowed.data());
  LegJoints beyond{};
  for (std::size_t i = 0; i < kLegJoints; ++i) {
    beyond[i] = std::abs(allowed[kFirstJoint + i] - posture[kFirstJoint + i]) * 1e-6;
  }
  return beyond;
}

class Recorder {
 public:
  explicit Recorder(Bench& bench) : bench_(bench), robot_(bench.robot()), last_(robot_.body()) {}

  /// A frame has passed.
  void add() {
    const Step& step = bench_.step();
    const Isometry3d body = robot_.body();
    const Axes way = wayBetween(last_, body);
    last_ = body;
    addWay(way, {step.velocity.forward, step.velocity.left, step.velocity.turn});
    addStep(step);
    for (std::size_t i = kFirstJoint; i < kFirstJoint + kLegJoints; ++i) {
      record_.highest_speed = std::max(record_.highest_speed, std::abs(robot_.jointSpeed(i)) / robot_.highestSpeed(i));
      if (frames_ > 0) {
        const double speed = std::abs(robot_.reference(i) - references_[i]) / kFrame;
        record_.commanded_speed = std::max(record_.commanded_speed, speed / robot_.highestSpeed(i));
      }
      references_[i] = robot_.reference(i);
      frames_at_full_duty_ += std::abs(robot_.duty(i)) >= 1 ? 1 : 0;
    }
    const LegJoints beyond = beyondLimits(robot_);
    record_.beyond_limits = std::max(record_.beyond_limits, *std::max_element(beyond.begin(), beyond.end()));
    frames_of_touches_ += robot_.legsTouch() ? 1 : 0;
    record_.highest_tilt = std::max(record_.highest_tilt, robot_.tilt());
    record_.fell = record_.fell || robot_.tilt() > kFall || robot_.bodyTouchesFloor();
    ++frames_;
  }

  Record result() {
    record_.seconds = static_cast<double>(frames_) * kFrame;
    for (std::size_t axis = 0; axis < Record::kAxes; ++axis) {
      record_.commanded[axis] /= record_.seconds;
      record_.walked[axis] /= record_.seconds;
      record_.gain[axis] = squares_[axis] > 0 ? products_[axis] / squares_[axis] : 0;
    }
    record_.usual_lift = quantile(lifts_, 0.05);
    record_.at_full_duty = static_cast<double>(frames_at_full_duty_) / (kLegJoints * frames_);
    record_.legs_touch = static_cast<double>(frames_of_touches_) / frames_;
    record_.ends = bench_.ends();
    record_.errors = bench_.errors();
    return record_;
  }

 private:
  void addWay(const Axes& way, const Axes& commanded) {
    for (std::size_t axis = 0; axis < Record::kAxes; ++axis) {
      record_.walked[axis] += way[axis];
      record_.commanded[axis] += commanded[axis] * kFrame;
      second_walked_[axis] += way[axis];
      second_commanded_[axis] += commanded[axis] * kFrame;
    }
    if (frames_ % kFramesPerSecond == kFramesPerSecond - 1) {
      for (std::size_t axis = 0; axis < Record::kAxes; ++axis) {
        products_[axis] += second_walked_[axis] * second_commanded_[axis];
        squares_[axis] += second_commanded_[axis] * second_commanded_[axis];
      }
      second_walked_ = second_commanded_ = {};
    }
  }

  // A step lasts from one beginning of the phase to the next. It counts if the robot walked all the time.
  void addStep(const Step& step) {
    const bool walks = step.state == protocol::version2::WALK_STATE_WALKS &&
                       (step.velocity.forward != 0 || step.velocity.left != 0 || step.velocity.turn != 0);
    if (!walks) {
      whole_steps_ = -1;
    } else if (step.phase < last_phase_) {
      ++whole_steps_;
      if (whole_steps_ > 1) {
        lifts_.insert(lifts_.end(), tops_.begin(), tops_.end());
      }
      tops_ = {};
    }
    last_phase_ = step.phase;
    for (std::size_t leg = 0; leg < tops_.size(); ++leg) {
      tops_[leg] = std::max(tops_[leg], robot_.soleHeight(static_cast<robot_model::Leg>(leg)));
    }
  }

  Bench& bench_;
  PhysicalErs7& robot_;
  Isometry3d last_;
  Record record_;
  unsigned frames_ = 0;
  std::size_t frames_at_full_duty_ = 0;
  unsigned frames_of_touches_ = 0;
  std::array<double, robot_model::MAX_JOINTS> references_ = {};
  Axes second_walked_ = {};
  Axes second_commanded_ = {};
  Axes products_ = {};
  Axes squares_ = {};
  double last_phase_ = 0;
  int whole_steps_ = -1;
  std::array<double, robot_model::NUMBER_OF_LEGS> tops_ = {};
  std::vector<double> lifts_;
};

/// Orders a limp robot to stand.
Rise standUp(Bench& bench) {
  PhysicalErs7& robot = bench.robot();
  Rise rise;
  std::array<unsigned, kLegJoints> frames_at_full_duty{};
  LegJoints before{};  // limp legs may have gone out of their limits, and must come back
  const std::size_t ends = bench.ends().size();
  const std::size_t errors = bench.errors().size();
  bench.take(protocol::version2::POSTURE_STAND);
  while (bench.ends().size() == ends && bench.errors().size() == errors && rise.seconds < kLongestRise) {
    bench.passFrame();
    rise.seconds += kFrame;
    for (std::size_t i = 0; i < kLegJoints; ++i) {
      unsigned& frames = frames_at_full_duty[i];
      frames = std::abs(robot.duty(kFirstJoint + i)) >= 1 ? frames + 1 : 0;
      rise.at_full_duty = std::max(rise.at_full_duty, frames * kFrame);
    }
    const LegJoints beyond = beyondLimits(robot);
    for (std::size_t i = 0; rise.seconds > kMotorsComeOn && i < kLegJoints; ++i) {
      rise.beyond_limits = std::max(rise.beyond_limits, beyond[i] - before[i]);
    }
    before = beyond;
  }
  pass(bench, 0.5);
  bool is_on_feet = robot.tilt() < kStandingTilt && !robot.bodyTouchesFloor();
  for (int leg = 0; leg < robot_model::NUMBER_OF_LEGS; ++leg) {
    is_on_feet = is_on_feet && robot.touchesFloor(static_cast<robot_model::Leg>(leg));
  }
  const bool is_done = bench.ends().size() > ends && bench.ends().back().how == protocol::version2::END_DONE;
  rise.stands = is_done && is_on_feet;
  rise.reason = bench.errors().size() > errors ? bench.errors().back()
                : bench.ends().size() == ends  ? "it does not end"
                : !is_done                     ? bench.ends().back().reason
                : !is_on_feet                  ? "it says that it stands"
                                               : "";
  return rise;
}

std::string percent(double part) {
  return std::to_string(std::lround(100 * part)) + " %";
}

}  // namespace

void pass(Bench& bench, double seconds) {
  for (double time = 0; time < seconds; time += kFrame) {
    bench.passFrame();
  }
}

Record walk(const World& world, const Commands& commands, double seconds) {
  Bench bench(world);
  for (double time = 0; time < kRunUp; time += kFrame) {
    bench.steer(commands(time));
    bench.passFrame();
  }
  for (double time = 0; bench.step().state != protocol::version2::WALK_STATE_WALKS && time < 5; time += kFrame) {
    bench.passFrame();  // it stands up first
  }
  Recorder recorder(bench);
  for (double time = kRunUp; time < kRunUp + seconds; time += kFrame) {
    bench.steer(commands(time));
    bench.passFrame();
    recorder.add();
  }
  return recorder.result();
}

Rise standUp(const World& world, Lying lying) {
  Bench bench(world);
  bench.take(protocol::version2::POSTURE_STAND);
  bench.awaitEnd(protocol::version2::ENDED_POSTURE, 10);
  bench.switchMotors(false);
  pass(bench, 0.1);
  const double turn = lying == Lying::kOnBack ? M_PI : lying == Lying::kOnLeftSide ? -M_PI / 2 : M_PI / 2;
  bench.robot().place({}, Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitX())));
  pass(bench, 2);
  return standUp(bench);
}

Rise standUpFromAnyPosture(const World& world, unsigned seed) {
  std::minstd_rand random(seed + 1);
  Bench bench(world);
  bench.switchMotors(false);
  pass(bench, 0.1);
  const robot_model::RobotModel& robot = bench.robot().model();
  std::array<int, robot_model::MAX_JOINTS> posture{};
  for (std::size_t i = kFirstJoint; i < kFirstJoint + kLegJoints; ++i) {
    const double part = static_cast<double>(random()) / std::minstd_rand::max();
    posture[i] = static_cast<int>(robot.joints[i].lowest + part * (robot.joints[i].highest - robot.joints[i].lowest));
  }
  robot_model::clampPosture(robot, posture.data());
  JointAngles angles;
  for (std::size_t i = kFirstJoint; i < kFirstJoint + kLegJoints; ++i) {
    angles[robot.joints[i].name] = posture[i] * 1e-6 * 180 / M_PI;
  }
  bench.robot().place(angles);
  pass(bench, 2);
  return standUp(bench);
}

Commands always(const Velocity& velocity) {
  return [velocity](double) { return velocity; };
}

std::vector<Direction> directionsWithin(const protocol::version2::WalkLimits& limits) {
  const auto [fastest, back, left, turn] = limits;
  const double forward = kFastestTrot;
  return {
      {"fast forward", {fastest, 0, 0}},
      {"forward", {forward, 0, 0}},
      {"back", {-back, 0, 0}},
      {"left", {0, left, 0}},
      {"right", {0, -left, 0}},
      {"turn left", {0, 0, turn}},
      {"turn right", {0, 0, -turn}},
      {"slowly forward", {forward / 3, 0, 0}},
      {"slowly back", {-back / 3, 0, 0}},
      {"slowly right", {0, -left / 2, 0}},
      {"forward and turn", {forward / 2, 0, turn / 2}},
      {"back and left", {-back / 2, left / 2, 0}},
      {"left and turn", {0, left / 2, -turn / 2}},
  };
}

protocol::version2::WalkLimits walkLimits() {
  const GaitParameters gait;
  return {gait.fastest, gait.highest.back, gait.highest.left, gait.highest.turn};
}

Commands randomly(const protocol::version2::WalkLimits& limits, unsigned seed) {
  struct State {
    std::minstd_rand random;
    double until = 0;
    Velocity velocity{};
  };
  const auto state = std::make_shared<State>();
  state->random.seed(seed + 1);
  // Not std::uniform_real_distribution, because its numbers differ between libraries.
  const auto between = [state](double low, double high) {
    return low + (high - low) * static_cast<double>(state->random()) / std::minstd_rand::max();
  };
  return [=](double time) {
    if (time >= state->until) {
      state->until = time + between(0.5, 3);
      const bool stands = between(0, 1) < 0.15;
      state->velocity = {between(-limits.back, limits.forward), between(-limits.left, limits.left),
                         between(-limits.turn, limits.turn)};
      state->velocity = stands ? Velocity() : state->velocity;
    }
    return state->velocity;
  };
}

std::vector<std::string> problemsOf(const Record& record, bool on_level_ground) {
  constexpr const char* kNames[] = {"forward", "sideways", "turning"};
  std::vector<std::string> problems;
  const auto expect = [&](bool good, const std::string& problem) {
    if (!good) {
      problems.push_back(problem);
    }
  };
  expect(!record.fell, "it fell");
  for (std::size_t axis = 0; on_level_ground && axis < Record::kAxes; ++axis) {
    const double drift = record.walked[axis] - record.commanded[axis];
    if (std::abs(record.commanded[axis]) < kLeastCommand[axis]) {
      expect(std::abs(drift) <= kHighestDrift[axis], std::string("it drifts ") + kNames[axis]);
    } else {
      const double allowed = std::max(kSpeedError, kSmallError[axis] / std::abs(record.commanded[axis]));
      expect(std::abs(record.gain[axis] - 1) <= allowed,
             std::string(kNames[axis]) + " has " + percent(record.gain[axis]) + " of the commanded speed");
    }
  }
  expect(record.usual_lift >= kLowestLift, "feet are lifted too little");
  expect(record.highest_tilt <= kHighestTilt, "it tilts");
  expect(record.highest_speed <= kHighestJointSpeed,
         "a joint moves at " + percent(record.highest_speed) + " of its limit");
  expect(record.commanded_speed <= kHighestCommandedSpeed,
         "a joint is told to move at " + percent(record.commanded_speed) + " of its limit");
  expect(record.legs_touch == 0, "legs touch each other in " + percent(record.legs_touch) + " of the frames");
  expect(record.at_full_duty <= kHighestShareAtFullDuty,
         "motors have full duty in " + percent(record.at_full_duty) + " of the frames");
  expect(record.beyond_limits == 0, "a joint is commanded beyond its limits");
  for (const std::string& error : record.errors) {
    problems.push_back("the robot says: " + error);
  }
  return problems;
}

void printHeader(std::ostream& out) {
  out << "                         forward mm/s  sideways mm/s   turn rad/s  tilt  lift  joint   full\n"
         "                          said    is    said    is   said    is   deg    mm  speed   duty\n";
}

void print(const std::string& name, const Record& record, std::ostream& out, bool on_level_ground) {
  out << std::fixed << std::left << std::setw(24) << name << std::right << std::setprecision(0);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    out << std::setw(7) << 1000 * record.commanded[axis] << std::setw(6) << 1000 * record.walked[axis] << ' ';
  }
  out << std::setprecision(2) << std::setw(7) << record.commanded[2] << std::setw(6) << record.walked[2]
      << std::setprecision(1) << std::setw(6) << record.highest_tilt * 180 / M_PI << std::setw(6)
      << 1000 * record.usual_lift << std::setprecision(2) << std::setw(7) << record.highest_speed
      << std::setprecision(3) << std::setw(7) << record.at_full_duty;
  std::string separator = "  ";
  for (const std::string& problem : problemsOf(record, on_level_ground)) {
    out << separator << problem;
    separator = "; ";
  }
  out << '\n';
}

}  // namespace physics
