/// @file spin_check.h
#ifndef TEST_FAULT_CAMPAIGN_SPIN_CHECK_H
#define TEST_FAULT_CAMPAIGN_SPIN_CHECK_H

#include "campaign/experiment.h"
#include "support/proxy/fault.h"

namespace fault_bench {

/// Whether a thread waits, from the making of this on, or does the same in vain again and again.
class SpinCheck {
 public:
  /// @param mark of the thread (syscalls.h)
  explicit SpinCheck(int mark);

  /// A violation if the thread has been busy for most of the time.
  void conclude(Outcome* outcome) const;

 private:
  const int mark_;
  const TimePoint begin_;
  const Milliseconds busy_before_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_SPIN_CHECK_H
