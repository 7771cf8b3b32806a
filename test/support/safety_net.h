/// @file safety_net.h
#ifndef TEST_SUPPORT_SAFETY_NET_H
#define TEST_SUPPORT_SAFETY_NET_H

#include <chrono>
#include <thread>

namespace test_support {

/// The limit of every wait for something that comes soon on an idle computer. Only a failing test waits this long, so
/// it is long enough for a computer that is very busy.
constexpr std::chrono::seconds kSafetyNet{60};

/// Asks again and again whether a condition holds, until it does or the time is over.
template <typename Condition>
bool eventually(const Condition& condition, std::chrono::milliseconds period = std::chrono::milliseconds(2)) {
  const auto end = std::chrono::steady_clock::now() + kSafetyNet;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(period);
  }
  return true;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_SAFETY_NET_H
