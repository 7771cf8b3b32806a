#include "ros/joints/joint_mover.h"

#include <algorithm>
#include <utility>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {
namespace {

using joints::MovementEnd;
using Lock = std::lock_guard<std::mutex>;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr const char* kStoppedAfter = "everything was stopped after it was sent.";

MovementEnd movementEnd(EndedHow how) {
  switch (how) {
    case EndedHow::kDone:
      return MovementEnd::kDone;
    case EndedHow::kReplaced:
      return MovementEnd::kReplaced;
    case EndedHow::kStopped:
      return MovementEnd::kStopped;
    case EndedHow::kRefused:
      return MovementEnd::kRefused;
    case EndedHow::kFell:
      return MovementEnd::kFell;
    case EndedHow::kUnknown:
      break;
  }
  return MovementEnd::kUnknown;
}

std::string nameOf(const joints::Movement& movement) {
  if (movement.kind == joints::Movement::Kind::kMotion) {
    return "The motion " + movement.name;
  }
  std::string names;
  for (const std::string& joint : movement.joints) {
    names += (names.empty() ? " of " : ", ") + joint;
  }
  return (movement.kind == joints::Movement::Kind::kTrajectory ? "The trajectory" : "The command") + names;
}

}  // namespace

JointMover::JointMover(const joints::JointTable& table, const joints::MeasuredJoints& measured, RcServerClient& client,
                       const DriverParameters& parameters, std::function<bool()> telemetry_wanted)
    : table_(table),
      client_(client),
      telemetry_wanted_(std::move(telemetry_wanted)),
      link_(client, table.design()),
      filter_(table, measured, parameters.approach_speed),
      plan_(table, measured, parameters.slow_down) {}

std::uint64_t JointMover::epoch() const {
  const Lock lock(mutex_);
  return presentEpoch();
}

void JointMover::command(const std::vector<std::string>& names, const std::vector<double>& positions,
                         const std::vector<double>& velocities, const std::string& source, std::uint64_t epoch) {
  {
    const Lock lock(mutex_);
    if (blocks_ > 0 || epoch != presentEpoch()) {
      warnings_.warn("A joint command was dropped: " + std::string(kStoppedAfter));
      return;
    }
    checkConnection();
    joints::JointOrders orders;
    const SteadyTime now = steady_clock::now();
    for (const std::string& refusal : filter_.filter(names, positions, velocities, now, &orders)) {
      warnings_.warn(refusal);
    }
    try {
      link_.send(orders, milliseconds(0));
      plan_.command(orders, source, now);
    } catch (const StoppedException&) {
      return;  // the driver is ending
    } catch (const Exception& error) {
      filter_.startApproach();
      warnings_.warn(std::string("A joint command was dropped: ") + error.what());
    }
    noteEnds();
  }
  begun();
}

JointMover::Fate JointMover::start(const joints::TrajectoryRequest& request, std::chrono::nanoseconds wait,
                                   const std::string& source) {
  Fate fate;
  {
    const Lock lock(mutex_);
    refuseIfBlocked();
    checkConnection();
    checkTelemetry();
    link_.requireDesign();
    const SteadyTime now = steady_clock::now();
    double stretch = 1;
    const milliseconds oldest = client_.status().protocol_version == 1 ? kFreshVersion1 : kFresh;
    fate = plan_.add(request, source, now + wait, now, oldest, &stretch);
    if (stretch > 1) {
      ROS_INFO_STREAM_NAMED("joints",
                            "The trajectory is slowed down " << stretch << " times to keep the joints' speed limits.");
    }
    send(plan_.advance(now));
    noteEnds();
  }
  begun();
  return fate;
}

bool JointMover::goOn() {
  bool busy = false;
  {
    const Lock lock(mutex_);
    checkConnection();
    send(plan_.advance(steady_clock::now()));
    noteEnds();
    busy = !plan_.empty();
  }
  changed();
  return busy;
}

joints::MovementFate JointMover::look(const Fate& movement) const {
  const Lock lock(mutex_);
  return *movement;
}

std::vector<joints::Trajectory::Start> JointMover::wantedBy(const Fate& trajectory, SteadyTime time) const {
  const Lock lock(mutex_);
  return plan_.wantedBy(*trajectory, time);
}

void JointMover::cancel(const Fate& trajectory, const std::string& reason) {
  std::vector<int> joints;
  joints::JointOrders orders;
  {
    const Lock lock(mutex_);
    joints = plan_.jointsOf(*trajectory);
    orders = plan_.holdingOrders(steady_clock::now(), trajectory.get());
    plan_.end(*trajectory, MovementEnd::kStopped, reason);
    noteEnds();
  }
  changed();
  if (!joints.empty()) {
    holdRobot(joints, orders, false);
  }
}

void JointMover::hold(const std::string& reason) {
  joints::JointOrders orders;
  {
    const Lock lock(mutex_);
    ++stops_;
    orders = plan_.holdingOrders(steady_clock::now());
    plan_.endAll(MovementEnd::kStopped, reason);
    noteEnds();
  }
  changed();
  holdRobot({}, orders, true);
}

// A server that cannot hold gets the places where the joints should be. It is told to end its motions if one was
// played.
void JointMover::holdRobot(const std::vector<int>& joints, const joints::JointOrders& orders, bool motions_too) {
  try {
    client_.hold(joints, kHoldTimeout);
    return;
  } catch (const CommandException& error) {
    ROS_DEBUG_STREAM_NAMED("joints", "The joints are sent to where they should be: " << error.what());
  }
  bool stop_motions = false;
  {
    const Lock lock(mutex_);
    link_.send(orders, milliseconds(0));
    stop_motions = motions_too && motions_connection_ == link_.connection();
  }
  if (stop_motions) {
    client_.stopMotion("", kHoldTimeout);
  }
}

JointMover::Fate JointMover::play(const std::string& name, int repetitions, milliseconds timeout,
                                  std::string* changes) {
  Motion motion;
  motion.movement.kind = joints::Movement::Kind::kMotion;
  motion.movement.name = name;
  motion.fate = std::make_shared<joints::MovementFate>();
  const std::uint64_t before = epoch();
  {
    const Lock lock(mutex_);
    refuseIfBlocked();
    checkConnection();
    plan_.endTrajectories(MovementEnd::kReplaced, "play_motion was called");
    noteEnds();
    link_.limitSpeeds(table_.speedLimits());  // the robot would keep to lower limits of earlier commands
    motions_.push_back(motion);               // now, because its end may be reported before the call returns
    motions_connection_ = link_.connection();
  }
  try {
    const std::string played_differently = client_.playMotion(name, repetitions, timeout);
    if (changes != nullptr) {
      *changes = played_differently;
    }
  } catch (const Exception&) {
    const Lock lock(mutex_);
    const auto is_it = [&motion](const Motion& each) { return each.fate == motion.fate; };
    motions_.erase(std::remove_if(motions_.begin(), motions_.end(), is_it), motions_.end());
    throw;
  }
  if (epoch() != before) {
    client_.stopMotion(name, timeout);
    throw CommandException("everything was stopped while the robot read it.");
  }
  if (!robotReportsEnds()) {
    const Lock lock(mutex_);
    endMotion(motion.fate, MovementEnd::kUnknown, "this robot does not say when a motion ends");
  }
  changed();
  return motion.fate;
}

void JointMover::prepareForMotors() {
  {
    const Lock lock(mutex_);
    ++stops_;
    plan_.endAll(MovementEnd::kStopped, "the motors are being switched");
    filter_.startApproach();
    noteEnds();
  }
  changed();
}

void JointMover::disconnected() {
  {
    const Lock lock(mutex_);
    const std::string reason = "the connection to the robot was lost; it will not be resumed";
    plan_.endAll(MovementEnd::kStopped, reason);
    endMotions(MovementEnd::kStopped, reason);
    noteEnds();
  }
  changed();
}

void JointMover::motionEnded(const MotionEnd& end) {
  if (end.kind != EndedKind::kMotion) {
    return;
  }
  {
    const Lock lock(mutex_);
    const auto motion = std::find_if(motions_.begin(), motions_.end(),
                                     [&end](const Motion& each) { return each.movement.name == end.name; });
    if (motion != motions_.end()) {
      const std::shared_ptr<joints::MovementFate> fate = motion->fate;
      endMotion(fate, movementEnd(end.how), end.reason);
    }
  }
  changed();
}

void JointMover::block() {
  const Lock lock(mutex_);
  ++blocks_;
}

void JointMover::unblock() {
  const Lock lock(mutex_);
  --blocks_;
}

JointMover::State JointMover::state() const {
  const Lock lock(mutex_);
  State state{plan_.movements(steady_clock::now()), last_};
  for (const Motion& motion : motions_) {
    state.movements.push_back(motion.movement);
  }
  return state;
}

std::uint64_t JointMover::presentEpoch() const {
  return (static_cast<std::uint64_t>(stops_) << 32) + link_.connection();
}

bool JointMover::robotReportsEnds() const {
  return client_.status().robot.hasCapability("I");
}

void JointMover::refuseIfBlocked() const {
  if (blocks_ > 0) {
    throw CommandException(kStoppedAfter);
  }
}

// With a new connection the posture may be any, and the robot has stopped what moved before.
void JointMover::checkConnection() {
  const std::uint64_t present = link_.connection();
  if (connection_ != present) {
    connection_ = present;
    filter_.startApproach();
    plan_.endAll(MovementEnd::kStopped, "the connection to the robot was lost; it will not be resumed");
  }
}

void JointMover::checkTelemetry() const {
  if (!telemetry_wanted_()) {
    throw InvalidArgumentException(
        "Trajectory refused: telemetry_rate is 0, so it is not known where the joints are. Set it above 0: rosrun "
        "dynamic_reconfigure dynparam set NODE telemetry_rate 31.25");
  }
}

void JointMover::send(const std::vector<joints::JointStep>& steps) {
  try {
    for (const joints::JointStep& step : steps) {
      link_.send(step.orders, step.duration);
    }
  } catch (const StoppedException&) {
    plan_.endAll(MovementEnd::kStopped, "the driver is ending");
  } catch (const Exception& error) {
    plan_.endAll(MovementEnd::kRefused, error.what());
  }
}

void JointMover::endMotions(MovementEnd how, const std::string& reason) {
  while (!motions_.empty()) {
    const std::shared_ptr<joints::MovementFate> fate = motions_.back().fate;
    endMotion(fate, how, reason);
  }
}

void JointMover::endMotion(const std::shared_ptr<joints::MovementFate>& fate, MovementEnd how,
                           const std::string& reason) {
  const auto motion =
      std::find_if(motions_.begin(), motions_.end(), [&fate](const Motion& each) { return each.fate == fate; });
  if (motion != motions_.end()) {
    fate->end = how;
    fate->reason = reason;
    last_ = joints::EndedMovement{motion->movement, how, reason};
    motions_.erase(motion);
    logEnd(*last_);
  }
}

void JointMover::noteEnds() {
  for (joints::EndedMovement& ended : plan_.takeEnded()) {
    logEnd(ended);
    last_ = std::move(ended);
  }
}

// Commands come often and replace each other, as is meant.
void JointMover::logEnd(const joints::EndedMovement& ended) {
  const bool is_command = ended.movement.kind == joints::Movement::Kind::kCommand;
  if (is_command || ended.how == MovementEnd::kDone || ended.how == MovementEnd::kUnknown) {
    ROS_DEBUG_STREAM_NAMED("joints", nameOf(ended.movement) << " has ended. " << ended.reason);
  } else {
    warnings_.warn(nameOf(ended.movement) + " ends early: " + ended.reason + ".");
  }
}

void JointMover::changed() const {
  if (listener_.on_change) {
    listener_.on_change();
  }
}

void JointMover::begun() const {
  if (listener_.on_begin) {
    listener_.on_begin();
  }
  changed();
}

}  // namespace aibo_driver::node
