/// @file fitted_motion.h
/// A motion as a robot can play it.
#ifndef AIBO_RCSERVER_MTN_FITTED_MOTION_H
#define AIBO_RCSERVER_MTN_FITTED_MOTION_H

#include <stddef.h>

#include "mtn/motion.h"
#include "robot_model/robot_model.h"

namespace mtn {

/// Fits a motion to a robot: it finds the joints and ears, moves positions into the robot's reach, and gives more time
/// to steps that are too fast. Only the joints decide whether the robot plays a motion, because Sony's motions name
/// their robot in many ways ("DRX-1000_Head").
///
/// A position is clipped if it is beyond a joint's limit, or if the joint would hit another joint of the motion there
/// (robot_model::clampPosture()). Joints outside the motion are assumed to be out of the way. No distance is too far:
/// motions of Sony's own software for the ERS-7 are up to 20 degrees off.
///
/// On the straight way between two key frames, a joint can hit another one even if it does not do so at the ends. The
/// key frames cannot avoid this, but JointPlanner does. describe() counts the joint as clipped.
///
/// The fitted key frames are computed on each call, because this object has no memory of its own.
class FittedMotion {
 public:
  /// 0.001 degree, in microradians. A position that exceeds a limit by no more than this counts as at the limit. The
  /// rounding in Sony's motions is about a tenth of this value.
  static const int TOLERANCE = 17;

  static const size_t MAX_PROBLEM_SIZE = 192;

  static const size_t MAX_DESCRIPTION_SIZE = 448;

  FittedMotion();

  /// @param motion, robot must outlive the object, or stay until the next fit()
  /// @param leave_out true: ignore joints that the robot lacks; at least one joint must be left
  /// @return false if the robot cannot play the motion; problem() then says why, and there are no joints and key frames
  bool fit(const Motion& motion, const robot_model::RobotModel& robot, bool leave_out);

  /// Why the last motion was refused, in words to put after its name: "NOD.MTN moves the joint ..."; empty if it was
  /// accepted.
  const char* problem() const { return problem_; }

  /// How many joints of the motion the robot lacks.
  int leftOut() const { return left_out_; }

  int numberOfKeyFrames() const { return number_of_key_frames_; }

  /// The motion's joints that the robot has, without ears.
  int numberOfJoints() const { return number_of_joints_; }

  /// @param i 0..numberOfJoints() - 1
  /// @return the joint's index in the robot's table
  int joint(int i) const { return joints_[i]; }

  /// @param joint index in the robot's table
  bool moves(int joint) const { return places_[joint] != robot_model::NO_JOINT; }

  /// The clipped positions of the joints in a key frame, in microradians.
  /// @param key_frame 0..numberOfKeyFrames() - 1
  /// @param[out] positions has room for numberOfJoints() positions
  void posture(int key_frame, int* positions) const;

  /// True if an ear's value changes at this key frame. An ear has two states, but its magnet must not hold it in one of
  /// them, so it only flicks whenever the value changes.
  /// @param key_frame 1..numberOfKeyFrames() - 1
  /// @param ear the ear's index in the robot's table
  bool flicks(int key_frame, int ear) const;

  /// The time from the previous key frame to this one, in milliseconds: the file's, or what the slowest joint needs.
  /// @param key_frame 1..numberOfKeyFrames() - 1
  /// @param speed_limits for each joint of the robot's table, in microradian/s, above 0
  int milliseconds(int key_frame, const int* speed_limits) const;

  /// Describes the changes in one line: "head_tilt is clipped by up to 5.0 degrees (at 800 ms), mouth by up to 1.8 (at
  /// 0 ms); 1 step is too fast (neck_tilt at 656 ms), so it takes 8.53 s, which is 0.19 s longer". At most three joints
  /// are named, those with the largest distances.
  /// @param[out] text room for MAX_DESCRIPTION_SIZE; empty if nothing changes
  void describe(const int* speed_limits, char* text) const;

 private:
  FittedMotion(const FittedMotion&);
  FittedMotion& operator=(const FittedMotion&);

  /// The largest distance by which a joint was clipped.
  struct Clip {
    int joint;     ///< index in the robot's table
    int distance;  ///< in microradians; 0 if the joint is not clipped
    int time;      ///< in milliseconds from the beginning of the motion
  };

  static bool isFarther(const Clip& a, const Clip& b);
  void clear();
  bool findParts(bool leave_out);
  void measureClips();
  void measureOnTheWay(const int* from, const int* to, int begin, int duration);
  void noteClip(int joint, double distance, double time);
  double slowestTime(int key_frame, const int* speed_limits, int* joint) const;
  int describeClips(char* text) const;
  int describeSteps(const int* speed_limits, char* text) const;

  const Motion* motion_;
  const robot_model::RobotModel* robot_;
  int number_of_key_frames_;
  int number_of_joints_;
  int joints_[robot_model::MAX_JOINTS];   ///< indices in the robot's table
  int columns_[robot_model::MAX_JOINTS];  ///< the joint's number in the motion
  int places_[robot_model::MAX_JOINTS];   ///< for each of the robot's joints, its place in joints_, or NO_JOINT
  int ears_[robot_model::MAX_EARS];       ///< the motion's number of each of the robot's ears, or NO_EAR
  int left_out_;
  Clip clips_[robot_model::MAX_JOINTS];  ///< for each of the robot's joints
  char problem_[MAX_PROBLEM_SIZE];
};

}  // namespace mtn

#endif  // AIBO_RCSERVER_MTN_FITTED_MOTION_H
