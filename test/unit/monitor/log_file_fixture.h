#ifndef TEST_UNIT_MONITOR_LOG_FILE_FIXTURE_H
#define TEST_UNIT_MONITOR_LOG_FILE_FIXTURE_H

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/temporary_folder.h"

namespace aibo_driver::tools {

/// A path for a log in a folder of its own. Both are deleted after the test.
class LogFileFixture : public testing::Test {
 protected:
  std::string path() const { return folder_.path("picture_log"); }
  std::uintmax_t sizeOfLog() const { return std::filesystem::file_size(path()); }
  void append(const std::string& text) const { std::ofstream(path(), std::ios::app) << text << std::flush; }
  void makePipe() const { ASSERT_EQ(0, ::mkfifo(path().c_str(), 0600)); }

 private:
  const test_support::TemporaryFolder folder_;
};

}  // namespace aibo_driver::tools

#endif  // TEST_UNIT_MONITOR_LOG_FILE_FIXTURE_H
