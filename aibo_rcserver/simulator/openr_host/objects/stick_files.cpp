// The file functions of loaded objects (Programmer's Guide, appendix A.1). scripts/openr_object lets the linker call
// these instead of the C library's. A path begins with /MS/, the root of the memory stick; case does not matter, and
// new files get names in capitals.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>

#include "simulator/openr_host/memory_stick.h"
#include "simulator/openr_host/objects/system.h"

namespace {

std::string inCapitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The path on this computer; empty, with errno, if its folder is not on the stick.
std::string onStick(const std::string& path) {
  const std::string root = "/MS/";
  const std::filesystem::path name = std::filesystem::path(path + "/").lexically_normal().parent_path();
  const std::string& stick = openr_host::System::current().memoryStick();
  if (name == "/MS") {
    return stick;
  }
  if (name.string().compare(0, root.size(), root) == 0) {
    const std::string on_stick = name.string().substr(root.size());
    const std::string folder = std::filesystem::path(on_stick).parent_path().string();
    if (openr_host::isOnMemoryStick(stick, on_stick)) {
      return openr_host::findOnMemoryStick(stick, on_stick).string();
    }
    if (openr_host::isOnMemoryStick(stick, folder)) {
      return (openr_host::findOnMemoryStick(stick, folder) / inCapitals(name.filename().string())).string();
    }
  }
  errno = ENOENT;
  return {};
}

template <typename Function, typename Result>
Result call(const char* path, Result failure, const Function& function) {
  const std::string file = onStick(path);
  return file.empty() ? failure : function(file.c_str());
}

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier): the linker's option --wrap chooses these names
extern "C" {
FILE* __wrap_fopen(const char* path, const char* mode);
int __wrap_open(const char* path, int flags, ...);
int __wrap_stat(const char* path, struct stat* status);
int __wrap___xstat(int version, const char* path, struct stat* status);
int __wrap_unlink(const char* path);
int __wrap_remove(const char* path);

FILE* __wrap_fopen(const char* path, const char* mode) {
  return call(path, static_cast<FILE*>(nullptr), [&](const char* file) { return fopen(file, mode); });
}

int __wrap_open(const char* path, int flags, ...) {
  return call(path, -1, [&](const char* file) { return open(file, flags | O_CLOEXEC, 0666); });
}

int __wrap_stat(const char* path, struct stat* status) {
  return call(path, -1, [&](const char* file) { return stat(file, status); });
}

// The function that stat() calls with glibc before 2.33.
int __wrap___xstat(int /*version*/, const char* path, struct stat* status) {
  return __wrap_stat(path, status);
}

int __wrap_unlink(const char* path) {
  return call(path, -1, [](const char* file) { return unlink(file); });
}

int __wrap_remove(const char* path) {
  return call(path, -1, [](const char* file) { return remove(file); });
}
}
// NOLINTEND(bugprone-reserved-identifier)
