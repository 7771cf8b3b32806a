/// @file ReportLimit.h
#ifndef AIBO_RCSERVER_RCSERVER_REPORTLIMIT_H
#define AIBO_RCSERVER_RCSERVER_REPORTLIMIT_H

#include <OPENR/ODataFormats.h>

/// Limits the lines on the console that clients can cause without end, by connecting and leaving: BURST of them may
/// come at once, in the long run one a second.
class ReportLimit {
 public:
  static const unsigned BURST = 20;

  ReportLimit() : allowed_(BURST), refilled_(0), left_out_(0) {}

  /// True if a line may be printed now. Then it has printed how many were left out before.
  /// @param now in frames
  bool Admits(longword now);

 private:
  unsigned allowed_;
  longword refilled_;  ///< frame in which the last line became allowed
  unsigned left_out_;  ///< since the last one that was allowed
};

#endif  // AIBO_RCSERVER_RCSERVER_REPORTLIMIT_H
