/// @file process.h
#ifndef TEST_SUPPORT_PROCESS_H
#define TEST_SUPPORT_PROCESS_H

#include <sys/types.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host_files/file_descriptor.h"

namespace test_support {

/// A child process whose output is kept. It is killed with the object, and when the test program ends.
class Process {
 public:
  /// @param environment added to the environment of the test program
  explicit Process(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment = {});
  ~Process() { kill(); }

  /// Waits until the output so far, stdout and stderr, contains a match.
  /// @return the groups of the match
  /// @throw std::runtime_error it did not come in time; the text contains the output
  std::vector<std::string> waitForOutput(const std::string& pattern);

  std::string output() const;

  /// After SIGSTOP, waits until the process has stopped.
  void signal(int number) const;

  /// Ends it by SIGKILL, and reaps it.
  void kill();

  /// Waits for its end.
  /// @return the exit status, 128 + signal if a signal ended it; empty if it did not end in time
  std::optional<int> waitForExit(std::chrono::milliseconds timeout);

  bool isRunning() { return !waitForExit(std::chrono::milliseconds(0)).has_value(); }

  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;
  const host_files::FileDescriptor output_;  // a file in memory
  std::optional<int> exit_status_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROCESS_H
