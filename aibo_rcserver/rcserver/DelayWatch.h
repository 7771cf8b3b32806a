/// @file DelayWatch.h
/// Detects when requests of version 1 may have been delayed so long that they must not move the robot any more.
#ifndef AIBO_RCSERVER_RCSERVER_DELAY_WATCH_H
#define AIBO_RCSERVER_RCSERVER_DELAY_WATCH_H

/// An event arrives at least every 40 ms: a joint report or a camera image. If no event has arrived for LONGEST_PAUSE,
/// the server's process was held up, and the client's messages are waiting in the IPStack. They then arrive within
/// CATCHING_UP. Both values are our choice. Orders of version 2 say themselves when they are too old.
///
/// Times are in milliseconds, and may overflow.
class DelayWatch {
 public:
  static const unsigned LONGEST_PAUSE = 500;
  static const unsigned CATCHING_UP = 100;

  DelayWatch() : has_begun_(false), last_(0), catches_up_since_(0), catches_up_(false) {}

  /// Records an event. Call it before MayHaveWaited().
  void Happens(unsigned now) {
    if (has_begun_ && now - last_ >= LONGEST_PAUSE) {
      catches_up_since_ = now;
      catches_up_ = true;
    }
    has_begun_ = true;
    catches_up_ = catches_up_ && now - catches_up_since_ < CATCHING_UP;
    last_ = now;
  }

  /// True if a request that arrives now may have been delayed.
  bool MayHaveWaited() const { return catches_up_; }

 private:
  bool has_begun_;
  unsigned last_;
  unsigned catches_up_since_;
  bool catches_up_;
};

#endif  // AIBO_RCSERVER_RCSERVER_DELAY_WATCH_H
