/// @file MotionPlayer.h
/// The motions that are being played.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H

#include "protocol/text.h"
#include "rcserver/joints/MotionPlanner.h"
#include "rcserver/joints/PlayedMotion.h"
#include "robot_model/robot_model.h"

/// Plays motion files on the joints of a robot, several at once as long as no joint is in two of them.
///
/// Its memory has a fixed size: MAX_PLAYING files of mtn::MAX_FILE_SIZE, 256 KiB.
///
/// A motion is over when it has been played or stopped, when one of its joints is commanded otherwise, or when one of
/// its joints does not follow. It always ends as a whole: half a motion can make the robot fall.
class MotionPlayer {
 public:
  /// Most motions at once: head, tail, mouth and legs.
  static const int MAX_PLAYING = 4;

  /// Room for a problem that Play() returns.
  static const size_t MAX_PROBLEM_SIZE = 256;

  /// Both must outlive this.
  MotionPlayer(MotionPlanner& planner, const robot_model::RobotModel& robot);

  /// Where the file for Play() goes: room for mtn::MAX_FILE_SIZE bytes.
  /// @return NULL if MAX_PLAYING motions are being played
  unsigned char* FindRoom();

  /// Begins to play the file in FindRoom().
  /// @param size of the file, 1..mtn::MAX_FILE_SIZE
  /// @param repetitions not below 1
  /// @param leave_out the motion is played without the joints that the robot does not have; otherwise it is refused
  /// @param commanded one element for each joint: true if it was commanded after the motion was requested. Such a
  /// command
  ///   has precedence over the motion. NULL: no joint was
  /// @return NULL, or why it is not played, in words that a user can act on
  const char* Play(const protocol::MotionName& name, size_t size, int repetitions, bool leave_out,
                   const bool* commanded);

  /// What the motion that Play() has begun last does differently than its file says, in one line such as "2 positions
  /// are clipped, by up to 3.0 degrees (left_hind_knee at 2832 ms)"; empty if it is played as it is.
  const char* Changes() const { return changes_; }

  /// Stops a motion, if it is being played; its joints brake, stop and hold.
  void Stop(const protocol::MotionName& name);
  void StopAll();

  /// Every motion ends with its present repetition.
  void EndRepetitions();

  bool IsPlaying() const;

  /// True once for each time that a motion makes this ear flick. Call in each frame or every few. Any number of motions
  /// may have ears.
  /// @param ear index in the robot's table
  bool TakeFlick(int ear);

  /// A joint gets another command: stops the motion that moves it.
  void JointIsCommanded(int joint);

  /// A joint does not follow: stops the motion that moves it, which TakeFailure() then returns.
  void JointFails(int joint);

  /// A motion that was stopped because one of its joints does not follow.
  struct Failure {
    protocol::MotionName name;
    int joint;
  };

  /// Returns each failed motion once.
  /// @return false if there is none
  bool TakeFailure(Failure* failure);

  /// Stops all motions and forgets failures.
  void ClientGone();

  /// Call once in each frame, before MotionPlanner::NextFrame().
  void NextFrame();

 private:
  MotionPlayer(const MotionPlayer&);
  MotionPlayer& operator=(const MotionPlayer&);

  PlayedMotion* FindFree();
  bool FindsJointsFree(const PlayedMotion& motion);
  bool FindsJointsUncommanded(const PlayedMotion& motion, const bool* commanded);
  PlayedMotion* FindMoving(int joint);

  MotionPlanner& planner_;
  const robot_model::RobotModel& robot_;
  PlayedMotion motions_[MAX_PLAYING];
  Failure failures_[MAX_PLAYING];  ///< with NO_JOINT where there is no failure
  char problem_[MAX_PROBLEM_SIZE];
  char changes_[mtn::FittedMotion::MAX_DESCRIPTION_SIZE];
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H
