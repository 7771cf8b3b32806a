#include "movement/joint_plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "aibo_client/exceptions.h"
#include "text/number.h"

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// A joint arrives this much later than planned, because the command has to reach the robot and the joint brakes.
constexpr double kSettling = 0.1;  // s

// A command that was sent this long ago may still wait for the link.
constexpr double kLongestQueue = 1.0;  // s

double seconds(steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

// A version 1 server reports each joint about once a second, and less often while it is busy.
constexpr milliseconds kLongestSilence{5000};

constexpr const char* kNewer = "a newer trajectory moves its joints";

// Says how far a joint is from its target, in words that follow the joint's name. The text is empty if it has arrived.
std::string describeDistance(const MeasuredJoint& measured, double target, const Tolerance& tolerance) {
  const double way = std::abs(measured.position - target);
  if (!(way <= tolerance.position)) {
    return " is " + text::decimal(way, 2) + " rad from where it was sent";
  }
  if (tolerance.speed && !(std::abs(measured.velocity) <= *tolerance.speed)) {
    return " still moves with " + text::decimal(measured.velocity, 2) + " rad/s";
  }
  return "";
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
  return found != request.joints.end() && moves[place] ? std::optional<std::size_t>(place) : std::nullopt;
}

std::vector<std::string> JointPlan::Job::names() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < request.joints.size(); ++i) {
    if (moves[i]) {
      names.push_back(request.joints[i]);
    }
  }
  return names;
}

void JointPlan::command(MovementId id, const JointTargets& targets, SteadyTime now) {
  for (const auto& [joint_id, target] : targets) {
    const std::optional<std::size_t> joint = table_.findById(joint_id);
    if (!joint) {
      continue;
    }
    const std::optional<Trajectory::Start> planned = stateOf(*joint, now, 0);
    const std::optional<MeasuredJoint> measured = measured_.find(*joint);
    const double from = planned ? planned->position : measured ? measured->position : target.position;
    commands_[*joint] = Command{id, from, target.position, target.speed, now};
  }
}

double JointPlan::add(MovementId id, const TrajectoryRequest& request, const Arrival& arrival, SteadyTime start,
                      SteadyTime now, milliseconds oldest) {
  Job job{id, request, arrival, start, oldest, std::vector<bool>(request.joints.size(), true), std::nullopt};
  checkWaiting(job, now);
  // This also refuses at once a request that could otherwise be refused only later.
  const double stretch = plan(job, now).stretch();
  for (Job& older : jobs_) {
    if (!older.run && older.start >= job.start) {
      takeJoints(job, &older);
    }
  }
  removeEnded();
  jobs_.push_back(std::move(job));
  return stretch;
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
    if (!step.targets.empty()) {
      steps.push_back(std::move(step));
    }
  }
  for (Job& job : jobs_) {
    if (job.arrival.is_measured && job.run && job.run->over) {
      judge(&job, now);
    }
  }
  removeEnded();
  return steps;
}

JointTargets JointPlan::holdingTargets(SteadyTime now, std::optional<MovementId> only) const {
  JointTargets targets;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    if (jobs_[i].run && (!only || jobs_[i].id == *only)) {
      targets.merge(targetsOf(i));
    }
  }
  for (std::size_t joint = 0; joint < commands_.size() && !only; ++joint) {
    const std::optional<Command>& command = commands_[joint];
    if (command && isUnderWay(*command, now, kLongestQueue)) {
      const double position = command->positionAt(seconds(now - command->begin));
      targets.try_emplace(table_[joint].id, aibo_client::JointTarget{table_[joint].id, position, command->speed});
    }
  }
  return targets;
}

void JointPlan::forget(MovementId id) {
  for (Job& job : jobs_) {
    job.has_ended = job.has_ended || job.id == id;
  }
  removeEnded();
  for (std::optional<Command>& command : commands_) {
    if (command && command->id == id) {
      command.reset();
    }
  }
}

void JointPlan::forget(const std::vector<std::string>& joints) {
  for (const std::string& joint : joints) {
    commands_[*table_.findByName(joint)].reset();
  }
}

std::vector<std::string> JointPlan::jointsOf(MovementId id) const {
  if (const Job* const job = find(id)) {
    return job->names();
  }
  return table_.namesOf([&](const JointProperties& joint) {
    const std::optional<Command>& command = commands_[*table_.findById(joint.id)];
    return command && command->id == id;
  });
}

std::optional<SteadyTime> JointPlan::endOf(MovementId trajectory, SteadyTime now) const {
  const Job* const job = find(trajectory);
  if (job == nullptr || !job->run) {
    return std::nullopt;
  }
  const std::chrono::duration<double> left(job->run->trajectory.duration() - job->run->clock.at(now));
  return now + std::chrono::duration_cast<steady_clock::duration>(left);
}

std::vector<Trajectory::Start> JointPlan::wantedBy(MovementId trajectory, SteadyTime now) const {
  const Job* const job = find(trajectory);
  const double time = job != nullptr && job->run && !job->run->over ? job->run->clock.at(now) : -1;
  return time < 0 ? std::vector<Trajectory::Start>() : job->run->trajectory.at(time);
}

bool JointPlan::goesOnAfter(MovementId trajectory, EndedHow how) const {
  const Job* const job = find(trajectory);
  if (job == nullptr) {
    return false;
  }
  const bool is_done = how == EndedHow::kDone;
  const bool is_judged = is_done || how == EndedHow::kNotReached || how == EndedHow::kUnknown;
  return job->arrival.is_measured ? is_judged : is_done && (!job->run || !job->run->end_sent);
}

const JointPlan::Job* JointPlan::find(MovementId trajectory) const {
  const auto job = std::find_if(jobs_.begin(), jobs_.end(), [=](const Job& each) { return each.id == trajectory; });
  return job == jobs_.end() ? nullptr : &*job;
}

// Where a joint should be `ahead` from now, if anything moves it then.
std::optional<Trajectory::Start> JointPlan::stateOf(std::size_t joint, SteadyTime now, double ahead) const {
  for (auto job = jobs_.rbegin(); job != jobs_.rend(); ++job) {
    const bool moves_now = job->run && !job->run->over;
    const std::optional<std::size_t> place = moves_now ? job->placeOf(table_[joint].name) : std::nullopt;
    const double time = place ? job->run->clock.at(now) + ahead : -1;
    if (time >= 0) {
      return job->run->trajectory.at(time)[*place];
    }
  }
  const std::optional<Command>& command = commands_[joint];
  if (!command || !isUnderWay(*command, now, kSettling)) {
    return std::nullopt;
  }
  const double time = seconds(now - command->begin) + ahead;
  const bool arrived = time >= command->duration();
  const double velocity = command->target > command->from ? command->speed : -command->speed;
  return Trajectory::Start{joint, command->positionAt(time), arrived ? 0 : velocity};
}

bool JointPlan::isUnderWay(const Command& command, SteadyTime now, double delay) {
  return seconds(now - command.begin) < command.duration() + delay;
}

Trajectory JointPlan::plan(const Job& job, SteadyTime now) const {
  const double ahead = seconds(job.start - now);
  std::vector<Trajectory::Start> start;
  for (const std::string& name : job.request.joints) {
    const std::optional<std::size_t> joint = table_.findByName(name);
    const std::optional<Trajectory::Start> planned = joint ? stateOf(*joint, now, std::max(0.0, ahead)) : std::nullopt;
    const std::optional<MeasuredJoint> measured = joint ? measured_.find(*joint) : std::nullopt;
    if (measured && now - measured->arrival > job.oldest) {
      throw aibo_client::InvalidArgumentException(
          name + " was last measured " + text::decimal(seconds(now - measured->arrival), 1) +
          " s ago, and a trajectory needs to know where it is: at most " + text::decimal(seconds(job.oldest), 1) +
          " s are allowed. Does joint_states still come?");
    }
    if (planned) {
      start.push_back(*planned);
    } else if (measured) {
      start.push_back({*joint, measured->position, 0});
    }
  }
  return Trajectory(dropPassedPoints(job.request, -ahead), table_, start, slow_down_);
}

// What the newer trajectory would take from those that wait does not count.
void JointPlan::checkWaiting(const Job& newer, SteadyTime now) const {
  if (newer.start <= now) {
    return;
  }
  std::set<MovementId> waiting;
  std::map<std::string, std::size_t> waiting_for;
  for (const Job& job : jobs_) {
    const bool has_begun = job.run && job.run->clock.at(now) >= 0;
    for (const std::string& joint : has_begun ? std::vector<std::string>() : job.names()) {
      if (job.run || job.start < newer.start || !newer.placeOf(joint)) {
        waiting.insert(job.id);
        ++waiting_for[joint];
      }
    }
  }
  const auto check = [](std::size_t number, std::size_t most, const std::string& whose) {
    if (number >= most) {
      throw aibo_client::InvalidArgumentException(std::to_string(most) + " trajectories" + whose +
                                                  " wait for their time already, and no more may wait");
    }
  };
  for (const std::string& joint : newer.request.joints) {
    check(waiting_for[joint], kMostWaitingForJoint, " of " + joint);
  }
  check(waiting.size(), kMostWaiting, "");
}

// A trajectory begins as early as its first positions have to be sent.
void JointPlan::beginDue(SteadyTime now) {
  const auto is_due = [now](const Job& job) { return !job.run && job.start <= now + kLookahead; };
  for (auto due = jobs_.begin(); (due = std::find_if(jobs_.begin(), jobs_.end(), is_due)) != jobs_.end();) {
    Job job = std::move(*due);
    jobs_.erase(due);
    for (std::size_t i = job.moves.size(); i-- > 0;) {
      if (!job.moves[i]) {
        removeJoint(i, &job.request);
      }
    }
    job.moves.assign(job.request.joints.size(), true);
    try {
      job.run = Run{plan(job, now), TrajectoryClock(std::max(job.start, now), kPeriod), {}, false, std::nullopt};
      jobs_.push_back(std::move(job));
    } catch (const aibo_client::InvalidArgumentException& error) {
      noteEnd(&job, EndedHow::kRefused, error.what());
    }
  }
}

// Trajectories that have begun take their joints from older ones.
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
    forget(jobs_[newer].names());
  }
  removeEnded();
}

// If nothing is left to it, it ends.
void JointPlan::takeJoints(const Job& newer, Job* older) {
  for (std::size_t i = 0; i < older->request.joints.size(); ++i) {
    older->moves[i] = older->moves[i] && !newer.placeOf(older->request.joints[i]);
  }
  if (older->names().empty()) {
    noteEnd(older, EndedHow::kReplaced, kNewer);
  }
}

// Where the joints of a trajectory that has begun were last sent, unless a newer one sends them.
JointTargets JointPlan::targetsOf(std::size_t index) const {
  const auto first_newer = jobs_.begin() + static_cast<std::ptrdiff_t>(index) + 1;
  const Job& job = jobs_[index];
  JointTargets targets;
  for (const std::string& name : job.names()) {
    if (std::none_of(first_newer, jobs_.end(),
                     [&name](const Job& newer) { return newer.run && newer.placeOf(name); })) {
      const std::size_t joint = *table_.findByName(name);
      const double position =
          std::clamp(job.run->sent[*job.placeOf(name)].position, table_[joint].lowest, table_[joint].highest);
      targets[table_[joint].id] = {table_[joint].id, position, table_.speedLimit(joint)};
    }
  }
  return targets;
}

JointStep JointPlan::next(std::size_t index, SteadyTime now) {
  Job& job = jobs_[index];
  if (!job.run) {
    return {};
  }
  Run& run = *job.run;
  const double left = run.trajectory.duration() - run.clock.at(now);
  if (run.end_sent) {
    if (left <= 0 && !run.over) {
      run.over = now;
    }
    return {};
  }
  const double ahead = std::clamp(left, 0.0, seconds(kLookahead));
  run.end_sent = left <= ahead;
  run.sent = run.trajectory.at(run.clock.at(now) + ahead);
  return {job.id, targetsOf(index), milliseconds(std::lround(1000 * ahead))};
}

// Ends a trajectory whose joints have arrived or should have arrived.
void JointPlan::judge(Job* job, SteadyTime now) {
  std::vector<std::string> away;
  std::vector<std::string> unmeasured;
  const SteadyTime over = *job->run->over;
  const std::vector<Trajectory::Start> end = job->run->trajectory.at(job->run->trajectory.duration());
  for (const std::string& joint : job->names()) {
    const std::optional<MeasuredJoint> measured = measured_.find(*table_.findByName(joint));
    if (!measured || measured->arrival < over) {
      unmeasured.push_back(joint);
      continue;
    }
    const auto own = job->arrival.tolerances.find(joint);
    const Tolerance tolerance = own == job->arrival.tolerances.end() ? Tolerance() : own->second;
    const std::string problem = describeDistance(*measured, end[*job->placeOf(joint)].position, tolerance);
    if (!problem.empty()) {
      away.push_back(joint + problem);
    }
  }
  const milliseconds grace = job->arrival.grace;
  if (away.empty() && unmeasured.empty()) {
    noteEnd(job, EndedHow::kDone, "");
  } else if (!away.empty() && now >= over + grace) {
    noteEnd(job, EndedHow::kNotReached, listOf(away));
  } else if (away.empty() && now >= over + std::max(grace, kLongestSilence)) {
    noteEnd(job, EndedHow::kUnknown, "no measurement of " + listOf(unmeasured) + " has come since");
  }
}

void JointPlan::removeEnded() {
  jobs_.erase(std::remove_if(jobs_.begin(), jobs_.end(), [](const Job& job) { return job.has_ended; }), jobs_.end());
}

void JointPlan::noteEnd(Job* job, EndedHow how, const std::string& reason) {
  if (!std::exchange(job->has_ended, true)) {
    ended_.push_back({job->id, how, reason, job->names()});
  }
}

}  // namespace aibo_driver::movement
