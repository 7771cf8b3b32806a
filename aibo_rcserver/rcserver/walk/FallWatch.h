/// @file FallWatch.h
/// Finds out when the robot has fallen or is carried.
#ifndef AIBO_RCSERVER_RCSERVER_WALK_FALL_WATCH_H
#define AIBO_RCSERVER_RCSERVER_WALK_FALL_WATCH_H

/// Looks at the accelerometer and the switches of the paws.
///
/// - The robot is on its side, or upside down, if what the accelerometer calls up is more than 60 degrees off the
///   body's, or more than 120. A robot that sits leans by 25 degrees.
/// - It is carried if it stands or walks, and no paw touches anything any more. Paws that have never touched anything
///   since it stood up say nothing: they may be broken, or the robot hangs on a string because its owner wants to see
///   it walk without a floor.
///
/// A verdict counts when it has been the same for PATIENCE. An accelerometer that measures much less than gravity, as
/// one that is missing, says nothing.
class FallWatch {
 public:
  enum Verdict { UPRIGHT, ON_ITS_SIDE, UPSIDE_DOWN, CARRIED };

  static const unsigned PATIENCE = 50;  ///< frames of 8 ms: 0.4 s, of which a step takes 0.5. Our choice

  /// What is measured at one time.
  struct Reading {
    double forward;  ///< acceleration in m/s^2, positive if the nose points up
    double left;     ///< positive if the left side points up
    double up;       ///< about 9.8 for a robot that is upright
    bool any_paw;    ///< a paw touches something
  };

  FallWatch() : verdict_(UPRIGHT), since_(0), candidate_(UPRIGHT), candidate_since_(0), paws_work_(false) {}

  /// Call for each report of the sensors.
  /// @param stands the legs bear the robot: it stands or walks
  /// @param frame OPEN-R frame
  void Look(const Reading& reading, bool stands, unsigned frame);

  Verdict Now() const { return verdict_; }

  /// How many frames it has been so.
  unsigned Duration(unsigned frame) const { return frame - since_; }

  /// What is the case, such as "the robot lies on its side"; NULL if it is upright.
  static const char* Words(Verdict verdict);

 private:
  Verdict Judge(const Reading& reading, bool stands);

  Verdict verdict_;
  unsigned since_;  ///< frame
  Verdict candidate_;
  unsigned candidate_since_;  ///< frame
  bool paws_work_;            ///< one of them has touched something since the robot stood up
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_FALL_WATCH_H
