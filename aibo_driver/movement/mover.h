/// @file mover.h
#ifndef AIBO_DRIVER_MOVEMENT_MOVER_H
#define AIBO_DRIVER_MOVEMENT_MOVER_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/orders.h"
#include "aibo_client/rcserver_client.h"
#include "movement/joint_command_filter.h"
#include "movement/joint_plan.h"
#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "movement/movement.h"
#include "movement/movement_book.h"
#include "movement/steering_streams.h"

namespace aibo_driver::movement {

/// Gives all orders to move to the robot, and knows how each has ended.
///
/// An order never fails. It begins a movement, which has exactly one end. A movement that is not carried out ends as
/// refused. If a node commands the same joints again, or steers on, the same movement goes on. If orders of one kind by
/// one node are refused again and again for the same reason, with less than half a second between them, only the first
/// is noted. MovementBook knows when a movement has ended.
///
/// An order is refused if the robot is stopped, if the order has waited for too long, or if something newer overrules
/// it. It is judged and handed to the client under one lock. So a stop knows of every order that was sent before it,
/// and no order is sent after it. Orders that come without a connection are lost, and no movement goes on over another
/// connection.
///
/// Any thread may call every member function. The functions that wait for the robot have a timeout. Meanwhile other
/// threads may call the other functions. The client's callbacks must not call play(), takePosture(), stop(), hold(),
/// cancel(), stopMotion() or setMotors(): these wait for answers that come on the thread of the callbacks.
class Mover {
 public:
  /// How long a call waits for the robot to hold, to switch its motors, or to begin a motion or a posture.
  static constexpr std::chrono::milliseconds kTimeout{2000};
  /// How old an order may be when it acts. The robot itself waits just as long for the next velocity of a walk.
  static constexpr std::chrono::milliseconds kLongestWait{500};
  /// A trajectory begins only if its joints were measured within this time.
  static constexpr std::chrono::milliseconds kFresh{300};
  /// The same time with a version 1 server, which reports one joint after the other, each about once a second.
  static constexpr std::chrono::milliseconds kFreshVersion1{2000};
  /// How many motions, and how many postures, may go on or wait for their end. JointPlan limits the number of
  /// trajectories.
  static constexpr std::size_t kMostOfAKind = 32;

  /// The answer to an order.
  struct Answer {
    MovementId id = 0;
    std::shared_future<EndedMovement> end;  ///< becomes ready when the movement has ended
    bool is_uncertain = false;              ///< the robot has not said whether the movement begins; `end` will tell
    /// The reason if is_uncertain. Otherwise a sentence about the joints that a command leaves out, or the result of
    /// RcServerClient::playMotion().
    std::string remark;

    /// The end of the movement; null while it goes on.
    const EndedMovement* ended() const {
      const bool is_over = end.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
      return is_over ? &end.get() : nullptr;
    }
  };

  struct State {
    std::vector<Movement> movements;        ///< the movements that go on now
    std::vector<EndedMovement> ended;       ///< the latest ends; the newest is last
    std::size_t ends = 0;                   ///< how many have ended so far
    aibo_client::MotorsAndPosture robot;    ///< what the robot reports about itself
    std::optional<std::string> stopped_by;  ///< the node that has stopped the robot; empty unless it is stopped
    SteadyTime overruled;                   ///< when the newest order that overrules others was received
  };

  /// These functions are called on the thread of the call that caused them, without a lock.
  struct Listener {
    std::function<void()> on_change = [] {};  ///< called after state() may have changed
    std::function<void()> on_begin = [] {};   ///< called when advance() has to be called from now on
    std::function<void(const EndedMovement&)> on_ended = [](const auto&) {};  ///< called for each end, in order
  };

  using Clock = std::function<SteadyTime()>;

  /// @param table, measured, client must outlive the mover
  /// @param approach_speed see JointCommandFilter
  Mover(const JointTable& table, const MeasuredJoints& measured, aibo_client::RcServerClient& client,
        double approach_speed, Clock clock = std::chrono::steady_clock::now);

  Mover(const Mover&) = delete;
  Mover& operator=(const Mover&) = delete;

  /// Call this before anything moves.
  void setListener(Listener listener) { listener_ = std::move(listener); }

  /// @name Orders
  /// @{

  /// Sends joints to positions, through the JointCommandFilter.
  /// @param names, positions, velocities see sensor_msgs/JointState
  /// @param kind kCommand or kLookAt
  Answer command(const Order& order, const std::vector<std::string>& names, const std::vector<double>& positions,
                 const std::vector<double>& velocities, Movement::Kind kind = Movement::Kind::kCommand);

  /// Begins a trajectory. JointPlan says how trajectories follow each other.
  /// @param wait the time until it begins; below 0 if it should have begun already
  /// @param arrival if is_measured is false, the robot says whether the joints have arrived. With a version 1 server,
  ///   the arrival is always measured
  Answer follow(const Order& order, const TrajectoryRequest& request, std::chrono::nanoseconds wait,
                const Arrival& arrival = {});

  /// Plays one of the robot's own motions, at speeds up to the limits of all joints. It ends the trajectories and waits
  /// until the robot has begun.
  Answer play(const Order& order, const std::string& name, int repetitions);

  /// Makes the robot take a posture. It ends the trajectories and whatever moves the robot's legs, and waits until the
  /// robot has begun. Rest is possible even if the robot is stopped.
  Answer takePosture(const Order& order, aibo_client::Posture posture);

  /// Makes the robot walk: see RcServerClient::steer() and SteeringStreams. It ends whatever moves the robot's legs. A
  /// velocity of 0 ends the walk, whoever sends it. But it is sent only if there is a walk to end, so a robot that sits
  /// goes on sitting. Before each new walk, the robot is told that its user has let go, because it may wait for that.
  void steer(const Order& order, const aibo_client::WalkVelocity& velocity);

  /// Begins a walk to a goal. It ends whatever moves the robot's legs, and another walk. A node that steers meanwhile
  /// has to let go first. The robot does not move before steerToGoal() is called.
  /// @param goal the goal in words
  Answer walkToGoal(const Order& order, const std::string& goal);

  /// Steers a walk to a goal, unless it has ended. Call this several times a second. A velocity of 0 ends the walk,
  /// which is then done.
  void steerToGoal(MovementId walk, const aibo_client::WalkVelocity& velocity);

  /// Notes that an order is refused.
  /// @param names the names of joints
  Answer refuse(const Order& order, Movement::Kind kind, const std::vector<std::string>& names,
                const std::string& reason);

  /// Call this before an order that the mover does not carry out itself, such as to flick an ear.
  /// @throw CommandException the order must not act now
  void requirePermission(const Order& order) const;

  /// @}
  /// @name Calls that end movements
  /// @{

  /// Ends everything that moves the robot, and refuses all orders but the posture rest until release().
  /// @throw NetworkException, TimeoutException, StoppedException, CommandException the robot could not be told; the
  ///   orders are refused nevertheless
  void stop(const Order& by);

  /// Allows orders again after a stop.
  /// @throw CommandException a stop is still on its way to the robot
  void release(const Order& by);

  /// Does the same as stop(), but later orders may move the robot.
  /// @param reason the reason for the log and the state
  /// @throw the exceptions of stop()
  void hold(const Order& by, const std::string& reason);

  /// Ends a trajectory, a posture or a walk to a goal. The joints of a trajectory and of a posture hold; a walk ends in
  /// an orderly way. It does nothing if the movement has ended.
  /// @throw the exceptions of stop()
  void cancel(MovementId movement, const std::string& reason);

  /// Stops one of the robot's own motions.
  /// @param name the name of the motion; empty means all motions
  /// @throw the exceptions of RcServerClient::stopMotion()
  void stopMotion(const Order& by, const std::string& name);

  /// Ends a walk in an orderly way. It does nothing if the robot does not walk, or walks to a goal.
  /// @param reason the reason for the log and the state
  void stopWalking(const std::string& reason);

  /// Switches the motors. Switching them off ends all movements, and is possible even if the robot is stopped.
  /// Switching them on while the robot is stopped is refused, because the joints would stiffen in somebody's hands.
  /// Afterwards the robot may have any posture, so all joints are approached again.
  /// @return true if the motors are on now
  /// @throw CommandException the order to switch them on is refused
  /// @throw the exceptions of RcServerClient::setMotors()
  bool setMotors(const Order& order, bool on);

  /// @}
  /// @name What the client reports
  /// @{
  /// @see aibo_client::Callbacks
  void steered(const aibo_client::WalkVelocity& in_force, std::uint64_t order, std::uint64_t walk);
  void ended(const aibo_client::ActivityEnd& end);
  void refused(const aibo_client::Refusal& refusal);
  void robotChanged(const aibo_client::MotorsAndPosture& state);
  void connected();
  void disconnected();
  /// @}

  /// Advances everything to the present time. After Listener::on_begin, call this every JointPlan::kPeriod.
  /// @return false if there is nothing left to move
  bool advance();

  /// Where a trajectory wants its joints to be now or at a time shortly before, in its own order of joints. It is empty
  /// before the trajectory's beginning and after its end.
  std::vector<Trajectory::Start> wantedBy(MovementId trajectory, SteadyTime time) const;

  State state() const;

 private:
  using OrderNumber = MovementBook::OrderNumber;
  using Halt = MovementBook::Halt;
  using Record = MovementBook::Record;

  template <typename Work>
  auto change(const Work& work);
  void tell(std::unique_lock<std::mutex>* lock);
  std::string refusalOf(const Order& order, bool may_act_while_stopped = false) const;
  void overrule(SteadyTime received, const std::string& what);
  void requireRoom(Movement::Kind kind) const;
  template <typename Reply>
  static Answer await(Answer begun, std::future<Reply>* reply);
  void stopWalk(const std::string& node);
  void walk(const Order& order, const aibo_client::WalkVelocity& velocity, Movement movement);
  void brake(Record* walk, const Halt& halt);
  void sendZeros();
  template <typename Ask>
  auto halt(std::optional<MovementId> only, const std::string& reason, const Ask& ask);
  template <typename Ask>
  auto haltAll(const Order& by, const std::string& reason, const Ask& ask);
  void overruleWalks(const Halt& halt);
  void takeLegsFromWalks(const Movement& movement);
  void endTrajectories(const std::string& reason);
  void freeLegs(const std::string& reason);
  std::future<void> hold(const std::vector<int>& joints, std::optional<MovementId> only);
  static Answer answerOf(const Record& record) { return {record.id(), record.end, false, ""}; }
  template <typename Act>
  Answer give(const Order& order, Movement::Kind kind, const std::string& name, const std::vector<std::string>& joints,
              const Act& act, bool may_act_while_stopped = false);
  Answer refuse(Movement movement, const std::string& reason);
  bool endOlder(OrderNumber order, aibo_client::EndedHow how, const std::string& reason);
  void loseAll();
  std::vector<std::string> known(const std::vector<std::string>& names) const;
  void checkConnection();
  void sendSteps(SteadyTime now);

  const JointTable& table_;
  aibo_client::RcServerClient& client_;
  const Clock clock_;
  Listener listener_;

  mutable std::mutex mutex_;  ///< guards everything below; never held while waiting for the robot
  JointCommandFilter filter_;
  JointPlan plan_;
  MovementBook book_;
  std::optional<std::string> stopped_by_;
  SteadyTime overruled_;  ///< orders that were received before this time are refused
  std::string overruled_by_;
  SteeringStreams streams_;
  SteadyTime advanced_;  ///< when advance() was last called, or when a trajectory was last asked for
  aibo_client::MotorsAndPosture robot_;
  int pending_halts_ = 0;         ///< calls that wait for the robot to halt
  std::uint64_t connection_ = 0;  ///< the connection over which all movements that go on were begun
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_MOVER_H
