/// @file joint_mover.h
#ifndef AIBO_DRIVER_ROS_JOINTS_JOINT_MOVER_H
#define AIBO_DRIVER_ROS_JOINTS_JOINT_MOVER_H

#include <ros/console.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aibo_driver/motion_end.h"
#include "aibo_driver/rcserver_client.h"
#include "movement/joint_command_filter.h"
#include "movement/joint_link.h"
#include "movement/joint_plan.h"
#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "ros/driver_parameters.h"
#include "ros/throttled_warnings.h"

namespace aibo_driver::node {

/// Everything that moves the robot: commands to joints, trajectories, the robot's own motions and postures, and
/// walking. It sends them, knows what moves at the moment, and stops it. How each movement ends is logged.
///
/// Every member function may be called from any thread. Those that wait for the robot have a timeout; meanwhile the
/// others go on. Nothing is kept while there is no connection, and nothing goes on over another one.
///
/// After a stop, nothing that was asked for before it moves the robot: see epoch() and block().
class JointMover {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;
  using Fate = std::shared_ptr<const movement::MovementFate>;

  /// How long it waits for the robot to hold.
  static constexpr std::chrono::milliseconds kHoldTimeout{2000};
  /// A trajectory begins only if its joints were measured this lately.
  static constexpr std::chrono::milliseconds kFresh{300};
  /// The same with a version 1 server, which reports one joint after the other, each about once a second.
  static constexpr std::chrono::milliseconds kFreshVersion1{2000};

  struct State {
    std::vector<movement::Movement> movements;    ///< now
    std::optional<movement::EndedMovement> last;  ///< the last one that ended
  };

  /// What it tells others, on the thread of the call that caused it, and without a lock.
  struct Listener {
    std::function<void()> on_change;  ///< state() may have changed
    std::function<void()> on_begin;   ///< goOn() has to be called from now on
  };

  /// @param table, measured, client must outlive the mover
  /// @param telemetry_wanted false if the robot is not asked to report its joints
  JointMover(const movement::JointTable& table, const movement::MeasuredJoints& measured, RcServerClient& client,
             const DriverParameters& parameters, std::function<bool()> telemetry_wanted);

  JointMover(const JointMover&) = delete;
  JointMover& operator=(const JointMover&) = delete;

  /// To be called before anything moves.
  void setListener(Listener listener) { listener_ = std::move(listener); }

  /// Changes when something is stopped, and with each connection. What was asked for in another epoch must not be sent.
  std::uint64_t epoch() const;

  /// Sends joints to positions, through the JointCommandFilter. What is not sent is logged.
  /// @param names, positions, velocities as in sensor_msgs/JointState
  /// @param source who asks
  /// @param epoch in which it was asked for
  void command(const std::vector<std::string>& names, const std::vector<double>& positions,
               const std::vector<double>& velocities, const std::string& source, std::uint64_t epoch);

  /// Begins a trajectory. See JointPlan for how trajectories follow each other.
  /// @param wait until it begins; below 0 if it should have begun before
  /// @return what becomes of it, for look()
  /// @throw InvalidArgumentException it is refused; the message says why
  Fate start(const movement::TrajectoryRequest& request, std::chrono::nanoseconds wait, const std::string& source);

  /// Moves everything on. To be called every JointPlan::kPeriod from Listener::on_begin on.
  /// @return false if there is nothing to move on any more
  bool goOn();

  /// What has become of a movement so far.
  movement::MovementFate look(const Fate& movement) const;

  /// Where a trajectory wants its joints to be at a time, now or shortly before, in its own order of joints; empty
  /// before its beginning and after its end.
  std::vector<movement::Trajectory::Start> wantedBy(const Fate& trajectory, SteadyTime time) const;

  /// Ends a trajectory, and holds its joints.
  /// @throw as hold()
  void cancel(const Fate& trajectory, const std::string& reason);

  /// Ends everything that moves the robot, and holds all joints where they should be by now.
  /// @param reason for the log and the state
  /// @throw NetworkException, TimeoutException, StoppedException the robot could not be told: everything has ended here
  void hold(const std::string& reason);

  /// Plays a motion of the robot's own, at speeds up to the limits of all joints. Ends the trajectories.
  /// @param[out] changes if not null: what RcServerClient::playMotion() returns
  /// @return what becomes of it, for look()
  /// @throw as RcServerClient::playMotion()
  Fate play(const std::string& name, int repetitions, std::chrono::milliseconds timeout,
            std::string* changes = nullptr);

  /// Lets the robot take a posture. Ends the trajectories that move legs. Returns when the robot has begun.
  /// @return what becomes of it, for look() and waitForEnd()
  /// @throw as RcServerClient::takePosture()
  Fate takePosture(Posture posture, std::chrono::milliseconds timeout);

  /// Waits until a movement has ended, at most for this time.
  /// @return what has become of it so far
  movement::MovementFate waitForEnd(const Fate& movement, std::chrono::milliseconds timeout) const;

  /// Lets the robot walk: see RcServerClient::steer(). Ends the trajectories that move legs. A velocity of 0 is sent
  /// only to a robot that walks: one that sits goes on sitting. What is not sent is logged.
  /// @param source who asks
  /// @param epoch in which it was asked for
  void steer(const WalkVelocity& velocity, const std::string& source, std::uint64_t epoch);

  /// Ends a walk, in an orderly way. Does nothing if the robot does not walk.
  /// @param reason for the log and the state
  void stopWalking(const std::string& reason);

  /// The robot has accepted a velocity.
  void steered(const WalkVelocity& in_force);

  /// To be called before the motors are switched. Ends everything. From now on the posture may be any, so all joints
  /// are approached again: see JointCommandFilter.
  void prepareForMotors();

  /// To be called when the connection is lost.
  void disconnected();

  /// The robot reports that something has ended.
  void motionEnded(const MotionEnd& end);

  /// From now on everything new is refused, until unblock() has been called as often. So what was asked for before a
  /// stop, and is found in a queue after it, moves nothing.
  void block();
  void unblock();

  State state() const;

 private:
  /// What the robot does by itself, until it says that it has ended: a motion, a posture, a walk.
  struct Motion {
    movement::Movement movement;
    std::shared_ptr<movement::MovementFate> fate;
  };

  /// How the robot is asked for such a thing.
  struct Begin {
    movement::Movement movement;
    std::function<void()> prepare;  ///< ends what it replaces; called with the lock
    std::function<void()> ask;      ///< waits for the robot
    std::function<void()> undo;     ///< everything was stopped meanwhile
  };

  std::uint64_t presentEpoch() const;
  bool robotReportsEnds() const;
  void refuseIfBlocked() const;
  void checkConnection();
  void checkTelemetry() const;
  Fate begin(const Begin& begin);
  void freeLegs(const std::string& reason);
  void sendVelocity(const WalkVelocity& velocity);
  bool walks() const;
  void send(const std::vector<movement::JointStep>& steps);
  void holdRobot(const std::vector<int>& joints, const movement::JointOrders& orders, bool motions_too);
  void endMotions(movement::MovementEnd how, const std::string& reason);
  void endMotion(const std::shared_ptr<movement::MovementFate>& fate, movement::MovementEnd how,
                 const std::string& reason);
  void noteEnds();
  void logEnd(const movement::EndedMovement& ended);
  void changed() const;
  void begun() const;

  const movement::JointTable& table_;
  RcServerClient& client_;
  const std::function<bool()> telemetry_wanted_;
  Listener listener_;

  mutable std::mutex mutex_;  ///< of everything below; never held while waiting for the robot
  movement::JointLink link_;
  movement::JointCommandFilter filter_;
  movement::JointPlan plan_;
  ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("joints", text); }};
  mutable std::condition_variable ended_;  ///< one of the motions
  std::vector<Motion> motions_;
  std::uint64_t motions_connection_ = 0;  ///< over which a motion was played that may still be playing
  WalkVelocity velocity_;                 ///< that was sent last, over walk_connection_
  std::uint64_t walk_connection_ = 0;
  std::string walker_;            ///< who asked for it
  std::string walk_stop_reason_;  ///< why it was stopped here, if nobody asked for that
  std::optional<movement::EndedMovement> last_;
  std::uint64_t connection_ = 0;  ///< over which everything that moves was begun
  std::uint32_t stops_ = 0;
  int blocks_ = 0;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_JOINT_MOVER_H
