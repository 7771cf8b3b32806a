#include "memory_stick.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace test_support {
namespace {

namespace fs = std::filesystem;

}  // namespace

MemoryStick::MemoryStick(const std::string& settings) {
  std::string pattern = (fs::temp_directory_path() / "memory_stick.XXXXXX").string();
  path_ = ::mkdtemp(pattern.data());
  const fs::path original = fs::path(AIBO_RCSERVER).parent_path() / "../../share/aibo_driver/memory_stick";
  fs::copy(original, path_, fs::copy_options::recursive);
  std::ofstream(fs::path(path_) / "OPEN-R/MW/CONF/RCSERVER.CFG") << settings;
}

MemoryStick::~MemoryStick() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace test_support
