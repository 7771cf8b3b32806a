/// @file fitted_motion.h
/// A motion as a robot can play it.
#ifndef AIBO_RCSERVER_MTN_FITTED_MOTION_H
#define AIBO_RCSERVER_MTN_FITTED_MOTION_H

#include <stddef.h>

#include "mtn/motion.h"
#include "robot_model/robot_model.h"

namespace mtn {

/// Fits a motion to a robot: finds its joints and ears, moves positions into what the robot can reach, and gives more
/// time to the steps from key frame to key frame that are too fast for it.
///
/// Positions that are beyond a joint's limit, or where the joint would hit another one of the motion, are clipped, as
/// robot_model::clampPosture() does: joints that are not in the motion are assumed to be out of the way. Up to
/// MOST_CLIPPED is clipped, since the motions of Sony's own samples are up to 3 degrees off. A motion that is further
/// off is refused: the robot would do something else than its author meant, and might fall.
///
/// No memory of its own: what a key frame becomes is computed each time.
class FittedMotion {
 public:
  /// Positions that are no further beyond a limit than this are at it, in microradian: 0.001 degree. Sony's motions are
  /// rounded to about a tenth of that.
  static const int TOLERANCE = 17;

  /// How far a position may be beyond a limit, in microradian: 5 degrees. Our choice.
  static const int MOST_CLIPPED = 87266;

  /// Room for problem().
  static const size_t MAX_PROBLEM_SIZE = 192;

  /// Room for describe().
  static const size_t MAX_DESCRIPTION_SIZE = 320;

  /// What is different from the file.
  struct Changes {
    int left_out;            ///< joints that the robot does not have
    int clipped;             ///< positions that are beyond a limit by more than TOLERANCE
    int farthest;            ///< how far the farthest of them is, in microradian
    int farthest_joint;      ///< its joint, by its index in the robot's table
    int farthest_key_frame;  ///< its key frame
  };

  /// A motion without joints and key frames.
  FittedMotion();

  /// @param motion, robot must outlive this, or the next fit()
  /// @param leave_out the motion is played without the joints that the robot does not have, unless it has none of them
  /// @return false if the robot cannot play it: problem() says why, and this has no joints and key frames
  bool fit(const Motion& motion, const robot_model::RobotModel& robot, bool leave_out);

  /// What was wrong with the last motion; follows its name, as in "NOD.MTN moves the joint ..."; empty if it was
  /// accepted.
  const char* problem() const { return problem_; }

  const Changes& changes() const { return changes_; }

  int numberOfKeyFrames() const { return number_of_key_frames_; }

  /// Joints of the motion that the robot has, without its ears.
  int numberOfJoints() const { return number_of_joints_; }

  /// @param i 0..numberOfJoints() - 1
  /// @return the joint's index in the robot's table
  int joint(int i) const { return joints_[i]; }

  /// True if the motion moves this joint.
  /// @param joint index in the robot's table
  bool moves(int joint) const;

  /// The positions of the joints in a key frame, in microradian, clipped.
  /// @param key_frame 0..numberOfKeyFrames() - 1
  /// @param[out] positions room for numberOfJoints()
  void posture(int key_frame, int* positions) const;

  /// True if an ear of the robot has another value in this key frame than in the one before. An ear has two states, and
  /// its magnet must not hold one of them: so the ear flicks when the value changes, whatever the value is.
  /// @param key_frame 1..numberOfKeyFrames() - 1
  /// @param ear index in the robot's table
  bool flicks(int key_frame, int ear) const;

  /// Time from the previous key frame to this one, in milliseconds: as in the file, or as long as the slowest joint
  /// needs.
  /// @param key_frame 1..numberOfKeyFrames() - 1
  /// @param speed_limits for each joint of the robot's table, in microradian/s, above 0
  int milliseconds(int key_frame, const int* speed_limits) const;

  /// Describes all changes in one line, such as "2 positions are clipped, by up to 3.0 degrees (left_hind_knee at
  /// 2832 ms); 1 step is too fast, so it takes 8.53 s instead of 8.34 s".
  /// @param speed_limits as for milliseconds()
  /// @param[out] text room for MAX_DESCRIPTION_SIZE; empty if the motion is played as it is in the file
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
  int joints_[robot_model::MAX_JOINTS];   ///< in the robot's table
  int columns_[robot_model::MAX_JOINTS];  ///< the motion's number of each of them
  int ears_[robot_model::MAX_EARS];       ///< the motion's number of each ear of the robot, or NO_EAR
  Changes changes_;
  char problem_[MAX_PROBLEM_SIZE];
};

}  // namespace mtn

#endif  // AIBO_RCSERVER_MTN_FITTED_MOTION_H
