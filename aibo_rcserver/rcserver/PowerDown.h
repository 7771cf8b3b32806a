#ifndef AIBO_RCSERVER_RCSERVER_POWER_DOWN_H
#define AIBO_RCSERVER_RCSERVER_POWER_DOWN_H

#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>

#include "rcserver/body/Body.h"
#include "rcserver/requests/FileJobs.h"
#include "rcserver/requests/Robot.h"

/// Carries out an order to switch the robot off or to reboot it. A client, the pause button or a low battery gives the
/// order. The motors go off at once, unless the robot has to lie down. After the client has been informed and has gone,
/// the robot lies down or goes off.
///
/// Either this class or the SDK's POWERMON.BIN has to observe the pause button and the battery. Otherwise, the button
/// does nothing and the battery runs down. A battery that is being charged never counts as low.
///
/// Times are OPEN-R frames.
class PowerDown {
 public:
  /// If the robot has not lain down this many frames after the order, its motors go off anyway: 10 s. It needs half of
  /// this time to lie down from any posture or walk.
  static const longword LYING_DOWN_FRAMES = 1250;

  /// Longest time, in frames, that a shutdown waits for the memory stick: 3 s, our choice. Without this wait, a file
  /// that is being replaced could be lost.
  static const longword FILE_FRAMES = 375;

  explicit PowerDown(const FileDesk& files)
      : files_(files),
        body_(NULL),
        was_pressed_(false),
        was_low_(false),
        order_(POWER_STAYS_ON),
        is_noted_(false),
        noted_since_(0),
        was_told_to_lie_down_(false) {}

  /// Call this once, before all other functions except Order().
  void Begin(Body* body) { body_ = body; }

  /// The order in force. A client's requests set it.
  PowerOrder& Order() { return order_; }

  /// True if the robot is going off, so that nobody commands it any more.
  bool IsOrdered() const { return order_ != POWER_STAYS_ON; }

  /// Asks OPEN-R to call an entry whenever the button or the battery changes (Level2 Reference Guide, page 79), and
  /// looks at the current status. If OPEN-R refuses, the console says so. A button that is already pressed is ignored
  /// until it is pressed again, because it may have booted the robot.
  /// @return see Look()
  const char* Observe(const OServiceEntry& entry);
  void Unobserve();

  /// Gives the order that follows from a status, and says so on the console.
  /// @return the reason, for the client; NULL if nothing changes
  const char* Look(const OPowerStatus& status);

  /// Call this when an order may have been given. The motors go off, unless the robot has to lie down.
  void Note(longword now);

  /// True if a client that waits for the memory stick must be dropped.
  bool IsOverdue(longword now) const { return is_noted_ && now - noted_since_ >= FILE_FRAMES; }

  /// Carries out the order, if there is one. The robot lies down if it has to. It goes off when it has lain down and
  /// the memory stick's job is done, or when this takes too long. Once the client is gone, call this in each frame.
  void CarryOut(longword now);

 private:
  bool MustWaitForFiles(longword now) const;
  void LieDown();
  void SwitchOff();

  const FileDesk& files_;
  Body* body_;
  OServiceEntry entry_;
  bool was_pressed_;
  bool was_low_;
  PowerOrder order_;
  bool is_noted_;
  longword noted_since_;
  bool was_told_to_lie_down_;
};

#endif  // AIBO_RCSERVER_RCSERVER_POWER_DOWN_H
