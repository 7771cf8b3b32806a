/// @file PlayedMotion.h
/// One motion on its way.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_PLAYED_MOTION_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_PLAYED_MOTION_H

#include <stddef.h>

#include "mtn/motion.h"
#include "protocol/text.h"
#include "rcserver/joints/MotionPlanner.h"
#include "robot_model/robot_model.h"

/// Finds the joints of a motion on a robot by their locators.
/// @param[out] joints their indices in the robot's table; room for mtn::MAX_JOINTS
/// @return NULL, or the locator of one that the robot does not have
const char* FindJoints(const mtn::Motion& motion, const robot_model::RobotModel& robot, int* joints);

/// Plays one motion file as often as it is told: gives its joints their targets, frame by frame. Pure logic.
///
/// First the joints go from where they are to the first key frame, all together, none faster than APPROACH_SPEED. Then,
/// in each frame of 8 ms, their targets are where the straight line between two key frames is at that time. As the
/// planner can stop at every target, the joints follow this line by up to 50 ms, and round a corner by the distance
/// they need to stop. When they have arrived at the last key frame, the next repetition begins like the first; a motion
/// whose last key frame is its first one goes on without a stop.
class PlayedMotion {
 public:
  /// Greatest speed on the way to the first key frame, in microradian/s: 90 degrees a second, so that nobody is
  /// frightened or thrown over, wherever the joints have been. Our choice.
  static const int APPROACH_SPEED = 1570796;

  PlayedMotion();

  /// Where to put the file that Load() is to read. Not while IsPlaying().
  unsigned char* Room() { return file_; }

  /// Reads the motion that is in Room().
  /// @param size of the file, 0..mtn::MAX_FILE_SIZE
  /// @return false if it is no motion, or if it moves a joint that the robot does not have
  bool Load(const protocol::MotionName& name, size_t size, const robot_model::RobotModel& robot);

  /// What Load() had against the file; to be read as "NOD.MTN ...".
  const char* Problem() const { return problem_; }

  /// Begins to play what has been loaded, with the next frame.
  /// @param repetitions not below 1
  void Start(int repetitions);

  /// The present repetition is the last one.
  void EndRepetitions() { repetitions_left_ = 1; }

  bool IsPlaying() const { return phase_ != OVER; }
  const char* Name() const { return name_; }
  bool Moves(int joint) const;

  /// True if both move the same joint.
  /// @param[out] joint that one
  bool SharesJoint(const PlayedMotion& other, int* joint) const;

  /// Sets the targets of the frame that comes next. Only if IsPlaying().
  void NextFrame(MotionPlanner& planner);

  /// It is over. Its joints brake, stop and hold.
  void Stop(MotionPlanner& planner);

 private:
  enum Phase {
    OVER,
    BEGINNING,    ///< nothing is moved yet
    APPROACHING,  ///< the first key frame
    PLAYING,      ///< on the way to key_frame_
    ARRIVING      ///< at the last one
  };

  PlayedMotion(const PlayedMotion&);
  PlayedMotion& operator=(const PlayedMotion&);

  void Approach(MotionPlanner& planner);
  void PassTime();
  void Repeat();
  bool IsClosed() const;
  bool HaveArrived(const MotionPlanner& planner) const;
  int PositionNow(int i) const;
  void Follow(MotionPlanner& planner) const;

  Phase phase_;
  protocol::MotionName name_;
  mtn::Motion motion_;
  int joints_[mtn::MAX_JOINTS];  ///< of the robot, one for each of the motion
  int repetitions_left_;         ///< the present one included
  int key_frame_;                ///< in PLAYING: that the joints are on their way to, not the first one
  int milliseconds_;             ///< in PLAYING: since the key frame before that one
  char problem_[mtn::Motion::MAX_PROBLEM_SIZE + 32];
  unsigned char file_[mtn::MAX_FILE_SIZE];
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_PLAYED_MOTION_H
