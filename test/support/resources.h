/// @file resources.h
#ifndef TEST_SUPPORT_RESOURCES_H
#define TEST_SUPPORT_RESOURCES_H

#include <cstddef>
#include <string>

namespace test_support {

/// How much memory a process holds, tells something: a sanitizer keeps what was freed.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryCounts = false;
#else
constexpr bool kMemoryCounts = true;
#endif

/// What a process holds.
struct Resources {
  std::size_t descriptors = 0;
  std::size_t threads = 0;
  std::size_t resident_kilobytes = 0;

  /// Of a process.
  /// @param process its number; "self" = this one
  static Resources of(const std::string& process = "self");

  /// Of this process, once what is being closed is closed.
  static Resources settled();

  /// What this process holds more than that now, waiting for it to let go; empty if nothing that counts.
  /// @param without_memory memory does not count
  std::string growth(bool without_memory) const;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_RESOURCES_H
