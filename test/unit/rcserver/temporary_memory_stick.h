/// @file temporary_memory_stick.h
/// A memory stick that a test may write on.
#ifndef TEST_UNIT_RCSERVER_TEMPORARY_MEMORY_STICK_H
#define TEST_UNIT_RCSERVER_TEMPORARY_MEMORY_STICK_H

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

/// A copy of the server's memory stick in a temporary folder, which is removed at the end.
class TemporaryMemoryStick {
 public:
  TemporaryMemoryStick() {
    std::string pattern = (std::filesystem::temp_directory_path() / "memory_stick_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw std::runtime_error("no temporary folder " + pattern);
    }
    folder_ = pattern;
    std::filesystem::copy(MEMORY_STICK, folder_, std::filesystem::copy_options::recursive);
  }
  ~TemporaryMemoryStick() { std::filesystem::remove_all(folder_); }
  TemporaryMemoryStick(const TemporaryMemoryStick&) = delete;
  TemporaryMemoryStick& operator=(const TemporaryMemoryStick&) = delete;

  const char* folder() const { return folder_.c_str(); }

  /// @param name relative to the stick
  std::filesystem::path path(const std::string& name) const { return folder_ + "/" + name; }

  void write(const std::string& name, const std::string& content) {
    std::ofstream(path(name), std::ios::binary) << content;
  }

 private:
  std::string folder_;
};

#endif  // TEST_UNIT_RCSERVER_TEMPORARY_MEMORY_STICK_H
