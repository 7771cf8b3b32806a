#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_WATCH_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_WATCH_H

/// A joint's report, which comes every 4 frames.
struct JointReading {
  int position;   ///< measured, in microradian
  int reference;  ///< commanded at that time, in microradian
  int duty;       ///< the motor's duty: -FULL_DUTY is full power backward, and FULL_DUTY is full power forward
};

/// OJointValue::pwmDuty at full power, as Tekkotsu reads it on real robots.
const int FULL_DUTY = 512;

/// Detects when a joint does not follow its commands.
///
/// A joint does not follow if it is more than TOLERANCE away from its reference and has moved less than MOVEMENT for
/// PATIENCE. If its motor duty is HIGH_DUTY or more, it is jammed. If the duty is less, the motor is not being driven
/// towards the reference. All four numbers are our choice. They tolerate a joint that lags in a fast motion or sags
/// under its load, and they stop a blocked motor before it overheats.
class JointWatch {
 public:
  enum Verdict {
    FOLLOWS,
    JAMMED,
    UNCONTROLLABLE,
    LIMP  ///< its motor was never given a gain; Look() never returns this
  };

  static const int TOLERANCE = 174533;  ///< microradian: 10 degrees
  static const int MOVEMENT = 17453;    ///< microradian: 1 degree
  static const unsigned PATIENCE = 63;  ///< frames of 8 ms: half a second
  static const int HIGH_DUTY = FULL_DUTY / 2;

  JointWatch() : position_(0), since_(0) {}

  /// Restarts the watch, with the joint at this position.
  void Reset(int position, unsigned frame);

  /// Call this for each reading.
  /// @param frame the frame of the reading, in frames of 8 ms
  /// @return FOLLOWS, or the fault, which is returned again only after another PATIENCE
  Verdict Look(const JointReading& reading, unsigned frame);

 private:
  int position_;    ///< where the joint last moved or reached its reference
  unsigned since_;  ///< frame in which the joint was there
};

/// Detects when a joint with a fault follows its commands again. Since the joint was held, both it and its reference
/// must have moved by JointWatch::MOVEMENT. After that, the joint must have stayed within JointWatch::TOLERANCE of its
/// reference for JointWatch::PATIENCE. Moving a joint by hand is not enough.
class JointRecovery {
 public:
  JointRecovery() : is_awaited_(false), held_at_(0), since_(0) {}

  /// Call this when the joint is held at this position.
  void Reset(int position, unsigned frame);

  /// Call this when the joint has a fault.
  void Await() { is_awaited_ = true; }

  /// Call this when there is no fault to recover from.
  void Forget() { is_awaited_ = false; }

  /// Call this for each reading.
  /// @return true if the fault is over now
  bool Look(const JointReading& reading, unsigned frame);

 private:
  bool is_awaited_;
  int held_at_;
  unsigned since_;  ///< frame of the last reading at which the joint did not follow
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_WATCH_H
