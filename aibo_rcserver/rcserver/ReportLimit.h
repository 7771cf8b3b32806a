#ifndef AIBO_RCSERVER_RCSERVER_REPORTLIMIT_H
#define AIBO_RCSERVER_RCSERVER_REPORTLIMIT_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OSyslog.h>

#include "rcserver/Interval.h"

/// Limits the console lines that clients cause by connecting and leaving: BURST lines may be printed at once, and one a
/// second on average. Strangers, whose first bytes are not a client's, are reported together, once a minute at most: a
/// program such as a browser may try again without end.
class ReportLimit {
 public:
  static const unsigned BURST = 20;

  ReportLimit() : allowed_(BURST), refilled_(0), left_out_(0), strangers_(0), stranger_interval_(MINUTE) {}

  /// True if a line may be printed now. If lines were left out before, it first prints how many.
  /// @param now the present frame
  bool Admits(longword now) {
    const longword periods = (now - refilled_) / PERIOD;
    if (allowed_ + periods >= BURST) {
      allowed_ = BURST;
      refilled_ = now;
    } else {
      allowed_ += periods;
      refilled_ += periods * PERIOD;
    }
    if (allowed_ == 0) {
      ++left_out_;
      return false;
    }
    --allowed_;
    if (left_out_ > 0) {
      OSYSPRINT(("RCServer: %u lines about clients were left out\n", left_out_));
      left_out_ = 0;
    }
    return true;
  }

  /// Counts a stranger, whose connection was aborted.
  /// @param name of the stranger
  void CountStranger(const char* name, longword now) {
    ++strangers_;
    if (stranger_interval_.Chooses(now)) {
      OSYSPRINT(
          ("RCServer: %s is not a client: its first bytes are not a request, but may be a web browser's. %u such "
           "connections have been aborted since the last report\n",
           name, strangers_));
      strangers_ = 0;
    }
  }

 private:
  static const longword PERIOD = 125;  // frames of 8 ms
  static const longword MINUTE = 60 * PERIOD;

  unsigned allowed_;
  longword refilled_;   ///< frame in which the last line became allowed
  unsigned left_out_;   ///< lines since the last one that was allowed
  unsigned strangers_;  ///< since the last report on them
  Interval stranger_interval_;
};

#endif  // AIBO_RCSERVER_RCSERVER_REPORTLIMIT_H
