#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_PLAYED_MOTION_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_PLAYED_MOTION_H

#include <stddef.h>

#include "mtn/fitted_motion.h"
#include "mtn/motion.h"
#include "protocol/text.h"
#include "rcserver/joints/JointPlanner.h"
#include "robot_model/robot_model.h"

/// Plays one motion file a number of times by setting the targets of its joints, frame by frame.
///
/// All joints first move to the first key frame together, none faster than APPROACH_SPEED. Then, in each frame of 8 ms,
/// their targets are on the straight line between two key frames. Because the planner can stop at every target, the
/// joints lag behind this line by up to 50 ms, and cut corners by the distance they need to stop. When they have
/// arrived at the last key frame, the next repetition begins like the first; a motion whose last key frame equals its
/// first one continues without a stop.
///
/// FittedMotion adapts positions that a joint cannot reach, and steps between key frames that are too fast for the
/// joints' speed limits. The limits at the beginning of the step count.
class PlayedMotion {
 public:
  /// Highest speed on the way to the first key frame, in microradian/s: 90 degrees per second, our choice. This is slow
  /// enough not to startle people, or to make the robot fall from any posture.
  static const int APPROACH_SPEED = 1570796;

  PlayedMotion();

  /// The memory for the file that Load() reads. Do not use it while IsPlaying().
  unsigned char* Room() { return file_; }

  /// Reads the motion that is in Room().
  /// @param size the size of the file, 0..mtn::MAX_FILE_SIZE
  /// @param leave_out true: leave out the joints that the robot does not have
  /// @return false if the file is not a motion, or if the robot cannot play it
  bool Load(const protocol::MotionName& name, size_t size, const robot_model::RobotModel& robot, bool leave_out);

  /// Why Load() failed, in words to put after the name, as in "NOD.MTN ...".
  const char* Problem() const { return problem_; }

  /// Begins to play the loaded motion with the next frame.
  /// @param repetitions not below 1
  /// @param order the order in the OrderBook
  void Start(int repetitions, int order);

  void EndRepetitions() { repetitions_left_ = 1; }

  bool IsPlaying() const { return phase_ != OVER; }
  int Order() const { return order_; }
  const char* Name() const { return name_; }
  bool Moves(int joint) const { return fitted_.moves(joint); }

  /// How the motion differs from its file, in one line; see FittedMotion::describe().
  /// @param[out] text room for mtn::FittedMotion::MAX_DESCRIPTION_SIZE; empty if nothing differs
  void DescribeChanges(const JointPlanner& planner, char* text) const;

  /// True if both move the same joint.
  /// @param[out] joint the joint that both move
  bool SharesJoint(const PlayedMotion& other, int* joint) const;

  /// Sets the targets for the next frame. Call it only if IsPlaying().
  void NextFrame(JointPlanner& planner);

  /// True once for each flick of an ear. An ear flicks at a key frame where its value changes.
  /// @param ear the ear's index in the robot's table
  bool TakeFlick(int ear);

  /// Ends the motion. Its joints brake, stop and hold.
  void Stop(JointPlanner& planner);

 private:
  enum Phase {
    OVER,
    BEGINNING,    ///< nothing has moved yet
    APPROACHING,  ///< on the way to the first key frame
    PLAYING,      ///< on the way to key_frame_
    ARRIVING      ///< waiting for the joints at the last key frame
  };

  void Approach(JointPlanner& planner);
  void GoTo(int key_frame, const JointPlanner& planner);
  void PassTime(const JointPlanner& planner);
  void FlickEars();
  void Repeat();
  bool IsClosed() const;
  bool HaveArrived(const JointPlanner& planner) const;
  int PositionNow(int i) const;
  void Follow(JointPlanner& planner) const;

  Phase phase_;
  int order_;
  protocol::MotionName name_;
  mtn::Motion motion_;
  mtn::FittedMotion fitted_;
  int repetitions_left_;                ///< how many repetitions are left, with the current one
  int key_frame_;                       ///< in PLAYING: the key frame that the joints move to, from 1
  int milliseconds_;                    ///< in PLAYING: since the previous key frame
  int duration_;                        ///< in PLAYING: milliseconds from the previous key frame to this one
  int begin_[robot_model::MAX_JOINTS];  ///< positions in the previous key frame
  int end_[robot_model::MAX_JOINTS];    ///< positions in key_frame_, or in the last one
  bool flicks_[robot_model::MAX_EARS];  ///< ears that have to flick
  char problem_[mtn::FittedMotion::MAX_PROBLEM_SIZE];
  unsigned char file_[mtn::MAX_FILE_SIZE];
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_PLAYED_MOTION_H
