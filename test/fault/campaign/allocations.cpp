#include "campaign/allocations.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <new>

#include "campaign/syscalls.h"

namespace fault_bench::allocations {
namespace {

std::array<std::atomic<std::size_t>, syscalls::kMarks> largest{};

}  // namespace

std::size_t takeLargest(int mark) {
  return largest.at(static_cast<std::size_t>(mark)).exchange(0);
}

}  // namespace fault_bench::allocations

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace fault_bench::allocations {
namespace {

// The threads of one mark run one after the other, and only theirs is looked at.
void note(std::size_t size) {
  const int mark = syscalls::markOfThisThread();
  if (mark != syscalls::kUnmarked && size > largest[static_cast<std::size_t>(mark)]) {
    largest[static_cast<std::size_t>(mark)] = size;
  }
}

}  // namespace
}  // namespace fault_bench::allocations

// All other forms of new and delete end in these.
void* operator new(std::size_t size) {
  fault_bench::allocations::note(size);
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) {
    return memory;
  }
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

#endif
