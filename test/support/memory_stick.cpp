#include "support/memory_stick.h"

#include <filesystem>
#include <fstream>

namespace test_support {

namespace fs = std::filesystem;

MemoryStick::MemoryStick(const std::string& settings) {
  const fs::path original = fs::path(AIBO_RCSERVER).parent_path() / "../../share/aibo_driver/memory_stick";
  fs::copy(original, path(), fs::copy_options::recursive);
  std::ofstream(fs::path(path()) / "OPEN-R/MW/CONF/RCSERVER.CFG") << settings;
}

}  // namespace test_support
