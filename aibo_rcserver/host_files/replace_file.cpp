#include "host_files/replace_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>

#include "host_files/file_descriptor.h"

namespace host_files {
namespace {

namespace fs = std::filesystem;

const std::string kPartPrefix = ".aibo_part.";

[[noreturn]] void fail() {
  throw Unwritable(std::strerror(errno));
}

/// Holds back signals to this thread while the object lives.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t all;
    sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_{};
};

void write(int file, const std::string& content) {
  for (std::size_t written = 0; written < content.size();) {
    const ssize_t count = ::write(file, content.data() + written, content.size() - written);
    if (count < 0 && errno != EINTR) {
      fail();
    }
    written += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
}

/// @return false if another program holds the lock; true also where there are no locks
bool lock(int file) {
  return ::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

/// Removes what killed programs have left.
void removeLeftovers(DIR* folder) {
  while (const dirent* entry = ::readdir(folder)) {
    if (std::strncmp(entry->d_name, kPartPrefix.c_str(), kPartPrefix.size()) == 0) {
      const FileDescriptor file(
          ::openat(::dirfd(folder), entry->d_name, O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
      if (file.get() >= 0 && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0) {
        ::unlinkat(::dirfd(folder), entry->d_name, 0);
      }
    }
  }
}

/// A new file, which is removed unless it gets its final name.
class Part {
 public:
  Part(int folder, mode_t mode) : folder_(folder), file_(-1) {
    do {
      name_ = kPartPrefix + std::to_string(std::random_device()());
      file_ = FileDescriptor(::openat(folder, name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
      if (file_.get() < 0 || ::fstat(file_.get(), &properties_) != 0) {
        fail();
      }
    } while (!lock(file_.get()) || isGone());  // another program has just taken the file for a leftover
  }
  ~Part() {
    if (!name_.empty()) {
      ::unlinkat(folder_, name_.c_str(), 0);
    }
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  void setMode(mode_t mode) {
    if (properties_.st_mode != mode && ::fchmod(file_.get(), mode & 0777U) != 0) {
      fail();
    }
  }

  void fill(const std::string& content) {
    write(file_.get(), content);
    if (::fsync(file_.get()) != 0) {
      fail();
    }
  }

  void rename(const std::string& name) {
    if (::renameat(folder_, name_.c_str(), folder_, name.c_str()) != 0) {
      fail();
    }
    name_.clear();
  }

 private:
  bool isGone() { return ::fstat(file_.get(), &properties_) == 0 && properties_.st_nlink == 0; }

  const int folder_;
  std::string name_;
  FileDescriptor file_;
  struct stat properties_ {};
};

bool isStandardOutput(const struct stat& properties) {
  struct stat output {};
  return ::fstat(STDOUT_FILENO, &output) == 0 && output.st_dev == properties.st_dev &&
         output.st_ino == properties.st_ino;
}

/// The path to which links lead, even if nothing is there.
fs::path followed(fs::path path) {
  constexpr int kMostLinks = 40;  // the same limit as in the kernel
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path;
}

}  // namespace

void replaceFile(const std::string& path, const std::string& content) {
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (!exists && errno != ENOENT) {  // the kernel may refuse to follow a stranger's link in /tmp
    fail();
  }
  if (exists && isStandardOutput(old)) {
    write(STDOUT_FILENO, content);
    return;
  }
  if (exists && !S_ISREG(old.st_mode)) {
    const FileDescriptor device(::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
    if (device.get() < 0) {
      fail();
    }
    write(device.get(), content);
    return;
  }
  const fs::path target = followed(path);
  if (target.filename().empty()) {
    throw Unwritable("that does not name a file");
  }
  const fs::path parent = target.has_parent_path() ? target.parent_path() : ".";
  const FileDescriptor folder(::open(parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() < 0) {
    throw Unwritable("the folder " + parent.string() + ": " + std::strerror(errno));
  }
  replaceFile(folder.get(), target.filename(), content);
}

void replaceFile(int folder, const std::string& name, const std::string& content) {
  const HeldSignals held;
  struct stat old {};
  const bool is_kept = ::fstatat(folder, name.c_str(), &old, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(old.st_mode);
  if (is_kept && ::faccessat(folder, name.c_str(), W_OK, AT_EACCESS) != 0) {
    fail();
  }
  const std::unique_ptr<DIR, int (*)(DIR*)> readable(  // null if the folder may not be read
      ::fdopendir(::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)), ::closedir);
  if (readable) {
    removeLeftovers(readable.get());
  }
  Part part(folder, is_kept ? 0600 : 0666);  // nobody else may read the file before it has the old mode
  if (is_kept) {
    part.setMode(old.st_mode);
  }
  part.fill(content);
  part.rename(name);
  if (readable) {
    ::fsync(::dirfd(readable.get()));
  }
}

}  // namespace host_files
