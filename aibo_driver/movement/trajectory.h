/// @file trajectory.h
#ifndef AIBO_DRIVER_MOVEMENT_TRAJECTORY_H
#define AIBO_DRIVER_MOVEMENT_TRAJECTORY_H

#include <cstddef>
#include <string>
#include <vector>

#include "movement/joint_table.h"

namespace aibo_driver::movement {

/// A user's request as in trajectory_msgs/JointTrajectory. It has not been checked.
struct TrajectoryRequest {
  struct Point {
    double time_from_start = 0;      ///< s
    std::vector<double> positions;   ///< rad, one for each joint
    std::vector<double> velocities;  ///< rad/s, one for each joint, or empty
  };

  std::vector<std::string> joints;
  std::vector<Point> points;
};

/// Leaves out the points that have passed when a trajectory begins late.
/// @param age how long ago it should have begun, in seconds; not below 0
/// @return the other points, with times from now
/// @throw InvalidArgumentException all points have passed
TrajectoryRequest dropPassedPoints(TrajectoryRequest request, double age);

/// A motion of some joints, from where they are now through given points. The motion keeps within the joints' limits.
///
/// Between two points that have velocities, it is a cubic polynomial with these velocities at its ends. Otherwise it is
/// a straight line. A joint that is moving when the trajectory begins keeps its velocity: its way to the first point is
/// a cubic polynomial. If that point has no velocities, the joint arrives there with the average velocity of this way.
class Trajectory {
 public:
  /// Where a joint is, and how fast it moves, when the trajectory begins or later.
  struct Start {
    std::size_t joint = 0;  ///< index in the table
    double position = 0;    ///< rad
    double velocity = 0;    ///< rad/s
  };

  /// @param start the state of each joint of the request; other joints are ignored
  /// @throw InvalidArgumentException a joint is unknown, is named twice, or has no start; a point's arrays have the
  ///   wrong length; a number is not finite; times do not increase; a position or speed limit is exceeded, at a point
  ///   or between two. The message names the joint and the limit.
  Trajectory(const TrajectoryRequest& request, const JointTable& table, const std::vector<Start>& start);

  /// The duration in seconds.
  double duration() const;

  /// Where the joints should be, and how fast they should move: not at all after the end.
  /// @param time in seconds; a time before the beginning means the beginning, one after the end means the end
  /// @return one for each joint of the request, in its order
  std::vector<Start> at(double time) const;

 private:
  /// c[0] + c[1] t + c[2] t^2 + c[3] t^3
  struct Cubic {
    double c[4];

    double at(double t) const;
    double velocityAt(double t) const;
    double highestSpeed(double length) const;
    std::vector<double> turningPoints(double length) const;
  };

  struct Segment {
    double begin = 0;  ///< s
    double length = 0;
    std::vector<Cubic> joints;
  };

  void findJoints(const TrajectoryRequest& request, const JointTable& table);
  void checkPoints(const TrajectoryRequest& request, const JointTable& table) const;
  TrajectoryRequest::Point startingPoint(const JointTable& table, const std::vector<Start>& start) const;
  void addSegments(const TrajectoryRequest::Point& from, const std::vector<TrajectoryRequest::Point>& points);
  void checkPositions(const JointTable& table) const;
  void checkSpeeds(const JointTable& table) const;

  std::vector<std::size_t> joints_;
  std::vector<Segment> segments_;  ///< at least one
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_TRAJECTORY_H
