#include "ros/joints/joint_mover.h"

#include <algorithm>
#include <utility>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {
namespace {

using movement::MovementEnd;
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

std::string nameOf(const movement::Movement& movement) {
  switch (movement.kind) {
    case movement::Movement::Kind::kMotion:
      return "The motion " + movement.name;
    case movement::Movement::Kind::kPosture:
      return "The posture " + movement.name;
    case movement::Movement::Kind::kWalk:
      return "The walk";
    default:
      break;
  }
  std::string names;
  for (const std::string& joint : movement.joints) {
    names += (names.empty() ? " of " : ", ") + joint;
  }
  return (movement.kind == movement::Movement::Kind::kTrajectory ? "The trajectory" : "The command") + names;
}

bool isMotionEnd(const movement::Movement& movement, const MotionEnd& end) {
  switch (movement.kind) {
    case movement::Movement::Kind::kMotion:
      return end.kind == EndedKind::kMotion && movement.name == end.name;
    case movement::Movement::Kind::kPosture:
      return end.kind == EndedKind::kPosture && movement.name == end.name;
    case movement::Movement::Kind::kWalk:
      return end.kind == EndedKind::kWalk;
    default:
      return false;
  }
}

std::string nameOf(Posture posture) {
  switch (posture) {
    case Posture::kStand:
      return "stand";
    case Posture::kSit:
      return "sit";
    case Posture::kRest:
      break;
  }
  return "rest";
}

}  // namespace

JointMover::JointMover(const movement::JointTable& table, const movement::MeasuredJoints& measured,
                       RcServerClient& client, const DriverParameters& parameters,
                       std::function<bool()> telemetry_wanted)
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
    movement::JointOrders orders;
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

JointMover::Fate JointMover::start(const movement::TrajectoryRequest& request, std::chrono::nanoseconds wait,
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

movement::MovementFate JointMover::look(const Fate& movement) const {
  const Lock lock(mutex_);
  return *movement;
}

std::vector<movement::Trajectory::Start> JointMover::wantedBy(const Fate& trajectory, SteadyTime time) const {
  const Lock lock(mutex_);
  return plan_.wantedBy(*trajectory, time);
}

void JointMover::cancel(const Fate& trajectory, const std::string& reason) {
  std::vector<int> joints;
  movement::JointOrders orders;
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
  movement::JointOrders orders;
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
void JointMover::holdRobot(const std::vector<int>& joints, const movement::JointOrders& orders, bool motions_too) {
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
  Begin motion;
  motion.movement.kind = movement::Movement::Kind::kMotion;
  motion.movement.name = name;
  motion.prepare = [this] {
    plan_.endTrajectories(MovementEnd::kReplaced, "play_motion was called");
    link_.limitSpeeds(table_.speedLimits());  // the robot would keep to lower limits of earlier commands
    motions_connection_ = link_.connection();
  };
  motion.ask = [&] {
    const std::string played_differently = client_.playMotion(name, repetitions, timeout);
    if (changes != nullptr) {
      *changes = played_differently;
    }
  };
  motion.undo = [&] { client_.stopMotion(name, timeout); };
  return begin(motion);
}

JointMover::Fate JointMover::takePosture(Posture posture, milliseconds timeout) {
  Begin change;
  change.movement.kind = movement::Movement::Kind::kPosture;
  change.movement.name = nameOf(posture);
  change.prepare = [&] { freeLegs("the posture " + change.movement.name + " was asked for"); };
  change.ask = [&] { client_.takePosture(posture, timeout); };
  change.undo = [&] { client_.hold({}, timeout); };
  return begin(change);
}

JointMover::Fate JointMover::begin(const Begin& begin) {
  const Motion motion{begin.movement, std::make_shared<movement::MovementFate>()};
  const std::uint64_t before = epoch();
  {
    const Lock lock(mutex_);
    refuseIfBlocked();
    checkConnection();
    begin.prepare();
    noteEnds();
    motions_.push_back(motion);  // now, because its end may be reported before the call returns
  }
  changed();
  try {
    begin.ask();
  } catch (const Exception&) {
    {
      const Lock lock(mutex_);
      const auto is_it = [&motion](const Motion& each) { return each.fate == motion.fate; };
      motions_.erase(std::remove_if(motions_.begin(), motions_.end(), is_it), motions_.end());
    }
    changed();
    throw;
  }
  if (epoch() != before) {
    begin.undo();
    throw CommandException("everything was stopped while the robot was asked for it.");
  }
  if (!robotReportsEnds()) {
    const Lock lock(mutex_);
    endMotion(motion.fate, MovementEnd::kUnknown, "this robot does not say when a motion ends");
  }
  changed();
  return motion.fate;
}

movement::MovementFate JointMover::waitForEnd(const Fate& movement, milliseconds timeout) const {
  std::unique_lock<std::mutex> lock(mutex_);
  ended_.wait_for(lock, timeout, [&movement] { return movement->end.has_value(); });
  return *movement;
}

// Trajectories of the head go on. The robot would keep the legs to lower speed limits of earlier commands; a walk needs
// what they can do.
void JointMover::freeLegs(const std::string& reason) {
  link_.requireDesign();
  plan_.endTrajectoriesOf(table_.namesOfLegs(), MovementEnd::kReplaced, reason);
  if (client_.status().robot.hasCapability("S")) {
    link_.limitSpeeds(table_.ownSpeedsOfLegs());
  }
}

void JointMover::steer(const WalkVelocity& velocity, const std::string& source, std::uint64_t epoch) {
  {
    const Lock lock(mutex_);
    if (velocity.isZero() && !walks()) {
      return;
    }
    if (blocks_ > 0 || epoch != presentEpoch()) {
      warnings_.warn("A velocity to walk with was dropped: " + std::string(kStoppedAfter));
      return;
    }
    checkConnection();
    walk_stop_reason_.clear();
    walker_ = source;
    try {
      if (!velocity.isZero()) {
        freeLegs("the robot walks");
      }
      sendVelocity(velocity);
    } catch (const StoppedException&) {
      return;  // the driver is ending
    } catch (const Exception& error) {
      warnings_.warn(std::string("The robot does not walk: ") + error.what());
    }
    noteEnds();
  }
  changed();
}

void JointMover::stopWalking(const std::string& reason) {
  const Lock lock(mutex_);
  if (!walks()) {
    return;
  }
  try {
    sendVelocity({});
    walk_stop_reason_ = reason;
  } catch (const Exception& error) {  // then it stops by itself
    ROS_DEBUG_STREAM_NAMED("walk", "The robot was not told to stop walking: " << error.what());
  }
}

void JointMover::sendVelocity(const WalkVelocity& velocity) {
  client_.steer(velocity);
  velocity_ = velocity;
  walk_connection_ = link_.connection();
}

// Also true of one that has been told to, and has not answered yet.
bool JointMover::walks() const {
  const auto is_walk = [](const Motion& each) { return each.movement.kind == movement::Movement::Kind::kWalk; };
  const bool is_told_to = walk_connection_ == link_.connection() && !velocity_.isZero();
  return is_told_to || std::any_of(motions_.begin(), motions_.end(), is_walk);
}

void JointMover::steered(const WalkVelocity& in_force) {
  {
    const Lock lock(mutex_);
    const auto is_walk = [](const Motion& each) { return each.movement.kind == movement::Movement::Kind::kWalk; };
    if (in_force.isZero() || std::any_of(motions_.begin(), motions_.end(), is_walk)) {
      return;
    }
    Motion walk{{}, std::make_shared<movement::MovementFate>()};
    walk.movement.kind = movement::Movement::Kind::kWalk;
    walk.movement.source = walker_;
    motions_.push_back(walk);
  }
  changed();
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
    velocity_ = WalkVelocity();
  }
  changed();
}

void JointMover::motionEnded(const MotionEnd& end) {
  {
    const Lock lock(mutex_);
    const auto motion = std::find_if(motions_.begin(), motions_.end(),
                                     [&end](const Motion& each) { return isMotionEnd(each.movement, end); });
    if (motion == motions_.end()) {
      return;
    }
    const movement::Movement::Kind kind = motion->movement.kind;
    const bool ran_out =
        kind == movement::Movement::Kind::kWalk && end.how == EndedHow::kDone && !walk_stop_reason_.empty();
    const std::shared_ptr<movement::MovementFate> fate = motion->fate;
    if (kind == movement::Movement::Kind::kWalk) {
      velocity_ = WalkVelocity();
    }
    endMotion(fate, ran_out ? MovementEnd::kStopped : movementEnd(end.how), ran_out ? walk_stop_reason_ : end.reason);
    if (kind != movement::Movement::Kind::kMotion) {
      filter_.startApproach();  // the legs may be anywhere, and after "rest" in somebody's hands
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

void JointMover::send(const std::vector<movement::JointStep>& steps) {
  try {
    for (const movement::JointStep& step : steps) {
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
    const std::shared_ptr<movement::MovementFate> fate = motions_.back().fate;
    endMotion(fate, how, reason);
  }
}

void JointMover::endMotion(const std::shared_ptr<movement::MovementFate>& fate, MovementEnd how,
                           const std::string& reason) {
  const auto motion =
      std::find_if(motions_.begin(), motions_.end(), [&fate](const Motion& each) { return each.fate == fate; });
  if (motion != motions_.end()) {
    fate->end = how;
    fate->reason = reason;
    last_ = movement::EndedMovement{motion->movement, how, reason};
    motions_.erase(motion);
    ended_.notify_all();
    logEnd(*last_);
  }
}

void JointMover::noteEnds() {
  for (movement::EndedMovement& ended : plan_.takeEnded()) {
    logEnd(ended);
    last_ = std::move(ended);
  }
}

// Commands come often and replace each other, as is meant.
void JointMover::logEnd(const movement::EndedMovement& ended) {
  const bool is_command = ended.movement.kind == movement::Movement::Kind::kCommand;
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
