/// @file full_disk.h
#ifndef TEST_SUPPORT_FULL_DISK_H
#define TEST_SUPPORT_FULL_DISK_H

#include <sys/resource.h>

#include <csignal>

namespace test_support {

/// While it exists, writing fails at the 100th byte of each file, as on a full disk.
class FullDisk {
 public:
  FullDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit full = {100, limit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &full);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*const handler_)(int);
  rlimit limit_{};
};

}  // namespace test_support

#endif  // TEST_SUPPORT_FULL_DISK_H
