/// @file joint_plan.h
#ifndef AIBO_DRIVER_MOVEMENT_JOINT_PLAN_H
#define AIBO_DRIVER_MOVEMENT_JOINT_PLAN_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "movement/movement.h"
#include "movement/trajectory.h"

namespace aibo_driver::movement {

using aibo_client::EndedHow;

/// The number of a movement. No two movements have the same number.
using MovementId = std::uint64_t;

/// How near a joint has to be to its target to have arrived.
struct Tolerance {
  double position = 0.05;         ///< rad
  std::optional<double> speed{};  ///< rad/s; empty means any speed
};

/// When the joints of a trajectory count as arrived.
struct Arrival {
  bool is_measured = false;  ///< true: the plan measures whether they have arrived; false: the robot says so
  std::map<std::string, Tolerance> tolerances;  ///< only of joints whose tolerance is not the usual one
  std::chrono::milliseconds grace{2000};        ///< how late the joints may be
};

/// Targets that go to the robot together.
struct JointStep {
  MovementId movement = 0;
  JointTargets targets;
  std::chrono::milliseconds duration{0};
};

/// The plan for the joints. It contains trajectories, and the latest command to each joint. From these it computes
/// where each joint should be at a time.
///
/// docs/ros_interface.md ("Trajectories") says how trajectories follow each other, and how many may wait.
///
/// A trajectory stays in the plan until forget(), unless the plan ends it: if it cannot begin, or if a newer one has
/// replaced it. A trajectory whose arrival is measured is done when all its joints have been measured at their targets,
/// after the planned time. If a joint has not arrived after the grace time, the trajectory ends as not reached. If a
/// joint is not measured any more, the end is unknown.
///
/// Every kPeriod the robot is told where the joints should be kLookahead later. So the robot always knows what comes
/// next, and a message that is late by less than kLookahead does not make it falter. If the caller stalls for longer
/// than kLongestGap, the joints have stopped meanwhile, and would have to jump to catch up. So the trajectories then
/// resume where they were.
///
/// The plan sends nothing and reads no clock. Only one thread at a time may use it.
class JointPlan {
 public:
  static constexpr std::chrono::milliseconds kPeriod{32};
  static constexpr std::chrono::milliseconds kLookahead{96};
  static constexpr std::size_t kMostWaiting = 32;
  static constexpr std::size_t kMostWaitingForJoint = 2;
  static constexpr std::chrono::milliseconds kLongestGap{200};

  /// How the plan has ended a trajectory.
  struct End {
    MovementId id = 0;
    EndedHow how = EndedHow::kDone;
    std::string reason;  ///< the same as EndedMovement::reason
  };

  /// @param table, measured must outlive the plan
  JointPlan(const JointTable& table, const MeasuredJoints& measured)
      : table_(table), measured_(measured), commands_(table.size()) {}

  /// Notes targets that are being sent now.
  /// @param id the movement
  void command(MovementId id, const JointTargets& targets, SteadyTime now);

  /// Plans a trajectory.
  /// @param start when it begins; if this time has passed, the points that have passed are left out
  /// @param oldest how old the measurements of its joints may be
  /// @throw InvalidArgumentException the trajectory is refused; the message says why
  void add(MovementId id, const TrajectoryRequest& request, const Arrival& arrival, SteadyTime start, SteadyTime now,
           std::chrono::milliseconds oldest);

  /// Advances everything to the present time. Call this every kPeriod, and after add().
  /// @return what has to be sent now
  std::vector<JointStep> advance(SteadyTime now);

  /// Targets that make each joint that may be moving stay where it is, without turning back. They are for a robot whose
  /// server has no request to hold. A joint of a command stays where it should be by now. A joint of a trajectory stays
  /// where it was last sent.
  /// @param only the joints of this trajectory; empty means all joints
  JointTargets holdingTargets(SteadyTime now, std::optional<MovementId> only = std::nullopt) const;

  /// Forgets a trajectory, or the commands of a movement, because their joints are not on their way any more.
  void forget(MovementId id);

  /// Forgets the commands to these joints, because something else moves them.
  void forget(const std::vector<std::string>& joints);

  /// The joints that a command still moves, or those of a trajectory. There are none if it has ended.
  std::vector<std::string> jointsOf(MovementId id) const;

  /// When a trajectory will be over. It is empty before the trajectory's beginning.
  std::optional<SteadyTime> endOf(MovementId trajectory) const;

  /// Where a trajectory wants its joints to be, in its own order of joints.
  /// @return empty before the trajectory's beginning and after its end
  std::vector<Trajectory::Start> wantedBy(MovementId trajectory, SteadyTime now) const;

  /// True if a trajectory goes on after one of its orders has ended in this way: if steps are left, or if the plan
  /// measures its arrival.
  bool goesOnAfter(MovementId trajectory, EndedHow how) const;

  /// True if there is no trajectory.
  bool empty() const { return jobs_.empty(); }

  /// Returns the trajectories that have ended since the last call, in order.
  std::vector<End> takeEnded() { return std::exchange(ended_, {}); }

 private:
  struct Command {
    MovementId id = 0;
    double from = 0;    // rad
    double target = 0;  // rad
    double speed = 0;   // rad/s
    SteadyTime begin;

    double duration() const;
    double positionAt(double time) const;
  };

  /// A trajectory that moves its joints.
  struct Run {
    Trajectory trajectory;
    std::vector<Trajectory::Start> sent;  // where the joints were last sent; advance() sets it at once
    bool end_sent = false;
    std::optional<SteadyTime> over;  // when its joints should be where they were sent
  };

  struct Job {
    MovementId id = 0;
    TrajectoryRequest request;
    Arrival arrival;
    SteadyTime start;
    std::chrono::milliseconds oldest{0};
    std::optional<Run> run;  // empty while the trajectory waits for its time
    bool has_ended = false;

    bool moves(const std::string& joint) const;
    bool sharesJointWith(const Job& other) const;
    bool replaces(const Job& waiting) const;
  };

  double timeOf(const Job& job, SteadyTime now) const;
  std::optional<Trajectory::Start> stateOf(std::size_t joint, SteadyTime now, double ahead) const;
  static bool isUnderWay(const Command& command, SteadyTime now, double delay);
  const Job* find(MovementId trajectory) const;
  Trajectory plan(const Job& job, SteadyTime now) const;
  void checkWaiting(const Job& newer) const;
  void resume(SteadyTime now);
  void begin(Job* job, SteadyTime now);
  JointTargets targetsOf(const Job& job) const;
  JointStep next(Job* job, SteadyTime now);
  void judge(Job* job, SteadyTime now);
  void removeEnded();
  void noteEnd(Job* job, EndedHow how, const std::string& reason);

  const JointTable& table_;
  const MeasuredJoints& measured_;
  std::vector<std::optional<Command>> commands_;  // the last command to each joint; the joint's index is the position
  std::vector<Job> jobs_;
  SteadyTime advanced_;  // when jobs were last advanced
  std::vector<End> ended_;
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_JOINT_PLAN_H
