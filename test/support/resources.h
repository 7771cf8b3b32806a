/// @file resources.h
#ifndef TEST_SUPPORT_RESOURCES_H
#define TEST_SUPPORT_RESOURCES_H

#include <cstddef>
#include <string>

namespace test_support {

/// False under a sanitizer, which keeps freed memory: then memory says nothing.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryCounts = false;
#else
constexpr bool kMemoryCounts = true;
#endif

/// The resources that a process holds.
struct Resources {
  std::size_t descriptors = 0;
  std::size_t threads = 0;
  std::size_t resident_kilobytes = 0;

  /// @param process ID of a process; "self" = this one
  static Resources of(const std::string& process = "self");

  /// Waits until this process has no more descriptors and threads than this. @return what it has more; empty if nothing
  std::string growth() const;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_RESOURCES_H
