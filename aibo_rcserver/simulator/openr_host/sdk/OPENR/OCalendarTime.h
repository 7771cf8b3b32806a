/// @file OCalendarTime.h
#ifndef OPENR_OCALENDARTIME_H
#define OPENR_OCALENDARTIME_H

#include <OPENR/OTime.h>

/// An OTime's local date and time of day.
class OCalendarTime {
 public:
  OCalendarTime() { SetTime(OTime()); }
  // NOLINTNEXTLINE(google-explicit-constructor): as in the SDK
  OCalendarTime(const OTime& time) { SetTime(time); }
  OCalendarTime(time_t clock, sbyte timeDif) { SetTime(OTime(clock, timeDif)); }

  OStatus SetTime(const OTime& time) {
    const time_t local = time.GetLocalTime();
    struct tm parts;
    if (gmtime_r(&local, &parts) == 0) {
      return oINVALID_ARG;
    }
    year_ = parts.tm_year + 1900 - otimeSTART_YEAR;
    month_ = parts.tm_mon + 1;
    day_ = parts.tm_mday;
    hour_ = parts.tm_hour;
    min_ = parts.tm_min;
    sec_ = parts.tm_sec;
    dow_ = parts.tm_wday;
    timeDif_ = time.GetTimeDif();
    return oSUCCESS;
  }

  int year_;   ///< since otimeSTART_YEAR
  int month_;  ///< 1..12
  int day_;    ///< 1..31
  int hour_;
  int min_;
  int sec_;
  int dow_;  ///< 0..6, Sunday is 0
  sbyte timeDif_;
};

#endif  // OPENR_OCALENDARTIME_H
