/// @file FallWatch.h
/// Detects when the robot has fallen or is carried.
#ifndef AIBO_RCSERVER_RCSERVER_WALK_FALL_WATCH_H
#define AIBO_RCSERVER_RCSERVER_WALK_FALL_WATCH_H

/// Evaluates the accelerometer and the paw switches.
///
/// - The robot is on its side if the accelerometer's up direction is more than 60 degrees from the body's, and upside
///   down if it is more than 120 degrees from it. A sitting robot leans by 25 degrees.
/// - It is carried if it stands or walks and no paw touches the floor any more. Paws that have not touched the floor
///   since it stood up are ignored: they may be broken, or the robot may be hung up for a test.
///
/// A verdict counts when it has been the same for PATIENCE. A reading far below gravity, such as that of a missing
/// accelerometer, is ignored.
class FallWatch {
 public:
  enum Verdict { UPRIGHT, ON_ITS_SIDE, UPSIDE_DOWN, CARRIED };

  static const unsigned PATIENCE = 50;  ///< frames of 8 ms: 0.4 s, a little less than a step. Our choice

  /// The measurements of one frame.
  struct Reading {
    double forward;  ///< acceleration in m/s^2, positive if the nose points up
    double left;     ///< positive if the left side points up
    double up;       ///< about 9.8 for a robot that is upright
    bool any_paw;    ///< a paw touches the floor
  };

  FallWatch() : verdict_(UPRIGHT), since_(0), candidate_(UPRIGHT), candidate_since_(0), paws_work_(false) {}

  /// Call for each report of the sensors.
  /// @param stands true if the robot stands or walks
  /// @param frame OPEN-R frame
  void Look(const Reading& reading, bool stands, unsigned frame);

  Verdict Now() const { return verdict_; }

  /// Number of frames since the verdict changed.
  unsigned Duration(unsigned frame) const { return frame - since_; }

  /// The verdict as text, such as "the robot lies on its side"; NULL if it is upright.
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
