/// @file allocations.h
/// Takes the place of operator new in the program that it is linked into, and remembers how much was asked for at once.
#ifndef TEST_FAULT_CAMPAIGN_ALLOCATIONS_H
#define TEST_FAULT_CAMPAIGN_ALLOCATIONS_H

#include <cstddef>

namespace fault_bench::allocations {

/// The most bytes that threads with this mark (syscalls.h) have asked for at once, since this was called last. Under a
/// sanitizer, which has an operator new of its own, 0.
std::size_t takeLargest(int mark);

}  // namespace fault_bench::allocations

#endif  // TEST_FAULT_CAMPAIGN_ALLOCATIONS_H
