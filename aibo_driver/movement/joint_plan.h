/// @file joint_plan.h
#ifndef AIBO_DRIVER_MOVEMENT_JOINT_PLAN_H
#define AIBO_DRIVER_MOVEMENT_JOINT_PLAN_H

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "movement/joint_link.h"
#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "movement/trajectory.h"

namespace aibo_driver::movement {

/// How a movement has ended.
enum class MovementEnd {
  kDone,      ///< it has arrived
  kReplaced,  ///< something else moves its joints now
  kStopped,   ///< somebody has stopped it
  kRefused,   ///< it could not go on
  kFell,      ///< the robot fell or was lifted
  kUnknown    ///< it was begun, and the robot does not say when it ends
};

/// What moves a robot, or has moved it.
struct Movement {
  enum class Kind { kCommand, kTrajectory, kMotion, kWalk, kPosture };

  Kind kind = Kind::kCommand;
  std::string name;                                          ///< of a motion or posture
  std::string source;                                        ///< who asked for it
  std::vector<std::string> joints;                           ///< unknown for what the robot does by itself
  std::optional<std::chrono::steady_clock::time_point> end;  ///< of a trajectory
};

/// A movement that is over.
struct EndedMovement {
  Movement movement;
  MovementEnd how = MovementEnd::kDone;
  std::string reason;  ///< in words that follow a colon; empty if it is done
};

/// What becomes of a movement that was begun.
struct MovementFate {
  std::optional<MovementEnd> end;
  std::string reason;  ///< why it ended, if not because it is done
  /// A newer trajectory moves some of its joints, and it goes on for the others.
  bool partly_replaced = false;
};

/// Orders that go to the robot together.
struct JointStep {
  JointOrders orders;
  std::chrono::milliseconds duration{0};
};

/// What is planned for the joints: commands that are on their way and trajectories, and with them the place where each
/// joint should be at a time.
///
/// Trajectories replace each other as in ros_control's joint_trajectory_controller with partial goals: a new one takes
/// over its joints at its start time, from the position and velocity that are planned for that time. Joints that it
/// does not name go on as before. Until its start time, everything goes on as before.
///
/// A command ends the trajectories that name one of its joints. It counts as under way for the time that its way takes
/// at its speed.
///
/// Every kPeriod the robot has to be told where the joints should be kLookahead later, to arrive by then. So the robot
/// always knows what comes next, and a message that is late by less than that does not make it falter. If the caller is
/// held up for longer than TrajectoryClock::kLongestGap, trajectories resume where they were.
///
/// It sends nothing and reads no clock. From one thread at a time.
class JointPlan {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  static constexpr std::chrono::milliseconds kPeriod{32};
  static constexpr std::chrono::milliseconds kLookahead{96};

  /// @param table, measured must outlive the plan
  /// @param slow_down as for Trajectory
  JointPlan(const JointTable& table, const MeasuredJoints& measured, bool slow_down)
      : table_(table), measured_(measured), slow_down_(slow_down), commands_(table.size()) {}

  /// Notes orders that are sent now.
  void command(const JointOrders& orders, const std::string& source, SteadyTime now);

  /// Plans a trajectory.
  /// @param start when it begins; if this is over, the points that are over are left out
  /// @param oldest how long ago its joints may have been measured
  /// @param[out] stretch as Trajectory::stretch()
  /// @return what becomes of it: changes only during calls of this object
  /// @throw InvalidArgumentException it is refused; the message says why
  std::shared_ptr<const MovementFate> add(const TrajectoryRequest& request, const std::string& source, SteadyTime start,
                                          SteadyTime now, std::chrono::milliseconds oldest, double* stretch);

  /// Moves everything on. To be called every kPeriod, and after add().
  /// @return what has to be sent now
  std::vector<JointStep> advance(SteadyTime now);

  /// The place of each joint that may be moving, as orders that make it stay there without turning back, for a robot
  /// that cannot be told to hold. On its way to a command's target, that is where it should be by now; in a trajectory,
  /// where it was last sent.
  /// @param only joints of this trajectory; null: all
  JointOrders holdingOrders(SteadyTime now, const MovementFate* only = nullptr) const;

  /// Ends everything.
  /// @param reason in words that follow a colon
  void endAll(MovementEnd how, const std::string& reason);

  /// Ends all trajectories, and leaves commands as they are.
  void endTrajectories(MovementEnd how, const std::string& reason);

  /// Ends the trajectories that move one of these joints, or will.
  void endTrajectoriesOf(const std::vector<std::string>& joints, MovementEnd how, const std::string& reason);

  /// Ends a trajectory, if it has not ended yet.
  void end(const MovementFate& trajectory, MovementEnd how, const std::string& reason);

  /// The identifiers of the joints that a trajectory moves; none before its beginning and after its end.
  std::vector<int> jointsOf(const MovementFate& trajectory) const;

  /// Where a trajectory wants its joints to be, in its own order of joints.
  /// @return empty before its beginning and after its end
  std::vector<Trajectory::Start> wantedBy(const MovementFate& trajectory, SteadyTime now) const;

  /// True if nothing moves or waits for its time to move.
  bool empty() const { return jobs_.empty() && !commanding_; }

  /// What moves the joints.
  std::vector<Movement> movements(SteadyTime now) const;

  /// What has ended since the last call, in order.
  std::vector<EndedMovement> takeEnded();

 private:
  struct Command {
    double from = 0;    // rad
    double target = 0;  // rad
    double speed = 0;   // rad/s
    SteadyTime begin;

    double duration() const;
    double positionAt(double time) const;
  };

  /// A trajectory that has taken over its joints.
  struct Run {
    Trajectory trajectory;
    TrajectoryClock clock;
    std::vector<bool> moves;   // by place in the request: false once something newer moves this joint
    std::vector<double> sent;  // where they were last sent, in rad; empty at first
    bool end_sent = false;
  };

  struct Job {
    TrajectoryRequest request;
    std::string source;
    SteadyTime start;
    std::chrono::milliseconds oldest{0};
    std::shared_ptr<MovementFate> fate;
    std::optional<Run> run;  // none while it waits for its time

    bool moves(std::size_t place) const { return !run || run->moves[place]; }
    std::optional<std::size_t> placeOf(const std::string& joint) const;
    std::vector<std::string> names() const;
  };

  std::optional<Trajectory::Start> stateOf(std::size_t joint, SteadyTime now, double ahead) const;
  static bool isUnderWay(const Command& command, SteadyTime now);
  static bool isRecent(const Command& command, SteadyTime now);
  Trajectory plan(const Job& job, SteadyTime now) const;
  void checkFresh(const Job& job, SteadyTime now) const;
  void takeFromWaiting(const Job& newer);
  void endThoseThatMove(std::size_t joint);
  void noteTaken(const Job& taken, const Job& rest);
  void beginDue(SteadyTime now);
  void handOver(SteadyTime now);
  void takeJoints(const Job& newer, Job* older);
  void takeCommands(const Job& newer, SteadyTime now);
  bool isSentByNewer(std::size_t index, const std::string& joint) const;
  JointStep next(std::size_t index, SteadyTime now);
  JointOrder orderFor(const std::string& joint, double position) const;
  void removeEnded();
  void noteEnd(const Job& job, MovementEnd how, const std::string& reason);
  void endCommands(MovementEnd how, const std::string& reason);
  Movement describe(const Job& job, SteadyTime now) const;
  Movement describeCommands(SteadyTime now) const;

  const JointTable& table_;
  const MeasuredJoints& measured_;
  const bool slow_down_;
  std::vector<std::optional<Command>> commands_;  // by index; the last one of each joint
  bool commanding_ = false;                       // one of them is under way, or its end has not been noted
  std::string commander_;                         // who gave the last one
  std::vector<Job> jobs_;                         // those that took over later come later
  std::vector<EndedMovement> ended_;
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_JOINT_PLAN_H
