/// @file JointWatch.h
/// Finds out when a joint does not follow what it is told.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_WATCH_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_WATCH_H

/// What a joint reports, 4 frames apart.
struct JointReading {
  int position;   ///< measured, in microradian
  int reference;  ///< where it was told to be then, in microradian
  int duty;       ///< of its motor: -512..512 is from full power backward to full power forward
};

/// Watches one joint. Pure logic.
///
/// A joint that is off its reference by more than TOLERANCE and has not moved by MOVEMENT for PATIENCE does not follow.
/// With its motor at HIGH_DUTY or more, something holds it: it is jammed. With less, the robot does not even try. All
/// four numbers are our choice: large enough for a joint that lags behind in a fast motion or hangs under its load, and
/// small enough to spare a motor that pushes in vain.
class JointWatch {
 public:
  enum Verdict {
    FOLLOWS,
    JAMMED,
    UNCONTROLLABLE,
    LIMP  ///< its motor got no gain; Look() never says so
  };

  static const int TOLERANCE = 174533;  ///< microradian: 10 degrees
  static const int MOVEMENT = 17453;    ///< microradian: 1 degree
  static const unsigned PATIENCE = 63;  ///< frames of 8 ms: half a second
  static const int HIGH_DUTY = 256;     ///< of 512

  JointWatch() : position_(0), since_(0) {}

  /// Starts over: the joint is here, and nothing is known of what was before.
  void Reset(int position, unsigned frame);

  /// To be called for each reading.
  /// @param frame of the reading, in frames of 8 ms
  /// @return FOLLOWS, or what is wrong, which then is said again after another PATIENCE only
  Verdict Look(const JointReading& reading, unsigned frame);

 private:
  int position_;    ///< where the joint moved or was where it was to be for the last time
  unsigned since_;  ///< frame of that
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_WATCH_H
