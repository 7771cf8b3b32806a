/// @file mover.h
#ifndef AIBO_DRIVER_MOVEMENT_MOVER_H
#define AIBO_DRIVER_MOVEMENT_MOVER_H

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <list>
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
#include "movement/movement.h"
#include "movement/order_gate.h"
#include "movement/steering_streams.h"

namespace aibo_driver::movement {

/// Every order to move enters here, and here its end is decided, from what the robot says and from its measured joints.
///
/// An order never fails. It begins a movement, which has exactly one end; one that is not carried out ends as refused.
/// The same movement goes on when a node commands the same joints again, or steers on. Of orders of one kind by one
/// node that are refused for the same reason again and again, without half a second between them, only the first one
/// is noted.
///
/// While the robot is stopped, and before an OrderGate lets it pass, no order moves the robot. Nothing is kept while
/// there is no connection, and nothing goes on over another one.
///
/// Every member function may be called from any thread. Those that wait for the robot have a timeout; meanwhile the
/// others go on.
class Mover {
 public:
  /// How long it waits for the robot to hold, to switch its motors, and to begin a motion or a posture.
  static constexpr std::chrono::milliseconds kTimeout{2000};
  /// A trajectory begins only if its joints were measured this lately.
  static constexpr std::chrono::milliseconds kFresh{300};
  /// The same with a version 1 server, which reports one joint after the other, each about once a second.
  static constexpr std::chrono::milliseconds kFreshVersion1{2000};
  /// So many ends are remembered.
  static constexpr std::size_t kEndsRemembered = 64;

  /// What has become of an order.
  struct Begun {
    MovementId id = 0;
    std::shared_future<EndedMovement> end;  ///< comes when the movement has ended
    bool is_uncertain = false;  ///< the robot has not answered, and may or may not begin: `end` comes when it says
    std::string remark;         ///< why that is so; else as RcServerClient::playMotion() returns

    /// Null if it goes on.
    const EndedMovement* ended() const {
      const bool is_over = end.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
      return is_over ? &end.get() : nullptr;
    }
  };

  struct State {
    std::vector<Movement> movements;        ///< now
    std::vector<EndedMovement> ended;       ///< the latest, the newest last
    std::size_t ends = 0;                   ///< how many have ended so far
    MotorsAndPosture robot;                 ///< what it says of itself
    std::optional<std::string> stopped_by;  ///< the node that has stopped it, if it is stopped
  };

  /// What it tells others, on the thread of the call that caused it, and without a lock.
  struct Listener {
    std::function<void()> on_change;                          ///< state() may have changed
    std::function<void()> on_begin;                           ///< goOn() has to be called from now on
    std::function<void(const EndedMovement&)> on_ended;       ///< in order
    std::function<void(const std::string& text)> on_warning;  ///< what was left out of an order
  };

  using Clock = std::function<SteadyTime()>;

  /// @param table, measured, client must outlive the mover
  /// @param approach_speed as for JointCommandFilter
  /// @param slow_down as for Trajectory
  /// @param telemetry_wanted false if the robot is not asked to report its joints
  Mover(const JointTable& table, const MeasuredJoints& measured, RcServerClient& client, double approach_speed,
        bool slow_down, std::function<bool()> telemetry_wanted, Clock clock = std::chrono::steady_clock::now);

  Mover(const Mover&) = delete;
  Mover& operator=(const Mover&) = delete;

  /// To be called before anything moves.
  void setListener(Listener listener) { listener_ = std::move(listener); }

  /// @name Orders
  /// @{

  /// Sends joints to positions, through the JointCommandFilter.
  /// @param names, positions, velocities as in sensor_msgs/JointState
  /// @param kind kCommand or kLookAt
  Begun command(const Order& order, const std::vector<std::string>& names, const std::vector<double>& positions,
                const std::vector<double>& velocities, Movement::Kind kind = Movement::Kind::kCommand);

  /// Begins a trajectory. See JointPlan for how trajectories follow each other, and end.
  /// @param wait until it begins; below 0 if it should have begun before
  Begun follow(const Order& order, const TrajectoryRequest& request, std::chrono::nanoseconds wait,
               const Arrival& arrival = {});

  /// Plays a motion of the robot's own, at speeds up to the limits of all joints. Ends the trajectories. Waits until
  /// the robot has begun.
  Begun play(const Order& order, const std::string& name, int repetitions);

  /// Lets the robot take a posture. Ends what moves its legs. Waits until the robot has begun. Rest is possible while
  /// the robot is stopped, too.
  Begun takePosture(const Order& order, Posture posture);

  /// Lets the robot walk: see RcServerClient::steer() and SteeringStreams. Ends what moves its legs. A velocity of 0 is
  /// sent only to a robot that walks: one that sits goes on sitting.
  void steer(const Order& order, const WalkVelocity& velocity);

  /// Notes that an order is refused.
  /// @param names of joints
  Begun refuse(const Order& order, Movement::Kind kind, const std::vector<std::string>& names,
               const std::string& reason);

  /// @}
  /// @name Ends
  /// @{

  /// Ends everything that moves the robot, and refuses all orders until release().
  /// @throw NetworkException, TimeoutException, StoppedException, CommandException the robot could not be told; all
  ///   orders are refused nevertheless
  void stop(const Order& by);

  /// @throw CommandException a stop is still on its way to the robot
  void release(const Order& by);

  /// The same as stop(), but what comes later may move the robot.
  /// @param reason for the log and the state
  /// @throw as stop()
  void hold(const Order& by, const std::string& reason);

  /// Ends a trajectory, and holds its joints. Does nothing if it has ended.
  /// @throw as stop()
  void cancel(MovementId trajectory, const std::string& reason);

  /// Stops a motion of the robot's own.
  /// @param name empty: all
  /// @throw as RcServerClient::stopMotion()
  void stopMotion(const Order& by, const std::string& name);

  /// Ends a walk, in an orderly way. Does nothing if the robot does not walk.
  /// @param reason for the log and the state
  void stopWalking(const std::string& reason);

  /// Switches the motors. Off ends everything, and is possible while the robot is stopped, too. On is not, because the
  /// joints would stiffen in somebody's hands. From then on the posture may be any, so all joints are approached again.
  /// @return true if they are on now
  /// @throw CommandException the order to switch them on is refused
  /// @throw as RcServerClient::setMotors()
  bool setMotors(const Order& order, bool on);

  /// @}
  /// @name What the client reports
  /// @{
  void steered(const WalkVelocity& in_force);
  void ended(const MotionEnd& end);
  void refused(const Refusal& refusal);
  void answeredLate(const LateAnswer& answer);
  void robotChanged(const MotorsAndPosture& state);
  void connected();
  void disconnected();
  /// @}

  /// Moves everything on. To be called every JointPlan::kPeriod from Listener::on_begin on.
  /// @return false if there is nothing to move on any more
  bool goOn();

  /// Where a trajectory wants its joints to be at a time, now or shortly before, in its own order of joints; empty
  /// before its beginning and after its end.
  std::vector<Trajectory::Start> wantedBy(MovementId trajectory, SteadyTime time) const;

  /// The joints that a movement still moves.
  std::vector<std::string> jointsOf(MovementId id) const;

  State state() const;

 private:
  /// A movement that has not ended.
  struct Record {
    MovementId id = 0;
    Movement movement;
    std::promise<EndedMovement> promise;
    std::shared_future<EndedMovement> end;
    bool has_begun = false;  ///< of a walk: the robot has said so
    std::string trouble;     ///< a joint that does not follow, in words; empty if there is none
  };

  /// What the listener has not been told yet.
  struct News {
    std::vector<EndedMovement> ended;
    std::vector<std::string> warnings;
  };

  /// An order that was refused lately.
  struct Refused {
    EndedMovement movement;
    SteadyTime last;
  };

  template <typename Work>
  auto change(const Work& work);
  void tell();
  template <typename Ask, typename Undo>
  Begun askRobot(Begun begun, const Ask& ask, const Undo& undo);
  std::vector<MovementId> overruleAll(const Order& by, const std::string& reason);
  template <typename Tell>
  void halt(const std::vector<MovementId>& movements, const std::string& reason, const Tell& tell_robot);
  void tellToHold(const std::vector<int>& joints, std::optional<MovementId> only, bool motions_too);
  void walk(const Order& order, const WalkVelocity& velocity, Movement movement);
  void letGo(const std::string& reason);
  Begun begin(Movement movement);
  Begun refuse(Movement movement, const std::string& reason);
  bool isRepeated(const EndedMovement& refused);
  void note(const EndedMovement& ended);
  void end(MovementId id, MovementEnd how, const std::string& reason);
  void endAll(MovementEnd how, const std::string& reason);
  void takeEndsOfPlan();
  void close(MovementId id, MovementEnd how, const std::string& reason);
  template <typename Condition>
  std::vector<MovementId> idsOf(const Condition& condition) const;
  std::vector<MovementId> commandersOf(const Refusal& refusal) const;
  Record* find(MovementId id);
  Record* findWalk();
  Record* findCommand(const Movement& movement);
  std::vector<std::string> known(const std::vector<std::string>& names) const;
  static OrderTerms termsOf(const Order& order, MovementId id);
  void checkConnection();
  void checkTelemetry() const;
  void overruleWalk(const Movement& movement);
  void freeLegs(const std::string& reason);
  void sendSteps(const std::vector<JointStep>& steps);

  const JointTable& table_;
  RcServerClient& client_;
  const std::function<bool()> telemetry_wanted_;
  const Clock clock_;
  Listener listener_;

  mutable std::mutex mutex_;  ///< of everything below; never held while waiting for the robot
  JointLink link_;
  JointCommandFilter filter_;
  JointPlan plan_;
  OrderGate gate_;
  SteeringStreams streams_;
  std::list<Record> records_;
  MovementId last_id_ = 0;
  std::deque<EndedMovement> ended_;
  std::size_t ends_ = 0;
  SteadyTime went_on_;  ///< goOn() was called, or a trajectory has begun
  std::vector<Refused> refused_;
  News news_;
  MotorsAndPosture robot_;
  int halts_ = 0;                         ///< that the robot is being told
  std::string halt_reason_;               ///< of the latest
  bool is_told_to_walk_ = false;          ///< the last velocity that was sent is not 0
  std::string walk_stop_reason_;          ///< why it was stopped here, if nobody asked for that
  std::uint64_t connection_ = 0;          ///< over which everything that moves was begun
  std::uint64_t motions_connection_ = 0;  ///< over which a motion was played that may still be playing
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_MOVER_H
