#include "ros/camera/file_saver.h"

#include <fcntl.h>
#include <strings.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace aibo_driver::node {
namespace {

namespace fs = std::filesystem;

std::string errorText(int error) {
  return std::strerror(error);
}

bool isJpegName(const fs::path& path) {
  const std::string extension = path.extension().string();
  return ::strcasecmp(extension.c_str(), ".jpg") == 0 || ::strcasecmp(extension.c_str(), ".jpeg") == 0;
}

/// A file under a name of its own, which vanishes unless it is renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    path_ = target.parent_path() /
            ("." + target.filename().string() + "." + std::to_string(::getpid()) + "." + std::to_string(counter++));
    // Mode 0666 less the umask, as for any file that a program writes for its user.
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
    throw SaveException("cannot " + what + ": " + errorText(errno));
  }

  fs::path path_;
  int descriptor_ = -1;
};

}  // namespace

std::string saveJpeg(const std::string& path, const std::vector<std::uint8_t>& jpeg) {
  if (!path.empty() && path.front() == '~') {
    throw SaveException("cannot write " + path + ": '~' is not expanded here; give the whole path");
  }
  std::error_code error;
  // An existing link is followed: what it points to is replaced, not the link.
  const fs::path target = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error || target.filename().empty() || path.back() == '/' || fs::is_directory(target, error)) {
    throw SaveException("cannot write '" + path + "': that names no file" +
                        (error ? " (" + error.message() + ")" : ""));
  }
  if (!isJpegName(path)) {
    throw SaveException("cannot write '" + path + "': the picture is a JPEG; name it " +
                        fs::path(path).replace_extension(".jpg").string());
  }
  if (!fs::is_directory(target.parent_path(), error)) {
    throw SaveException("cannot write " + target.string() + ": the folder " + target.parent_path().string() +
                        " does not exist on the driver's machine or may not be entered; make it first");
  }
  if (fs::exists(target, error) && !fs::is_regular_file(target, error)) {
    throw SaveException("cannot write " + target.string() + ": it exists and is no regular file");
  }
  TemporaryFile file(target);
  file.write(jpeg);
  file.renameTo(target);
  return target.string();
}

}  // namespace aibo_driver::node
