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

  /// Why a motion has ended.
  enum Cause {
    PLAYED,           ///< it has reached its end
    STOPPED,          ///< by its name, or with all others
    JOINT_COMMANDED,  ///< one of its joints got another command
    JOINT_HELD,       ///< one of its joints was told to hold
    EVERYTHING_HELD,  ///< all joints were told to hold
    MOTORS_OFF,       ///< the motors were switched off
    LEGS_TAKEN,       ///< the robot was told to walk, or to take a posture
    JOINT_FAILED      ///< one of its joints does not follow
  };

  /// Stops a motion, if it is being played; its joints brake, stop and hold.
  void Stop(const protocol::MotionName& name);

  /// Stops all motions for this reason.
  void StopAll(Cause cause);

  /// Stops the motion that moves this joint, if there is one, for this reason.
  void StopMotionOf(int joint, Cause cause);

  /// Every motion ends with its present repetition.
  void EndRepetitions();

  bool IsPlaying() const;

  /// True if a motion that is being played moves this joint.
  bool Moves(int joint) const { return FindMoving(joint) < MAX_PLAYING; }

  /// True once for each time that a motion makes this ear flick. Call in each frame or every few. Any number of motions
  /// may have ears.
  /// @param ear index in the robot's table
  bool TakeFlick(int ear);

  /// A motion that has ended.
  struct End {
    protocol::MotionName name;
    Cause cause;
    int joint;  ///< of JOINT_COMMANDED, JOINT_HELD and JOINT_FAILED; otherwise NO_JOINT
  };

  /// Most ends that are kept: those of all motions, twice. When there are more, the oldest is forgotten.
  static const int MAX_ENDS = 2 * MAX_PLAYING;

  /// Returns each end once, the oldest first.
  /// @return false if there is none
  bool TakeEnd(End* end);

  /// Stops all motions and forgets how motions have ended.
  void ClientGone();

  /// Call once in each frame, before MotionPlanner::NextFrame().
  void NextFrame();

 private:
  MotionPlayer(const MotionPlayer&);
  MotionPlayer& operator=(const MotionPlayer&);

  PlayedMotion* FindFree();
  bool FindsJointsFree(const PlayedMotion& motion);
  bool FindsJointsUncommanded(const PlayedMotion& motion, const bool* commanded);
  int FindMoving(int joint) const;
  void Stop(PlayedMotion& motion, Cause cause, int joint);
  void Report(const PlayedMotion& motion, Cause cause, int joint);

  MotionPlanner& planner_;
  const robot_model::RobotModel& robot_;
  PlayedMotion motions_[MAX_PLAYING];
  End ends_[MAX_ENDS];  ///< that have not been taken, the oldest first
  int number_of_ends_;
  char problem_[MAX_PROBLEM_SIZE];
  char changes_[mtn::FittedMotion::MAX_DESCRIPTION_SIZE];
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H
