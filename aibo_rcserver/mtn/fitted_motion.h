/// @file fitted_motion.h
/// A motion as a robot can play it.
#ifndef AIBO_RCSERVER_MTN_FITTED_MOTION_H
#define AIBO_RCSERVER_MTN_FITTED_MOTION_H

#include <stddef.h>

#include "mtn/motion.h"
#include "robot_model/robot_model.h"

namespace mtn {

/// Fits a motion to a robot: it finds the joints and ears, moves positions into the robot's reach, and gives more time
/// to steps that are too fast.
///
/// A position is clipped if it is beyond a joint's limit, or if the joint would hit another joint of the motion there
/// (robot_model::clampPosture()). Joints outside the motion are assumed to be out of the way. Sony's own samples are up
/// to 3 degrees off. A motion that is off by more than MOST_CLIPPED is refused: the robot might fall.
///
/// The fitted key frames are computed on each call, because this object has no memory of its own.
class FittedMotion {
 public:
  /// 0.001 degree, in microradians. A position that exceeds a limit by no more than this counts as at the limit. The
  /// rounding in Sony's motions is about a tenth of this.
  static const int TOLERANCE = 17;

  /// How far a position may exceed a limit, in microradians: 5 degrees. The value is our choice.
  static const int MOST_CLIPPED = 87266;

  static const size_t MAX_PROBLEM_SIZE = 192;

  static const size_t MAX_DESCRIPTION_SIZE = 320;

  struct Changes {
    int left_out;            ///< joints that the robot lacks
    int clipped;             ///< positions that exceed a limit by more than TOLERANCE
    int farthest;            ///< largest distance of a clipped position from its limit, in microradians
    int farthest_joint;      ///< the joint of that position: index in the robot's table
    int farthest_key_frame;  ///< the key frame of that position
  };

  FittedMotion();

  /// @param motion, robot must outlive this object, or stay until the next fit()
  /// @param leave_out ignore joints that the robot lacks; at least one joint must be left
  /// @return false if the robot cannot play the motion; then problem() says why, and there are no joints and key frames
  bool fit(const Motion& motion, const robot_model::RobotModel& robot, bool leave_out);

  /// Why the last motion was refused, in words that follow its name: "NOD.MTN moves the joint ..."; empty if it was
  /// accepted.
  const char* problem() const { return problem_; }

  const Changes& changes() const { return changes_; }

  int numberOfKeyFrames() const { return number_of_key_frames_; }

  /// The motion's joints that the robot has, without ears.
  int numberOfJoints() const { return number_of_joints_; }

  /// @param i 0..numberOfJoints() - 1
  /// @return the joint's index in the robot's table
  int joint(int i) const { return joints_[i]; }

  /// @param joint index in the robot's table
  bool moves(int joint) const;

  /// The clipped positions of the joints in a key frame, in microradians.
  /// @param key_frame 0..numberOfKeyFrames() - 1
  /// @param[out] positions has room for numberOfJoints() positions
  void posture(int key_frame, int* positions) const;

  /// True if an ear's value changes at this key frame. An ear has two states, and its magnet must not hold one of them,
  /// so the ear flicks whenever the value changes.
  /// @param key_frame 1..numberOfKeyFrames() - 1
  /// @param ear index in the robot's table
  bool flicks(int key_frame, int ear) const;

  /// The time from the previous key frame to this one, in milliseconds: the file's, or what the slowest joint needs.
  /// @param key_frame 1..numberOfKeyFrames() - 1
  /// @param speed_limits for each joint of the robot's table, in microradian/s, above 0
  int milliseconds(int key_frame, const int* speed_limits) const;

  /// Describes all changes in one line: "2 positions are clipped, by up to 1.8 degrees (right_hind_elevator at 656 ms);
  /// 1 step is too fast, so it takes 8.53 s, which is 0.19 s longer".
  /// @param[out] text room for MAX_DESCRIPTION_SIZE; empty if nothing changes
  void describe(const int* speed_limits, char* text) const;

 private:
  FittedMotion(const FittedMotion&);
  FittedMotion& operator=(const FittedMotion&);

  void clear();
  bool findParts(bool leave_out);
  bool checkPositions();
  void countClipped(int key_frame, const int* posture);
  int describeSteps(const int* speed_limits, char* text) const;

  const Motion* motion_;
  const robot_model::RobotModel* robot_;
  int number_of_key_frames_;
  int number_of_joints_;
  int joints_[robot_model::MAX_JOINTS];   ///< indices in the robot's table
  int columns_[robot_model::MAX_JOINTS];  ///< the joint's number in the motion
  int ears_[robot_model::MAX_EARS];       ///< the motion's number of each of the robot's ears, or NO_EAR
  Changes changes_;
  char problem_[MAX_PROBLEM_SIZE];
};

}  // namespace mtn

#endif  // AIBO_RCSERVER_MTN_FITTED_MOTION_H
