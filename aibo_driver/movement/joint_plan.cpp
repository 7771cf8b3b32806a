#include "movement/joint_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aibo_client/exceptions.h"
#include "text/sentence.h"

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// A joint arrives this much later than planned, because the command has to reach the robot and the joint brakes.
constexpr double kSettling = 0.1;  // s

// A command that was sent less than this long ago may still wait for the link.
constexpr double kLongestQueue = 1.0;  // s

double seconds(steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

// A version 1 server reports each joint about once a second, and less often while it is busy.
constexpr milliseconds kLongestSilence{5000};

constexpr const char* kNewer = "a newer trajectory moves its joints";

// Says how far a joint is from its target, in words to put after the joint's name. The text is empty if it has arrived.
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

}  // namespace

double JointPlan::Command::duration() const {
  return std::abs(target - from) / speed;
}

double JointPlan::Command::positionAt(double time) const {
  const double way = std::clamp(time, 0.0, duration()) * speed;
  return target > from ? from + way : from - way;
}

bool JointPlan::Job::moves(const std::string& joint) const {
  return std::find(request.joints.begin(), request.joints.end(), joint) != request.joints.end();
}

bool JointPlan::Job::sharesJointWith(const Job& other) const {
  return std::any_of(request.joints.begin(), request.joints.end(),
                     [&other](const std::string& joint) { return other.moves(joint); });
}

bool JointPlan::Job::replaces(const Job& waiting) const {
  return start <= waiting.start && sharesJointWith(waiting);
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

void JointPlan::add(MovementId id, const TrajectoryRequest& request, const Arrival& arrival, SteadyTime start,
                    SteadyTime now, milliseconds oldest) {
  resume(now);
  Job job{id, request, arrival, start, oldest, std::nullopt};
  for (const Job& other : jobs_) {
    if (other.run && other.start > now && job.sharesJointWith(other)) {
      job.start = std::max(job.start, other.start);  // the other one's positions are computed only from its start on
    }
  }
  // A request that could only be refused at its beginning is refused now.
  plan(job, now);
  if (start > now) {
    checkWaiting(job);
  }
  for (Job& older : jobs_) {
    if (!older.run && job.replaces(older)) {
      noteEnd(&older, EndedHow::kReplaced, kNewer);
    }
  }
  removeEnded();
  jobs_.push_back(std::move(job));
}

std::vector<JointStep> JointPlan::advance(SteadyTime now) {
  resume(now);
  for (Job& job : jobs_) {
    if (!job.run && job.start <= now + kLookahead) {
      begin(&job, now);
    }
  }
  removeEnded();
  std::vector<JointStep> steps;
  for (Job& job : jobs_) {
    JointStep step = next(&job, now);
    if (!step.targets.empty()) {
      steps.push_back(std::move(step));
    }
    if (job.arrival.is_measured && job.run && job.run->over) {
      judge(&job, now);
    }
  }
  removeEnded();
  return steps;
}

JointTargets JointPlan::holdingTargets(SteadyTime now, std::optional<MovementId> only) const {
  JointTargets targets;
  for (const Job& job : jobs_) {
    if (job.run && (!only || job.id == *only)) {
      targets.merge(targetsOf(job));
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
    return job->request.joints;
  }
  return table_.namesOf([&](const JointProperties& joint) {
    const std::optional<Command>& command = commands_[*table_.findById(joint.id)];
    return command && command->id == id;
  });
}

std::optional<SteadyTime> JointPlan::endOf(MovementId trajectory) const {
  const Job* const job = find(trajectory);
  if (job == nullptr || !job->run) {
    return std::nullopt;
  }
  const std::chrono::duration<double> duration(job->run->trajectory.duration());
  return job->start + std::chrono::duration_cast<steady_clock::duration>(duration);
}

std::vector<Trajectory::Start> JointPlan::wantedBy(MovementId trajectory, SteadyTime now) const {
  const Job* const job = find(trajectory);
  const double time = job != nullptr && job->run && !job->run->over ? timeOf(*job, now) : -1;
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

// The present time of a trajectory, in seconds; below 0 before its beginning.
double JointPlan::timeOf(const Job& job, SteadyTime now) const {
  return seconds((now - advanced_ > kLongestGap ? advanced_ + kPeriod : now) - job.start);
}

// Where the plan has a joint `ahead` seconds from now; no value if nothing moves the joint then.
std::optional<Trajectory::Start> JointPlan::stateOf(std::size_t joint, SteadyTime now, double ahead) const {
  for (const Job& job : jobs_) {
    if (job.run && !job.has_ended && !job.run->over && job.moves(table_[joint].name)) {
      const std::vector<Trajectory::Start> states = job.run->trajectory.at(timeOf(job, now) + ahead);
      return *std::find_if(states.begin(), states.end(), [=](const auto& state) { return state.joint == joint; });
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
          " s are allowed. Does joint_states still come, and is telemetry_rate above 0?");
    }
    if (measured) {
      start.push_back(planned.value_or(Trajectory::Start{*joint, measured->position, 0}));
    }
  }
  return Trajectory(dropPassedPoints(job.request, -ahead), table_, start);
}

// Throws if too many trajectories wait for their beginning. Those that the newer one replaces are not counted.
void JointPlan::checkWaiting(const Job& newer) const {
  const auto check = [&](std::size_t most, const std::string& whose, const auto& is_meant) {
    const auto waits = [&](const Job& each) { return !each.run && !newer.replaces(each) && is_meant(each); };
    if (std::count_if(jobs_.begin(), jobs_.end(), waits) >= static_cast<std::ptrdiff_t>(most)) {
      throw aibo_client::InvalidArgumentException(std::to_string(most) + " trajectories" + whose +
                                                  " already wait for their start, and no more are accepted");
    }
  };
  for (const std::string& joint : newer.request.joints) {
    check(kMostWaitingForJoint, " of " + joint, [&joint](const Job& each) { return each.moves(joint); });
  }
  check(kMostWaiting, "", [](const Job&) { return true; });
}

// Shifts the beginning of running trajectories by the time for which the caller stalled.
void JointPlan::resume(SteadyTime now) {
  const steady_clock::duration gap = now - std::exchange(advanced_, now);
  for (Job& job : jobs_) {
    if (job.run && gap > kLongestGap) {
      job.start += gap - kPeriod;
    }
  }
}

// Begins a trajectory when its first positions have to be sent, which may be before its start. From then on, nothing
// else moves its joints.
void JointPlan::begin(Job* job, SteadyTime now) {
  try {
    const Trajectory trajectory = plan(*job, now);
    job->start = std::max(job->start, now);
    for (Job& other : jobs_) {
      if (other.run && job->sharesJointWith(other)) {
        noteEnd(&other, EndedHow::kReplaced, kNewer);
      }
    }
    forget(job->request.joints);
    job->run = Run{trajectory, {}, false, std::nullopt};
  } catch (const aibo_client::InvalidArgumentException& error) {
    noteEnd(job, EndedHow::kRefused, error.what());
  }
}

// The targets that were last sent for a trajectory that runs.
JointTargets JointPlan::targetsOf(const Job& job) const {
  JointTargets targets;
  for (const Trajectory::Start& sent : job.run->sent) {
    const JointProperties& joint = table_[sent.joint];
    const double position = std::clamp(sent.position, joint.lowest, joint.highest);
    targets[joint.id] = {joint.id, position, table_.speedLimit(sent.joint)};
  }
  return targets;
}

JointStep JointPlan::next(Job* job, SteadyTime now) {
  if (!job->run) {
    return {};
  }
  Run& run = *job->run;
  const double left = run.trajectory.duration() - timeOf(*job, now);
  if (run.end_sent) {
    if (left <= 0 && !run.over) {
      run.over = now;
    }
    return {};
  }
  const double ahead = std::clamp(left, 0.0, seconds(kLookahead));
  run.end_sent = left <= ahead;
  run.sent = run.trajectory.at(timeOf(*job, now) + ahead);
  return {job->id, targetsOf(*job), milliseconds(std::lround(1000 * ahead))};
}

// Ends a trajectory whose joints have arrived or should have arrived.
void JointPlan::judge(Job* job, SteadyTime now) {
  std::vector<std::string> away;
  std::vector<std::string> unmeasured;
  const SteadyTime over = *job->run->over;
  for (const Trajectory::Start& target : job->run->trajectory.at(job->run->trajectory.duration())) {
    const std::string& joint = table_[target.joint].name;
    const std::optional<MeasuredJoint> measured = measured_.find(target.joint);
    if (!measured || measured->arrival < over) {
      unmeasured.push_back(joint);
      continue;
    }
    const auto own = job->arrival.tolerances.find(joint);
    const Tolerance tolerance = own == job->arrival.tolerances.end() ? Tolerance() : own->second;
    const std::string problem = describeDistance(*measured, target.position, tolerance);
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
    ended_.push_back({job->id, how, reason});
  }
}

}  // namespace aibo_driver::movement
