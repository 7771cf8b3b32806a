#include "movement/joint_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Until a joint that should have arrived really has: the command has to reach the robot, and the joint brakes.
constexpr double kSettling = 0.1;  // s

// A command that was sent this long ago may still wait for the link.
constexpr double kLongestQueue = 1.0;  // s

double seconds(steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

void removeJoint(std::size_t place, TrajectoryRequest* request) {
  const auto offset = static_cast<std::ptrdiff_t>(place);
  request->joints.erase(request->joints.begin() + offset);
  for (TrajectoryRequest::Point& point : request->points) {
    point.positions.erase(point.positions.begin() + offset);
    if (!point.velocities.empty()) {
      point.velocities.erase(point.velocities.begin() + offset);
    }
  }
}

}  // namespace

double JointPlan::Command::duration() const {
  return std::abs(target - from) / speed;
}

double JointPlan::Command::positionAt(double time) const {
  const double way = std::clamp(time, 0.0, duration()) * speed;
  return target > from ? from + way : from - way;
}

std::optional<std::size_t> JointPlan::Job::placeOf(const std::string& joint) const {
  const auto found = std::find(request.joints.begin(), request.joints.end(), joint);
  const auto place = static_cast<std::size_t>(found - request.joints.begin());
  return found != request.joints.end() && moves(place) ? std::optional<std::size_t>(place) : std::nullopt;
}

std::vector<std::string> JointPlan::Job::names() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < request.joints.size(); ++i) {
    if (moves(i)) {
      names.push_back(request.joints[i]);
    }
  }
  return names;
}

void JointPlan::command(const JointOrders& orders, const std::string& source, SteadyTime now) {
  for (std::optional<Command>& command : commands_) {
    if (!commanding_ && command && !isRecent(*command, now)) {
      command.reset();
    }
  }
  for (const auto& [id, order] : orders) {
    const std::optional<std::size_t> joint = table_.findById(id);
    if (!joint) {
      continue;
    }
    const std::optional<Trajectory::Start> planned = stateOf(*joint, now, 0);
    const std::optional<MeasuredJoint> measured = measured_.find(*joint);
    const double from = planned ? planned->position : measured ? measured->position : order.position;
    endThoseThatMove(*joint);
    commands_[*joint] = Command{from, order.position, order.speed, now};
    commanding_ = true;
    commander_ = source;
  }
}

std::shared_ptr<const MovementFate> JointPlan::add(const TrajectoryRequest& request, const std::string& source,
                                                   SteadyTime start, SteadyTime now, milliseconds oldest,
                                                   double* stretch) {
  Job job{request, source, start, oldest, std::make_shared<MovementFate>(), std::nullopt};
  *stretch = plan(job, now).stretch();  // also refuses now what could only be refused later
  takeFromWaiting(job);
  jobs_.push_back(job);
  return job.fate;
}

std::vector<JointStep> JointPlan::advance(SteadyTime now) {
  for (Job& job : jobs_) {
    if (job.run) {
      job.run->clock.attend(now);
    }
  }
  beginDue(now);
  handOver(now);
  std::vector<JointStep> steps;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    JointStep step = next(i, now);
    if (!step.orders.empty()) {
      steps.push_back(std::move(step));
    }
  }
  removeEnded();
  const auto is_under_way = [&](const std::optional<Command>& command) { return command && isUnderWay(*command, now); };
  if (commanding_ && std::none_of(commands_.begin(), commands_.end(), is_under_way)) {
    endCommands(MovementEnd::kDone, "");
  }
  return steps;
}

JointOrders JointPlan::holdingOrders(SteadyTime now, const MovementFate* only) const {
  JointOrders orders;
  for (std::size_t joint = 0; joint < commands_.size() && only == nullptr; ++joint) {
    const std::optional<Command>& command = commands_[joint];
    if (command && isRecent(*command, now)) {
      orders[table_[joint].id] = {command->positionAt(seconds(now - command->begin)), command->speed};
    }
  }
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    const Job& job = jobs_[i];
    if (!job.run || job.run->sent.empty() || (only != nullptr && job.fate.get() != only)) {
      continue;
    }
    for (const std::string& joint : job.names()) {
      if (!isSentByNewer(i, joint)) {
        orders[table_[*table_.findByName(joint)].id] = orderFor(joint, job.run->sent[*job.placeOf(joint)]);
      }
    }
  }
  return orders;
}

void JointPlan::endTrajectories(MovementEnd how, const std::string& reason) {
  for (const Job& job : jobs_) {
    noteEnd(job, how, reason);
  }
  removeEnded();
}

void JointPlan::endTrajectoriesOf(const std::vector<std::string>& joints, MovementEnd how, const std::string& reason) {
  for (const Job& job : jobs_) {
    if (std::any_of(joints.begin(), joints.end(), [&job](const std::string& joint) { return job.placeOf(joint); })) {
      noteEnd(job, how, reason);
    }
  }
  removeEnded();
}

void JointPlan::endAll(MovementEnd how, const std::string& reason) {
  endTrajectories(how, reason);
  if (commanding_) {
    endCommands(how, reason);
  }
  commands_.assign(table_.size(), std::nullopt);
}

void JointPlan::end(const MovementFate& trajectory, MovementEnd how, const std::string& reason) {
  for (const Job& job : jobs_) {
    if (job.fate.get() == &trajectory) {
      noteEnd(job, how, reason);
    }
  }
  removeEnded();
}

std::vector<int> JointPlan::jointsOf(const MovementFate& trajectory) const {
  std::vector<int> ids;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    for (const std::string& joint : jobs_[i].names()) {
      if (jobs_[i].run && jobs_[i].fate.get() == &trajectory && !isSentByNewer(i, joint)) {
        ids.push_back(table_[*table_.findByName(joint)].id);
      }
    }
  }
  return ids;
}

std::vector<Trajectory::Start> JointPlan::wantedBy(const MovementFate& trajectory, SteadyTime now) const {
  std::vector<Trajectory::Start> states;
  for (const Job& job : jobs_) {
    if (job.fate.get() != &trajectory || !job.run || job.run->clock.at(now) < 0) {
      continue;
    }
    const double time = job.run->clock.at(now);
    const std::vector<double> positions = job.run->trajectory.sample(time);
    const std::vector<double> velocities = job.run->trajectory.velocities(time);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      states.push_back({job.run->trajectory.joints()[i], positions[i], velocities[i]});
    }
  }
  return states;
}

std::vector<Movement> JointPlan::movements(SteadyTime now) const {
  std::vector<Movement> movements;
  if (commanding_) {
    movements.push_back(describeCommands(now));
  }
  for (const Job& job : jobs_) {
    if (job.run) {
      movements.push_back(describe(job, now));
    }
  }
  return movements;
}

std::vector<EndedMovement> JointPlan::takeEnded() {
  return std::exchange(ended_, {});
}

// Where a joint should be some time from now, if anything moves it then.
std::optional<Trajectory::Start> JointPlan::stateOf(std::size_t joint, SteadyTime now, double ahead) const {
  for (auto job = jobs_.rbegin(); job != jobs_.rend(); ++job) {
    const std::optional<std::size_t> place = job->run ? job->placeOf(table_[joint].name) : std::nullopt;
    const double time = place ? job->run->clock.at(now) + ahead : -1;
    if (time >= 0) {
      return Trajectory::Start{joint, job->run->trajectory.sample(time)[*place],
                               job->run->trajectory.velocities(time)[*place]};
    }
  }
  const std::optional<Command>& command = commands_[joint];
  if (!command || !isUnderWay(*command, now)) {
    return std::nullopt;
  }
  const double time = seconds(now - command->begin) + ahead;
  const bool arrived = time >= command->duration();
  const double velocity = command->target > command->from ? command->speed : -command->speed;
  return Trajectory::Start{joint, command->positionAt(time), arrived ? 0 : velocity};
}

bool JointPlan::isUnderWay(const Command& command, SteadyTime now) {
  return seconds(now - command.begin) < command.duration() + kSettling;
}

bool JointPlan::isRecent(const Command& command, SteadyTime now) {
  return seconds(now - command.begin) < command.duration() + kLongestQueue;
}

Trajectory JointPlan::plan(const Job& job, SteadyTime now) const {
  checkFresh(job, now);
  const double ahead = seconds(job.start - now);
  std::vector<Trajectory::Start> start;
  for (const std::string& name : job.request.joints) {
    const std::optional<std::size_t> joint = table_.findByName(name);
    const std::optional<Trajectory::Start> planned = joint ? stateOf(*joint, now, std::max(0.0, ahead)) : std::nullopt;
    const std::optional<MeasuredJoint> measured = joint ? measured_.find(*joint) : std::nullopt;
    if (planned) {
      start.push_back(*planned);
    } else if (measured) {
      start.push_back({*joint, measured->position, 0});
    }
  }
  return Trajectory(dropPassedPoints(job.request, -ahead), table_, start, slow_down_);
}

void JointPlan::checkFresh(const Job& job, SteadyTime now) const {
  for (const std::string& name : job.request.joints) {
    const std::optional<std::size_t> joint = table_.findByName(name);
    const std::optional<MeasuredJoint> measured = joint ? measured_.find(*joint) : std::nullopt;
    if (measured && now - measured->arrival > job.oldest) {
      char text[160];
      std::snprintf(text, sizeof(text),
                    "was last measured %.1f s ago, and a trajectory needs to know where it is: "
                    "allowed is %.1f s. Does joint_states still come?",
                    seconds(now - measured->arrival), seconds(job.oldest));
      throw InvalidArgumentException("Trajectory refused: " + name + " " + text);
    }
  }
}

// Of trajectories that would begin later, a newer one takes its joints.
void JointPlan::takeFromWaiting(const Job& newer) {
  for (Job& job : jobs_) {
    if (job.run || job.start < newer.start) {
      continue;
    }
    Job taken = job;
    for (std::size_t i = job.request.joints.size(); i-- > 0;) {
      if (newer.placeOf(job.request.joints[i])) {
        removeJoint(i, &job.request);
      } else {
        removeJoint(i, &taken.request);
      }
    }
    if (!taken.request.joints.empty()) {
      noteTaken(taken, job);
    }
  }
  removeEnded();
}

// A newer trajectory has taken joints of another one.
void JointPlan::noteTaken(const Job& taken, const Job& rest) {
  const std::string left = listOf(rest.names());
  if (left.empty()) {
    noteEnd(taken, MovementEnd::kReplaced, "a newer trajectory moves its joints");
  } else {
    rest.fate->partly_replaced = true;
    ended_.push_back({describe(taken, taken.start), MovementEnd::kReplaced,
                      "a newer trajectory moves them, while it goes on for " + left});
  }
}

void JointPlan::endThoseThatMove(std::size_t joint) {
  for (const Job& job : jobs_) {
    if (job.placeOf(table_[joint].name)) {
      noteEnd(job, MovementEnd::kReplaced, table_[joint].name + " was commanded to go elsewhere");
    }
  }
  removeEnded();
}

// As early as their first positions have to be sent.
void JointPlan::beginDue(SteadyTime now) {
  const auto is_due = [now](const Job& job) { return !job.run && job.start <= now + kLookahead; };
  for (auto due = jobs_.begin(); (due = std::find_if(jobs_.begin(), jobs_.end(), is_due)) != jobs_.end();) {
    Job job = std::move(*due);
    jobs_.erase(due);
    try {
      job.run = Run{plan(job, now),
                    TrajectoryClock(std::max(job.start, now), kPeriod),
                    std::vector<bool>(job.request.joints.size(), true),
                    {},
                    false};
      jobs_.push_back(std::move(job));
    } catch (const InvalidArgumentException& error) {
      noteEnd(job, MovementEnd::kRefused, error.what());
    }
  }
}

// Those that have begun take their joints from older ones.
void JointPlan::handOver(SteadyTime now) {
  for (std::size_t newer = 0; newer < jobs_.size(); ++newer) {
    if (!jobs_[newer].run || jobs_[newer].run->clock.at(now) < 0) {
      continue;
    }
    for (std::size_t older = 0; older < newer; ++older) {
      if (jobs_[older].run) {
        takeJoints(jobs_[newer], &jobs_[older]);
      }
    }
    takeCommands(jobs_[newer], now);
  }
  removeEnded();
}

void JointPlan::takeJoints(const Job& newer, Job* older) {
  const std::vector<std::string> before = older->names();
  const auto is_taken = [&newer](const std::string& joint) { return newer.placeOf(joint).has_value(); };
  if (std::none_of(before.begin(), before.end(), is_taken)) {
    return;
  }
  Job taken = *older;
  for (std::size_t i = 0; i < older->request.joints.size(); ++i) {
    taken.run->moves[i] = older->moves(i) && is_taken(older->request.joints[i]);
    older->run->moves[i] = older->moves(i) && !taken.run->moves[i];
  }
  noteTaken(taken, *older);
}

void JointPlan::takeCommands(const Job& newer, SteadyTime now) {
  bool took_one = false;
  bool is_one_left = false;
  for (std::size_t joint = 0; joint < commands_.size(); ++joint) {
    const bool under_way = commands_[joint] && isUnderWay(*commands_[joint], now);
    const bool taken = newer.placeOf(table_[joint].name).has_value();
    took_one = took_one || (taken && under_way);
    is_one_left = is_one_left || (!taken && under_way);
  }
  if (commanding_ && took_one && !is_one_left) {
    endCommands(MovementEnd::kReplaced, "a trajectory moves its joints");
  }
  for (const std::string& joint : newer.names()) {
    commands_[*table_.findByName(joint)].reset();
  }
}

bool JointPlan::isSentByNewer(std::size_t index, const std::string& joint) const {
  return std::any_of(jobs_.begin() + static_cast<std::ptrdiff_t>(index) + 1, jobs_.end(),
                     [&joint](const Job& job) { return job.run && job.placeOf(joint); });
}

JointStep JointPlan::next(std::size_t index, SteadyTime now) {
  Job& job = jobs_[index];
  if (!job.run) {
    return {};
  }
  Run& run = *job.run;
  const double left = run.trajectory.duration() - run.clock.at(now);
  if (run.end_sent) {
    if (left <= 0) {
      noteEnd(job, MovementEnd::kDone, "");
    }
    return {};
  }
  const double ahead = std::clamp(left, 0.0, seconds(kLookahead));
  run.end_sent = left <= ahead;
  run.sent = run.trajectory.sample(run.clock.at(now) + ahead);
  JointStep step;
  step.duration = milliseconds(std::lround(1000 * ahead));
  for (const std::string& joint : job.names()) {
    if (!isSentByNewer(index, joint)) {
      step.orders[table_[*table_.findByName(joint)].id] = orderFor(joint, run.sent[*job.placeOf(joint)]);
    }
  }
  return step;
}

JointOrder JointPlan::orderFor(const std::string& joint, double position) const {
  const std::size_t index = *table_.findByName(joint);
  return {std::clamp(position, table_[index].lowest, table_[index].highest), table_.speedLimit(index)};
}

void JointPlan::removeEnded() {
  jobs_.erase(std::remove_if(jobs_.begin(), jobs_.end(), [](const Job& job) { return job.fate->end.has_value(); }),
              jobs_.end());
}

void JointPlan::noteEnd(const Job& job, MovementEnd how, const std::string& reason) {
  if (!job.fate->end) {
    job.fate->end = how;
    job.fate->reason = reason;
    ended_.push_back({describe(job, job.start), how, reason});
  }
}

void JointPlan::endCommands(MovementEnd how, const std::string& reason) {
  ended_.push_back({describeCommands({}), how, reason});
  commanding_ = false;
}

Movement JointPlan::describe(const Job& job, SteadyTime now) const {
  Movement movement;
  movement.kind = Movement::Kind::kTrajectory;
  movement.source = job.source;
  movement.joints = job.names();
  if (job.run) {
    const std::chrono::duration<double> left(job.run->trajectory.duration() - job.run->clock.at(now));
    movement.end = now + std::chrono::duration_cast<steady_clock::duration>(left);
  }
  return movement;
}

Movement JointPlan::describeCommands(SteadyTime now) const {
  Movement movement;
  movement.source = commander_;
  for (std::size_t joint = 0; joint < commands_.size(); ++joint) {
    if (commands_[joint] && isUnderWay(*commands_[joint], now)) {
      movement.joints.push_back(table_[joint].name);
    }
  }
  return movement;
}

}  // namespace aibo_driver::movement
