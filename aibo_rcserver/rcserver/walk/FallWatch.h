#ifndef AIBO_RCSERVER_RCSERVER_WALK_FALL_WATCH_H
#define AIBO_RCSERVER_RCSERVER_WALK_FALL_WATCH_H

#include "robot_model/legs.h"

/// Evaluates the accelerometer and the paw switches.
///
/// - The robot lies if the accelerometer's up direction is more than 60 degrees from the body's: on its side or, if
///   neither side points up by more than 30 degrees, on its back. A sitting robot leans by 25 degrees.
/// - The robot is carried if it stands or walks and no paw touches the floor any more. Paws are ignored until three of
///   them have touched the floor at once since it stood up: they may be broken, the robot may be hung up for a test, or
///   it may lie on its shanks.
///
/// The acceleration is a mean of the last reports, because the legs of a robot that has fallen shake it while they
/// still walk. A verdict counts when it has been the same for PATIENCE, and a fall when the robot has lain for so long,
/// even if it tumbles from one side to another. A mean far below gravity, such as that of a missing accelerometer, is
/// ignored.
class FallWatch {
 public:
  enum Verdict { UPRIGHT, ON_LEFT_SIDE, ON_RIGHT_SIDE, UPSIDE_DOWN, CARRIED };

  static const unsigned PATIENCE = 50;  ///< frames of 8 ms: 0.4 s, a little less than a step. Our choice

  /// How many paws touch the floor at once when the robot stands well.
  static const int STANDING_PAWS = 3;

  struct Reading {
    double forward;                          ///< acceleration in m/s^2, positive if the nose points up
    double left;                             ///< positive if the left side points up
    double up;                               ///< about 9.8 for a robot that is upright
    bool paws[robot_model::NUMBER_OF_LEGS];  ///< those that touch the floor, in the order of robot_model::Leg
  };

  FallWatch() : mean_(), verdict_(UPRIGHT), since_(0), candidate_(UPRIGHT), candidate_since_(0), paws_work_(false) {}

  /// Call this for each report of the sensors.
  /// @param stands true if the robot stands or walks
  /// @param frame OPEN-R frame
  void Look(const Reading& reading, bool stands, unsigned frame);

  Verdict Now() const { return verdict_; }

  /// The verdict on the mean of the last reports.
  Verdict Last() const { return candidate_; }

  /// True if the robot lies on its side or its back.
  static bool IsFallen(Verdict verdict) { return verdict != UPRIGHT && verdict != CARRIED; }

  /// The number of frames since the robot fell or, if it has not fallen, since the verdict changed.
  unsigned Duration(unsigned frame) const { return frame - since_; }

  /// The verdict as text, such as "the robot lies on its left side"; NULL if it is upright.
  static const char* Words(Verdict verdict);

 private:
  Verdict Judge(const Reading& reading, bool stands);

  Reading mean_;  ///< the mean of the last reports; its paws are those of the last report
  Verdict verdict_;
  unsigned since_;  ///< frame in which the verdict changed or the robot fell
  Verdict candidate_;
  unsigned candidate_since_;  ///< frame in which the candidate came up
  bool paws_work_;            ///< STANDING_PAWS have touched the floor at once since the robot stood up
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_FALL_WATCH_H
