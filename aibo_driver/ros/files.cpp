#include "ros/files.h"

#include <fcntl.h>
#include <strings.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace aibo_driver::node {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failToRead(const std::string& path, const std::string& why) {
  throw FileException("cannot read '" + path + "': " + why);
}

void refuseTilde(const std::string& path, const char* verb) {
  if (!path.empty() && path.front() == '~') {
    throw FileException(std::string("cannot ") + verb + " '" + path +
                        "': '~' is not expanded here; give the whole path");
  }
}

bool isJpegName(const fs::path& path) {
  const std::string extension = path.extension().string();
  return ::strcasecmp(extension.c_str(), ".jpg") == 0 || ::strcasecmp(extension.c_str(), ".jpeg") == 0;
}

/// A file with a name of its own, which is deleted unless it is renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    path_ = target.parent_path() /
            ("." + target.filename().string() + "." + std::to_string(::getpid()) + "." + std::to_string(counter++));
    // 0666 less the umask, as any file that a program writes for its user.
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
      fail("create a file in " + target.parent_path().string());
    }
  }

  ~TemporaryFile() {
    close();
    if (!path_.empty()) {
      ::unlink(path_.c_str());
    }
  }

  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(const std::vector<std::uint8_t>& bytes) {
    std::size_t written = 0;
    while (written < bytes.size()) {
      const ssize_t count = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
      if (count < 0 && errno != EINTR) {
        fail("write " + path_.string());
      }
      written += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
  }

  void renameTo(const fs::path& target) {
    if (::fsync(descriptor_) != 0 || close() != 0 || ::rename(path_.c_str(), target.c_str()) != 0) {
      fail("write " + target.string());
    }
    path_.clear();
  }

 private:
  int close() {
    const int result = descriptor_ < 0 ? 0 : ::close(descriptor_);
    descriptor_ = -1;
    return result;
  }

  [[noreturn]] static void fail(const std::string& what) {
    throw FileException("cannot " + what + ": " + std::strerror(errno));
  }

  fs::path path_;
  int descriptor_ = -1;
};

}  // namespace

std::vector<std::uint8_t> loadFile(const std::string& path, std::size_t longest) {
  refuseTilde(path, "read");
  std::error_code error;
  if (!fs::exists(path, error)) {
    failToRead(path, "there is no such file on the driver's machine, whose working directory is " +
                         fs::current_path(error).string());
  }
  // Reading anything else, such as a pipe, could block.
  if (!fs::is_regular_file(path, error)) {
    failToRead(path, "it is not a regular file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    failToRead(path, std::strerror(errno));
  }
  std::vector<std::uint8_t> bytes(longest + 1);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (file.bad()) {
    failToRead(path, std::strerror(errno));
  }
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.size() > longest) {
    failToRead(path, "it has more than the " + std::to_string(longest) + " bytes allowed");
  }
  return bytes;
}

std::string saveJpeg(const std::string& path, const std::vector<std::uint8_t>& jpeg) {
  refuseTilde(path, "write");
  std::error_code error;
  // Follows a link: the file that it points to is replaced, not the link.
  const fs::path target = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error || target.filename().empty() || path.back() == '/' || fs::is_directory(target, error)) {
    throw FileException("cannot write '" + path + "': that does not name a file" +
                        (error ? " (" + error.message() + ")" : ""));
  }
  if (!isJpegName(path)) {
    throw FileException("cannot write '" + path + "': the picture is a JPEG; name it " +
                        fs::path(path).replace_extension(".jpg").string());
  }
  if (!fs::is_directory(target.parent_path(), error)) {
    throw FileException("cannot write " + target.string() + ": the folder " + target.parent_path().string() +
                        " does not exist on the driver's machine or may not be entered; make it first");
  }
  if (fs::exists(target, error) && !fs::is_regular_file(target, error)) {
    throw FileException("cannot write " + target.string() + ": it exists and is not a regular file");
  }
  TemporaryFile file(target);
  file.write(jpeg);
  file.renameTo(target);
  return target.string();
}

}  // namespace aibo_driver::node
