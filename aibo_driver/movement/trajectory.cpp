#include "movement/trajectory.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "aibo_client/exceptions.h"
#include "text/sentence.h"

namespace aibo_driver::movement {
namespace {

using Point = TrajectoryRequest::Point;

// Programs round a limit of 88 degrees to 1.536. The robot clamps a position that is beyond its limit.
constexpr double kPositionTolerance = 0.001;  // rad

constexpr double kSpeedTolerance = 1.001;  // for rounding errors

// Planners begin a trajectory where they measured the joints. Later measurements differ a little: encoders waver, and a
// leg that carries the robot gives way.
constexpr double kStartTolerance = 0.1;  // rad

[[noreturn]] void refuse(const std::string& reason) {
  throw aibo_client::InvalidArgumentException(reason + ".");
}

std::string number(double value) {
  return text::decimal(value, 3);
}

bool allFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

TrajectoryRequest dropPassedPoints(TrajectoryRequest request, double age) {
  if (age <= 0 || request.points.empty()) {
    return request;
  }
  std::vector<Point> left;
  for (Point& point : request.points) {
    // A time that is not a number fails this comparison and is kept, so the trajectory's check refuses it.
    if (!(point.time_from_start <= age)) {
      point.time_from_start -= age;
      left.push_back(std::move(point));
    }
  }
  if (left.empty()) {
    refuse("its last point was " + number(age - request.points.back().time_from_start) +
           " s ago. Is the clock of the machine that sent it right?");
  }
  request.points = std::move(left);
  return request;
}

Trajectory::Trajectory(const TrajectoryRequest& request, const JointTable& table, const std::vector<Start>& start) {
  findJoints(request, table);
  checkPoints(request, table);
  const Point from = startingPoint(table, start);
  std::vector<Point> points = request.points;
  if (points.front().time_from_start == 0) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (std::abs(points.front().positions[i] - from.positions[i]) > kStartTolerance) {
        refuse("at time 0, " + table[joints_[i]].name + " would have to be at " + number(points.front().positions[i]) +
               " rad, but it is at " + number(from.positions[i]) +
               " rad: give the first point a later time_from_start");
      }
    }
    points.erase(points.begin());
  }
  addSegments(from, points);
  checkPositions(table);
  checkSpeeds(table);
}

double Trajectory::duration() const {
  return segments_.back().begin + segments_.back().length;
}

std::vector<Trajectory::Start> Trajectory::at(double time) const {
  const auto after = std::upper_bound(segments_.begin(), segments_.end(), time,
                                      [](double t, const Segment& segment) { return t < segment.begin; });
  const Segment& segment = after == segments_.begin() ? segments_.front() : *std::prev(after);
  const double t = std::clamp(time - segment.begin, 0.0, segment.length);
  std::vector<Start> states;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    states.push_back({joints_[i], segment.joints[i].at(t), time < duration() ? segment.joints[i].velocityAt(t) : 0});
  }
  return states;
}

void Trajectory::findJoints(const TrajectoryRequest& request, const JointTable& table) {
  for (const std::string& name : request.joints) {
    const std::optional<std::size_t> index = table.findByName(name);
    if (!index) {
      refuse("the " + table.design() + " has no joint '" + name + "'");
    }
    if (std::find(joints_.begin(), joints_.end(), *index) != joints_.end()) {
      refuse(name + " is named twice");
    }
    joints_.push_back(*index);
  }
  if (joints_.empty() || request.points.empty()) {
    refuse("it has points without joints, or joints without points");
  }
}

void Trajectory::checkPoints(const TrajectoryRequest& request, const JointTable& table) const {
  double last_time = -1;
  for (std::size_t i = 0; i < request.points.size(); ++i) {
    const Point& point = request.points[i];
    const std::string where = "point " + std::to_string(i);
    if (point.positions.size() != joints_.size()) {
      refuse(where + " has " + std::to_string(point.positions.size()) + " positions for " +
             std::to_string(joints_.size()) + " joints");
    }
    if (!point.velocities.empty() && point.velocities.size() != joints_.size()) {
      refuse(where + " has " + std::to_string(point.velocities.size()) + " velocities for " +
             std::to_string(joints_.size()) + " joints; give all or none");
    }
    if (!allFinite(point.positions) || !allFinite(point.velocities) || !std::isfinite(point.time_from_start)) {
      refuse(where + " has a number that is not finite");
    }
    if (point.time_from_start < 0 || point.time_from_start <= last_time) {
      refuse("the time_from_start of " + where + ", " + number(point.time_from_start) +
             " s, is below 0 or not later than the one before");
    }
    last_time = point.time_from_start;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const JointProperties& joint = table[joints_[j]];
      if (point.positions[j] < joint.lowest - kPositionTolerance ||
          point.positions[j] > joint.highest + kPositionTolerance) {
        refuse(where + " has " + joint.name + " at " + number(point.positions[j]) + " rad; it can go from " +
               number(joint.lowest) + " to " + number(joint.highest) + " rad");
      }
    }
  }
}

Point Trajectory::startingPoint(const JointTable& table, const std::vector<Start>& start) const {
  Point from;
  for (const std::size_t joint : joints_) {
    const auto found =
        std::find_if(start.begin(), start.end(), [joint](const Start& candidate) { return candidate.joint == joint; });
    if (found == start.end()) {
      refuse("the position of " + table[joint].name +
             " has not been measured yet: is the robot connected, and telemetry_rate above 0?");
    }
    from.positions.push_back(found->position);
    from.velocities.push_back(found->velocity);
  }
  return from;
}

void Trajectory::addSegments(const Point& from, const std::vector<Point>& points) {
  Point last = from;
  for (const Point& point : points) {
    Segment segment;
    segment.begin = last.time_from_start;
    segment.length = point.time_from_start - last.time_from_start;
    const double length = segment.length;
    const bool curved = !last.velocities.empty() && !point.velocities.empty();
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const double slope = (point.positions[i] - last.positions[i]) / length;
      const bool moves_already = segments_.empty() && last.velocities[i] != 0;
      if (curved || moves_already) {
        const double v0 = last.velocities[i];
        const double v1 = curved ? point.velocities[i] : slope;
        segment.joints.push_back(
            {{last.positions[i], v0, (3 * slope - 2 * v0 - v1) / length, (v0 + v1 - 2 * slope) / (length * length)}});
      } else {
        segment.joints.push_back({{last.positions[i], slope, 0, 0}});
      }
    }
    segments_.push_back(segment);
    last = point;
  }
  if (segments_.empty()) {  // without segments, the robot should stay where it is
    Segment stay;
    for (const double position : from.positions) {
      stay.joints.push_back({{position, 0, 0, 0}});
    }
    segments_.push_back(stay);
  }
}

void Trajectory::checkPositions(const JointTable& table) const {
  for (const Segment& segment : segments_) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const JointProperties& joint = table[joints_[i]];
      for (const double time : segment.joints[i].turningPoints(segment.length)) {
        const double position = segment.joints[i].at(time);
        // The trajectory may bring back a joint that somebody has bent beyond its limits.
        const double begin = segment.joints[i].at(0);
        if (position < std::min(joint.lowest, begin) - kPositionTolerance ||
            position > std::max(joint.highest, begin) + kPositionTolerance) {
          refuse("between two points, at " + number(segment.begin + time) + " s, the velocities carry " + joint.name +
                 " to " + number(position) + " rad; it can go from " + number(joint.lowest) + " to " +
                 number(joint.highest) + " rad");
        }
      }
    }
  }
}

void Trajectory::checkSpeeds(const JointTable& table) const {
  for (const Segment& segment : segments_) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const double limit = table.speedLimit(joints_[i]);
      const double speed = segment.joints[i].highestSpeed(segment.length);
      if (speed > limit * kSpeedTolerance) {
        refuse("from " + number(segment.begin) + " to " + number(segment.begin + segment.length) + " s, " +
               table[joints_[i]].name + " would have to move with " + number(speed) + " rad/s; its limit is " +
               number(limit) + " rad/s: give it more time");
      }
    }
  }
}

double Trajectory::Cubic::at(double t) const {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

double Trajectory::Cubic::velocityAt(double t) const {
  return c[1] + t * (2 * c[2] + t * 3 * c[3]);
}

double Trajectory::Cubic::highestSpeed(double length) const {
  double highest = std::max(std::abs(velocityAt(0)), std::abs(velocityAt(length)));
  if (c[3] != 0) {
    const double vertex = -c[2] / (3 * c[3]);
    if (vertex > 0 && vertex < length) {
      highest = std::max(highest, std::abs(velocityAt(vertex)));
    }
  }
  return highest;
}

// The times when the velocity, c[1] + 2 c[2] t + 3 c[3] t^2, is 0.
std::vector<double> Trajectory::Cubic::turningPoints(double length) const {
  std::vector<double> times;
  if (c[3] != 0) {
    const double root = std::sqrt(std::max(0.0, c[2] * c[2] - 3 * c[3] * c[1]));
    times = {(-c[2] - root) / (3 * c[3]), (-c[2] + root) / (3 * c[3])};
  } else if (c[2] != 0) {
    times = {-c[1] / (2 * c[2])};
  }
  times.erase(std::remove_if(times.begin(), times.end(), [length](double t) { return !(t > 0 && t < length); }),
              times.end());
  return times;
}

}  // namespace aibo_driver::movement
