/// @file resources.h
#ifndef TEST_SUPPORT_RESOURCES_H
#define TEST_SUPPORT_RESOURCES_H

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "support/safety_net.h"

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
  static Resources of(const std::string& process = "self") {
    const std::filesystem::path folder = "/proc/" + process;
    const auto entries = [&](const char* name) {
      return static_cast<std::size_t>(
          std::distance(std::filesystem::directory_iterator(folder / name), std::filesystem::directory_iterator()));
    };
    Resources resources{entries("fd"), entries("task"), 0};
    std::ifstream status(folder / "status");
    for (std::string line; std::getline(status, line);) {
      if (line.rfind("VmRSS:", 0) == 0) {
        std::istringstream(line.substr(6)) >> resources.resident_kilobytes;
      }
    }
    return resources;
  }

  /// Waits until this process has no more descriptors and threads than this. @return what it has more; empty if nothing
  std::string growth() const {
    Resources now;
    eventually([&] {
      now = of();
      return now.descriptors <= descriptors && now.threads <= threads;
    });
    return (now.descriptors > descriptors ? std::to_string(now.descriptors - descriptors) + " descriptors more " : "") +
           (now.threads > threads ? std::to_string(now.threads - threads) + " threads more" : "");
  }
};

}  // namespace test_support

#endif  // TEST_SUPPORT_RESOURCES_H
