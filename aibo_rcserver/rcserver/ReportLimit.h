/// @file ReportLimit.h
#ifndef AIBO_RCSERVER_RCSERVER_REPORTLIMIT_H
#define AIBO_RCSERVER_RCSERVER_REPORTLIMIT_H

#include <OPENR/ODataFormats.h>

/// Limits the console lines that clients cause by connecting and leaving: BURST lines may be printed at once, and one a
/// second on average.
class ReportLimit {
 public:
  static const unsigned BURST = 20;

  ReportLimit() : allowed_(BURST), refilled_(0), left_out_(0) {}

  /// True if a line may be printed now. It first prints how many lines were left out before.
  /// @param now in frames
  bool Admits(longword now);

 private:
  unsigned allowed_;
  longword refilled_;  ///< frame in which the last line became allowed
  unsigned left_out_;  ///< lines since the last one that was allowed
};

#endif  // AIBO_RCSERVER_RCSERVER_REPORTLIMIT_H
