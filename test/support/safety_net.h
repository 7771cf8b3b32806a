/// @file safety_net.h
#ifndef TEST_SUPPORT_SAFETY_NET_H
#define TEST_SUPPORT_SAFETY_NET_H

#include <chrono>

namespace test_support {

/// The limit of every wait for something that comes soon on an idle computer. Only a failing test waits this long, so
/// it is long enough for a computer that is very busy.
constexpr std::chrono::seconds kSafetyNet{60};

}  // namespace test_support

#endif  // TEST_SUPPORT_SAFETY_NET_H
