#include "ros/body/file_loader.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace aibo_driver::node {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw LoadException("cannot read '" + path + "': " + why);
}

}  // namespace

std::vector<std::uint8_t> loadFile(const std::string& path, std::size_t longest) {
  if (!path.empty() && path.front() == '~') {
    fail(path, "'~' is not expanded here; give the whole path");
  }
  std::error_code error;
  if (!fs::exists(path, error)) {
    fail(path, "there is no such file on the driver's machine, whose working directory is " +
                   fs::current_path(error).string());
  }
  // Anything else, such as a pipe, could keep the caller waiting.
  if (!fs::is_regular_file(path, error)) {
    fail(path, "it is no regular file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    fail(path, std::strerror(errno));
  }
  std::vector<std::uint8_t> bytes(longest + 1);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (file.bad()) {
    fail(path, std::strerror(errno));
  }
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.size() > longest) {
    fail(path, "it has more than the " + std::to_string(longest) + " bytes allowed");
  }
  return bytes;
}

}  // namespace aibo_driver::node
