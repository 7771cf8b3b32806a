/// @file memory_stick.h
#ifndef TEST_SUPPORT_MEMORY_STICK_H
#define TEST_SUPPORT_MEMORY_STICK_H

#include <filesystem>
#include <string>

#include "support/temporary_folder.h"

namespace test_support {

/// A copy of the robot's memory stick, for tests that change what is on it.
class MemoryStick : public TemporaryFolder {
 public:
  MemoryStick() { std::filesystem::copy(MEMORY_STICK, path(), std::filesystem::copy_options::recursive); }

  /// @param settings content of its RCSERVER.CFG, such as "ALLOW_UPLOAD=yes\n"
  explicit MemoryStick(const std::string& settings) : MemoryStick() { write("OPEN-R/MW/CONF/RCSERVER.CFG", settings); }
};

}  // namespace test_support

#endif  // TEST_SUPPORT_MEMORY_STICK_H
