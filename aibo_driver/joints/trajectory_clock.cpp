#include "joints/trajectory_clock.h"

#include <algorithm>

namespace aibo_driver::joints {

double TrajectoryClock::at(SteadyTime now) const {
  return std::chrono::duration<double>(now - start_ - excess(now)).count();
}

double TrajectoryClock::attend(SteadyTime now) {
  start_ += excess(now);
  attended_ = std::max(now, start_);
  return at(now);
}

TrajectoryClock::SteadyTime::duration TrajectoryClock::excess(SteadyTime now) const {
  const SteadyTime::duration gap = now - attended_;
  return gap > kLongestGap ? gap - period_ : SteadyTime::duration(0);
}

}  // namespace aibo_driver::joints
