/// @file OCalendarTime.h
#ifndef OPENR_OCALENDARTIME_H
#define OPENR_OCALENDARTIME_H

#include <OPENR/OTime.h>
#include <stdio.h>

/// An OTime's local date and time of day.
class OCalendarTime {
 public:
  OCalendarTime() { SetTime(OTime()); }
  // NOLINTNEXTLINE(google-explicit-constructor): as in the SDK
  OCalendarTime(const OTime& time) { SetTime(time); }
  OCalendarTime(time_t clock, sbyte timeDif) { SetTime(OTime(clock, timeDif)); }

  OStatus SetTime(const OTime& time) {
    const time_t local = otimeSTART_CLOCK + time.GetLocalTime();
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

  /// @param[out] text such as "Sun, 29 Feb 2004 09:00:00 +0900"; room for 32 characters
  void RFC2822(char* text) const {
    static const char kDays[] = "SunMonTueWedThuFriSat";
    static const char kMonths[] = "JanFebMarAprMayJunJulAugSepOctNovDec";
    const int length = snprintf(text, 32, "%.3s, %d %.3s %d %02d:%02d:%02d %c%02d00", kDays + 3 * dow_, day_,
                                kMonths + 3 * (month_ - 1), otimeSTART_YEAR + year_, hour_, min_, sec_,
                                timeDif_ < 0 ? '-' : '+', timeDif_ < 0 ? -timeDif_ : timeDif_);
    if (length >= 32) {
      text[0] = '\0';  // somebody has written other numbers into this object
    }
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
