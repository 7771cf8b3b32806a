/// @file memory_stick.h
#ifndef TEST_SUPPORT_MEMORY_STICK_H
#define TEST_SUPPORT_MEMORY_STICK_H

#include <string>

#include "support/temporary_folder.h"

namespace test_support {

/// A copy of the robot's memory stick in a temporary folder, for tests that change what is on it.
class MemoryStick {
 public:
  /// @param settings what its RCSERVER.CFG says, such as "ALLOW_UPLOAD=yes\n"
  explicit MemoryStick(const std::string& settings);

  const std::string& path() const { return folder_.path(); }

 private:
  const TemporaryFolder folder_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_MEMORY_STICK_H
