#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "command_line/commands/commands.h"
#include "command_line/interruption.h"
#include "command_line/quantities.h"
#include "movement/joint_command_filter.h"
#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "text/sentence.h"

namespace aibo_driver::command_line {

using aibo_client::InvalidArgumentException;

namespace {

using std::chrono::steady_clock;

constexpr double kMargin = 5;            // s, in addition to the time that a way takes at full speed
constexpr double kThere = 0.0087;        // rad, half a degree
constexpr double kNear = 0.05;           // rad; a robot of version 2 has to come as near
constexpr double kClamped = 0.001;       // rad
constexpr double kLongestDuration = 60;  // s
constexpr double kLowestSpeed = 0.01;    // rad/s

/// Rounds to a tenth, and removes the sign of zero.
double roundedDegrees(double radian) {
  return std::round(10 * degrees(radian)) / 10 + 0.0;
}

std::string inDegrees(double radian) {
  return text::decimal(roundedDegrees(radian), 1) + " degrees";
}

/// The targets of joints.
struct Move {
  std::vector<std::string> names;
  std::vector<double> positions;  ///< rad, as the user typed them
  double speed = 0;               ///< rad/s
  double duration = 0;            ///< s; 0 means as fast as the speed allows
};

Move parseMove(const Arguments& arguments) {
  Move move;
  for (const Assignment& joint : parseAssignments(arguments.words, "head_pan=30deg")) {
    move.names.push_back(joint.name);
    move.positions.push_back(parseAngle(joint.name, joint.value));
  }
  move.speed = movement::kUsualApproachSpeed;
  if (arguments.has("speed")) {
    move.speed = parseAngularSpeed("--speed", arguments.get("speed"));
    if (!(move.speed >= kLowestSpeed && move.speed <= movement::kUsualSpeedLimit)) {
      throw InvalidArgumentException("--speed can be 0.6deg/s to 171deg/s (3 rad/s)");
    }
  }
  if (arguments.has("duration")) {
    move.duration = arguments.number("duration", 0, kLongestDuration);
  }
  return move;
}

/// Moves joints as the driver does: within their limits, and with the driver's filter.
class Mover {
 public:
  Mover(Robot& robot, Output& output, const Move& move)
      : robot_(robot),
        output_(output),
        move_(move),
        table_(robot.model().design, movement::kUsualSpeedLimit),
        measured_(table_),
        filter_(table_, measured_, move.speed) {}

  /// @throw FailedException a joint does not reach its target
  ExitStatus run() {
    requireJoints();
    measure();
    const movement::JointTargets targets = filtered();
    movement::sendTargets(robot_.client(), table_.design(), targets,
                          std::chrono::milliseconds(std::lround(1000 * move_.duration)), Robot::terms());
    try {
      waitUntilAccepted(targets);
      waitUntilArrived(targets);
    } catch (const Interrupted&) {
      hold(targets);
      throw;
    }
    report();
    return kDone;
  }

 private:
  void requireJoints() const {
    for (const std::string& name : move_.names) {
      if (!table_.findByName(name)) {
        throw InvalidArgumentException("the " + table_.design() + " has no joint '" + name +
                                       "': `aibo joints` lists them");
      }
    }
  }

  /// Measures where the joints are, to know how long the way takes and when they have arrived.
  void measure() {
    robot_.client().setTelemetryPeriod(Robot::kTelemetryPeriod);
    const bool measured = robot_.waitUntil(
        [this](const Received& received) { return received.joints.size() >= table_.size(); }, Robot::kMeasureTimeout);
    if (!measured) {
      throw FailedException("the robot does not report where its joints are, so none was moved");
    }
  }

  movement::JointTargets filtered() {
    std::vector<double> positions = move_.positions;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const auto& joint = table_[table_.findByName(move_.names[i]).value()];
      positions[i] = std::clamp(positions[i], joint.lowest, joint.highest);
    }
    movement::JointTargets targets;
    for (const std::string& refusal : filter_.filter(move_.names, positions, {}, steady_clock::now(), &targets)) {
      throw InvalidArgumentException(refusal);
    }
    for (std::size_t i = 0; i < move_.names.size(); ++i) {
      noteIfClamped(move_.names[i], move_.positions[i], targets.at(idOf(move_.names[i])).position,
                    "beyond the joint's limit");
    }
    return targets;
  }

  void waitUntilAccepted(const movement::JointTargets& targets) {
    const auto accepted = [&targets](const Received& received) {
      return std::all_of(targets.begin(), targets.end(),
                         [&](const auto& each) { return received.accepted_joints.count(each.first) > 0; });
    };
    if (!robot_.waitUnlessRefused(accepted, Robot::kMeasureTimeout)) {
      throw FailedException("the robot did not say that it accepts the command");
    }
    for (const auto& [id, wanted] : targets) {
      noteIfClamped(nameOf(id), wanted.position, target(id), "where another joint or the body is in its way");
    }
  }

  /// The robot says when all joints have arrived, and which has not. With a server of version 1, they are measured.
  void waitUntilArrived(const movement::JointTargets& targets) {
    double longest = move_.duration;
    for (const auto& [id, wanted] : targets) {
      longest = std::max(longest, std::abs(target(id) - position(id)) / wanted.speed);
    }
    const bool arrived = robot_.reportsEnds()
                             ? robot_.waitForEnd("the movement", longest + kMargin).has_value()
                             : waitUntilNear(targets, kThere, longest) || waitUntilNear(targets, kNear, kMargin);
    if (!arrived) {
      throw FailedException("not all joints have arrived in time; `aibo joints` shows where they are");
    }
  }

  bool waitUntilNear(const movement::JointTargets& targets, double tolerance, double seconds) {
    const auto is_near = [&](const Received& received) {
      return std::all_of(targets.begin(), targets.end(), [&](const auto& each) {
        const double target = received.accepted_joints.at(each.first);
        return std::abs(received.joints.at(each.first).position - target) <= tolerance;
      });
    };
    return robot_.waitUnlessRefused(is_near, nanosecondsOf(seconds));
  }

  /// Holds the joints. A server that cannot hold is told to move them to where they are.
  void hold(const movement::JointTargets& targets) {
    std::vector<int> ids;
    movement::JointTargets here;
    for (const auto& [id, wanted] : targets) {
      ids.push_back(id);
      here[id] = {id, position(id), wanted.speed};
    }
    if (robot_.reportsEnds()) {
      robot_.client().hold(ids, Robot::kTimeout);
    } else {
      movement::sendTargets(robot_.client(), table_.design(), here);
      robot_.waitUntil(
          [&here](const Received& received) {
            return std::all_of(here.begin(), here.end(), [&received](const auto& each) {
              const auto accepted = received.accepted_joints.find(each.first);
              return accepted != received.accepted_joints.end() &&
                     std::abs(accepted->second - each.second.position) <= kClamped;
            });
          },
          Robot::kTimeout);
    }
  }

  void report() {
    std::string words;
    std::vector<Json> documents;
    for (std::size_t i = 0; i < move_.names.size(); ++i) {
      const int id = idOf(move_.names[i]);
      words += (words.empty() ? "" : "\n") + move_.names[i] + " is at " + inDegrees(position(id));
      documents.push_back(Json::object({{"name", move_.names[i]},
                                        {"commanded", move_.positions[i]},
                                        {"target", target(id)},
                                        {"position", position(id)},
                                        {"clamped", std::abs(target(id) - move_.positions[i]) > kClamped}}));
    }
    output_.result(words, Json::object({{"joints", Json::array(documents)}}));
  }

  void noteIfClamped(const std::string& name, double wanted, double given, const std::string& why) {
    if (std::abs(wanted - given) > kClamped) {
      output_.note(name + " cannot go to " + inDegrees(wanted) + ", " + why + ": it goes to " + inDegrees(given) + ".");
    }
  }

  int idOf(const std::string& name) const { return table_[*table_.findByName(name)].id; }
  std::string nameOf(int id) const { return table_[*table_.findById(id)].name; }
  double position(int id) const { return robot_.received().joints.at(id).position; }
  double target(int id) const { return robot_.received().accepted_joints.at(id); }

  Robot& robot_;
  Output& output_;
  const Move& move_;
  const movement::JointTable table_;
  const movement::MeasuredJoints measured_;  // stays empty, so that the filter always approaches its first target
  movement::JointCommandFilter filter_;
};

ExitStatus moveJoints(const Arguments& arguments, Output& output) {
  const Move move = parseMove(arguments);
  Robot robot(arguments.robot, output);
  robot.connect();
  return Mover(robot, output, move).run();
}

ExitStatus showJoints(const Arguments& arguments, Output& output) {
  Robot robot(arguments.robot, output);
  robot.connect();
  const movement::JointTable table(robot.model().design, movement::kUsualSpeedLimit);
  robot.client().setTelemetryPeriod(Robot::kTelemetryPeriod);
  robot.waitUntil([&](const Received& received) { return received.joints.size() >= table.size(); },
                  Robot::kMeasureTimeout);
  const std::map<int, aibo_client::JointReading> measured = robot.received().joints;
  if (measured.empty()) {
    throw FailedException("the robot does not report its joints: does its server support them?");
  }
  char line[160];
  std::snprintf(line, sizeof line, "%-20s %9s   %s", "", "degrees", "limits");
  std::string words = line;
  std::vector<Json> documents;
  for (const movement::JointProperties& joint : table.joints()) {
    const auto found = measured.find(joint.id);
    if (found == measured.end()) {
      continue;
    }
    const double position = found->second.position;
    std::snprintf(line, sizeof line, "\n%-20s %9.1f   %.0f to %.0f", joint.name.c_str(), roundedDegrees(position),
                  degrees(joint.lowest), degrees(joint.highest));
    words += line;
    documents.push_back(Json::object(
        {{"name", joint.name}, {"position", position}, {"lowest", joint.lowest}, {"highest", joint.highest}}));
  }
  output.result(words, Json::object({{"robot", table.design()}, {"joints", Json::array(documents)}}));
  return kDone;
}

}  // namespace

std::vector<Command> jointCommands() {
  return {
      {"joints",
       "",
       "shows where the joints are",
       "Angles are in degrees, or in radians with --json. A server of version 1 takes a second.",
       {{"joints", "one line a joint, with its limits"}},
       showJoints},
      {"move",
       "JOINT=ANGLE...",
       "moves joints, and waits until they have arrived",
       "Angles need a unit, deg or rad. Joints keep to their limits, and the command says what was clamped. They move "
       "at the driver's approach speed, 29 degrees a second, unless --speed or --duration says otherwise. The motors "
       "have to be on. Ctrl-C lets the joints hold. When the command has ended, they hold their positions.",
       {{"move head_pan=30deg", "looks to the left"},
        {"move tail_pan=-0.5rad mouth=-20deg --duration 2", "both arrive after 2 s"}},
       moveJoints,
       {{"duration", "S", "", "time after which all arrive together, 0 to 60; longer if the speed does not allow it"},
        {"speed", "SPEED", "", "greatest speed, such as 60deg/s; at most 171deg/s"}}}};
}

}  // namespace aibo_driver::command_line
