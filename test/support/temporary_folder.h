/// @file temporary_folder.h
#ifndef TEST_SUPPORT_TEMPORARY_FOLDER_H
#define TEST_SUPPORT_TEMPORARY_FOLDER_H

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace test_support {

/// An empty folder of its own, which goes with the object and all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((std::filesystem::temp_directory_path() / "aibo_driver_test.XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr) {
      throw std::filesystem::filesystem_error("no folder", path_, std::make_error_code(std::errc::io_error));
    }
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_TEMPORARY_FOLDER_H
