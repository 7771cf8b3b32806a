/// @file MotionPlayer.h
/// The motions that are being played.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H

#include "protocol/text.h"
#include "rcserver/joints/MotionPlanner.h"
#include "rcserver/joints/PlayedMotion.h"
#include "robot_model/robot_model.h"

/// Plays motion files on the joints of a robot, several at once as long as no joint is in two of them. Pure logic.
///
/// Memory of a fixed size: MAX_PLAYING files of mtn::MAX_FILE_SIZE, 256 KiB.
///
/// A motion ends by itself, when it is stopped, when one of its joints is commanded by somebody else, whose command
/// counts, or when one of its joints does not follow. It always ends as a whole: half a motion can throw a robot over.
class MotionPlayer {
 public:
  /// Most motions at once: head, tail, mouth and legs.
  static const int MAX_PLAYING = 4;

  /// Room for what Play() has against a motion.
  static const size_t MAX_PROBLEM_SIZE = 256;

  /// Both must outlive this.
  MotionPlayer(MotionPlanner& planner, const robot_model::RobotModel& robot);

  /// Where to put the file that Play() is to play: room for mtn::MAX_FILE_SIZE bytes.
  /// @return NULL if MAX_PLAYING motions are being played
  unsigned char* FindRoom();

  /// Begins to play what is in FindRoom().
  /// @param size of the file, 1..mtn::MAX_FILE_SIZE
  /// @param repetitions not below 1
  /// @param commanded one element a joint: true if somebody has commanded it after the motion was asked for, whose
  ///   command counts. NULL: nobody has
  /// @return NULL, or why not, in words that a user can act on
  const char* Play(const protocol::MotionName& name, size_t size, int repetitions, const bool* commanded);

  /// Stops a motion, if it is being played; its joints brake, stop and hold.
  void Stop(const protocol::MotionName& name);
  void StopAll();

  /// Every motion ends when its present repetition does.
  void EndRepetitions();

  bool IsPlaying() const;

  /// A joint gets another command now: the motion that moves it is over.
  void JointIsCommanded(int joint);

  /// A joint does not follow: the motion that moves it is over.
  void JointFails(int joint);

  /// A motion that has been stopped because one of its joints does not follow.
  struct Failure {
    protocol::MotionName name;
    int joint;
  };

  /// What has failed since this was asked last.
  /// @return false if nothing has
  bool TakeFailure(Failure* failure);

  /// All motions are over, and failures no longer worth telling.
  void ClientGone();

  /// To be called before MotionPlanner::NextFrame(), once in each frame.
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
  Failure failures_[MAX_PLAYING];  ///< each of them with NO_JOINT if there is nothing to tell
  char problem_[MAX_PROBLEM_SIZE];
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H
