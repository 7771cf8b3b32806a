/// @file HoldUpWatch.h
/// Finds out when requests may have waited for so long that nobody wants them to move the robot any more.
#ifndef AIBO_RCSERVER_RCSERVER_HOLD_UP_WATCH_H
#define AIBO_RCSERVER_RCSERVER_HOLD_UP_WATCH_H

/// Something happens at least every 40 ms: the joints report, the camera takes an image. So if nothing has happened for
/// LONGEST_PAUSE, this object was held up, and what a client has sent meanwhile waits in the IPStack. A client of
/// version 2 sends something at least every second. So if nothing has come from it for LONGEST_SILENCE, its messages
/// were held up on their way. In both cases, what waited comes at once, within CATCHING_UP. All three are our choice.
///
/// Times are in milliseconds, and may overflow.
class HoldUpWatch {
 public:
  static const unsigned LONGEST_PAUSE = 500;
  static const unsigned LONGEST_SILENCE = 1500;
  static const unsigned CATCHING_UP = 100;

  /// Why an order is refused that MayHaveWaited().
  static const char TOO_OLD[];

  HoldUpWatch() : has_begun_(false), last_(0), catches_up_since_(0), catches_up_(false) {}

  /// Something happens now. Call it first.
  void Happens(unsigned now) {
    if (has_begun_ && now - last_ >= LONGEST_PAUSE) {
      CatchUp(now);
    }
    has_begun_ = true;
    catches_up_ = catches_up_ && now - catches_up_since_ < CATCHING_UP;
    last_ = now;
  }

  /// What has been silent for LONGEST_SILENCE has sent something.
  void CatchUp(unsigned now) {
    catches_up_since_ = now;
    catches_up_ = true;
  }

  /// True if a request that comes now may have waited.
  bool MayHaveWaited() const { return catches_up_; }

 private:
  bool has_begun_;
  unsigned last_;
  unsigned catches_up_since_;
  bool catches_up_;
};

#endif  // AIBO_RCSERVER_RCSERVER_HOLD_UP_WATCH_H
