/// @file OTime.h
#ifndef OPENR_OTIME_H
#define OPENR_OTIME_H

#include <OPENR/OStatus.h>
#include <Types.h>
#include <time.h>

const sbyte otimeTIME_DIF_UNDEF = 0x7F;
const int otimeSTART_YEAR = 2000;

/// From 1970 to 2000, in seconds.
const time_t otimeSTART_CLOCK = 946684800;

/// The robot's time: universal time, in seconds since 1 January 2000, and the offset of its time zone.
class OTime {
 public:
  OTime() : clock_(0), timeDif_(0) {}
  /// @param clock universal time
  /// @param timeDif local time minus universal time in hours, -12..12
  OTime(time_t clock, sbyte timeDif) : clock_(clock), timeDif_(timeDif) {}

  time_t GetClock() const { return clock_; }
  sbyte GetTimeDif() const { return timeDif_; }
  time_t GetLocalTime() const { return clock_ + timeDif_ * 3600; }

  OStatus SetClock(time_t clock) {
    clock_ = clock;
    return oSUCCESS;
  }
  /// @return oINVALID_ARG, with nothing changed, if it is outside -12..12
  OStatus SetTimeDif(sbyte timeDif) {
    if (timeDif < -12 || timeDif > 12) {
      return oINVALID_ARG;
    }
    timeDif_ = timeDif;
    return oSUCCESS;
  }

  bool operator<(const OTime& other) const { return clock_ < other.clock_; }
  bool operator==(const OTime& other) const { return clock_ == other.clock_; }

 private:
  time_t clock_;
  sbyte timeDif_;
};

#endif  // OPENR_OTIME_H
