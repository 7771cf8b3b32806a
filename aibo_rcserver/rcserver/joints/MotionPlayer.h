#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H

#include "protocol/text.h"
#include "rcserver/joints/JointPlanner.h"
#include "rcserver/joints/OrderBook.h"
#include "rcserver/joints/PlayedMotion.h"
#include "robot_model/robot_model.h"

/// Plays motion files on the joints of a robot, several at once as long as no joint is in two of them.
///
/// The player's memory has a fixed size: MAX_PLAYING files of mtn::MAX_FILE_SIZE, 256 KiB.
///
/// A motion ends when it has been played or stopped, or when one of its joints gets another command or does not follow.
/// A motion always ends as a whole, because half a motion can make the robot fall.
class MotionPlayer {
 public:
  static const int MAX_PLAYING = OrderBook::MAX_MOTIONS;
  static const size_t MAX_PROBLEM_SIZE = 256;

  MotionPlayer(JointPlanner& planner, const robot_model::RobotModel& robot, OrderBook& orders);

  /// The place for the file that Play() plays, with room for mtn::MAX_FILE_SIZE bytes.
  /// @return NULL if MAX_PLAYING motions are being played
  unsigned char* FindRoom();

  /// Begins to play the file in FindRoom().
  /// @param size the size of the file, 1..mtn::MAX_FILE_SIZE
  /// @param repetitions not below 1
  /// @param leave_out true: play the motion without the joints that the robot does not have; false: refuse it
  /// @param commanded one element for each joint: true if it was commanded after the motion was requested. Such a
  ///   command takes precedence over the motion
  /// @param number of the request of version 2, otherwise 0
  /// @return NULL, or an error text that tells the user why the motion is not played
  const char* Play(const protocol::MotionName& name, size_t size, int repetitions, bool leave_out,
                   const bool* commanded, unsigned short number = 0);

  /// How the last motion that Play() began differs from its file, in one line (mtn::FittedMotion::describe()); empty if
  /// nothing differs.
  const char* Changes() const { return changes_; }

  /// Stops a motion, if it is being played. Its joints brake, stop and hold.
  /// @param name the motion's name; empty means all motions
  void Stop(const protocol::MotionName& name);

  void StopAll(const EndReason& reason);
  void StopMotionOf(int joint, const EndReason& reason);

  /// Makes every motion end after its current repetition.
  void EndRepetitions();

  bool IsPlaying() const;
  bool Moves(int joint) const { return FindMoving(joint) < MAX_PLAYING; }

  /// True once for each time that a motion makes this ear flick. Call this in each frame, or every few frames. Several
  /// motions may move the same ear.
  /// @param ear the ear's index in the robot's table
  bool TakeFlick(int ear);

  /// Call this once in each frame, before JointPlanner::NextFrame().
  void NextFrame();

 private:
  MotionPlayer(const MotionPlayer&);
  MotionPlayer& operator=(const MotionPlayer&);

  PlayedMotion* FindFree();
  bool FindsJointsFree(const PlayedMotion& motion);
  bool FindsJointsUncommanded(const PlayedMotion& motion, const bool* commanded);
  int FindMoving(int joint) const;
  void Stop(PlayedMotion& motion, const EndReason& reason);

  JointPlanner& planner_;
  const robot_model::RobotModel& robot_;
  OrderBook& orders_;
  PlayedMotion motions_[MAX_PLAYING];
  char problem_[MAX_PROBLEM_SIZE];
  char changes_[mtn::FittedMotion::MAX_DESCRIPTION_SIZE];
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLAYER_H
