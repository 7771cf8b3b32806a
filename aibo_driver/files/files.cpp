#include "files/files.h"

#include <fcntl.h>
#include <pwd.h>
#include <strings.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <system_error>

#include "host_files/file_descriptor.h"
#include "host_files/gzip.h"
#include "host_files/regular_file.h"
#include "host_files/replace_file.h"
#include "mtn/layout.h"
#include "mtn/motion.h"
#include "text/plain_text.h"

namespace aibo_driver::files {

using host_files::FileDescriptor;

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostGzipAdds = 1024;  // bytes, with the name of the file; our choice

/// Names this computer. Callers of a service need not be at the driver's computer.
std::string thisComputer() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string("the computer ") + name.data()
                                                          : "this computer";
}

[[noreturn]] void failToRead(const std::string& path, const std::string& why) {
  throw FileException("cannot read '" + path + "': " + why);
}

/// Checks a path for control characters. A zero byte would end the path for the system, after the end of the name was
/// checked. Other control characters would spoil the terminals and logs that show the name.
void checkPath(const std::string& path, const char* verb) {
  if (const std::string shown = text::plainLine(path, PATH_MAX); shown != path) {
    throw FileException(std::string("cannot ") + verb + " '" + shown +
                        "': the path is too long, or holds control characters");
  }
  if (!path.empty() && path.front() == '~') {
    throw FileException(std::string("cannot ") + verb + " '" + path +
                        "': '~' is not expanded here; give the whole path");
  }
}

/// The content of a gzipped file; of any other file, the file itself.
FileDescriptor unpacked(FileDescriptor file, std::size_t longest) {
  struct stat properties {};
  std::string begin(2, '\0');
  // Files of the kernel (as in /proc) have no size, and reading them may block.
  if (::fstat(file.get(), &properties) != 0 || properties.st_size == 0 ||
      ::pread(file.get(), begin.data(), begin.size(), 0) < 0 || !host_files::isGzipped(begin)) {
    return file;
  }
  const std::vector<std::uint8_t> bytes = host_files::readRegularFile(file.get(), longest + kMostGzipAdds);
  return memoryFile("what was gzipped", host_files::unpacked({bytes.begin(), bytes.end()}, longest));
}

bool isJpegName(const fs::path& path) {
  const std::string extension = path.extension().string();
  return ::strcasecmp(extension.c_str(), ".jpg") == 0 || ::strcasecmp(extension.c_str(), ".jpeg") == 0;
}

/// True if an existing file begins as a JPEG does. It may have just become anything, even a pipe without a writer.
bool isJpeg(const FileDescriptor& folder, const fs::path& name) {
  std::array<char, 3> begin{};
  const FileDescriptor file(::openat(folder.get(), name.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC));
  return file.valid() && ::read(file.get(), begin.data(), begin.size()) == static_cast<ssize_t>(begin.size()) &&
         begin == std::array<char, 3>{'\xff', '\xd8', '\xff'};
}

bool isWithin(const fs::path& folder, const fs::path& target) {
  return std::mismatch(folder.begin(), folder.end(), target.begin(), target.end()).first == folder.end();
}

/// The path of a folder with all links resolved.
fs::path canonicalFolder(const std::string& folder) {
  std::error_code error;
  const fs::path canonical = fs::canonical(folder, error);
  if (error) {
    throw FileException("cannot write to the folder for pictures, '" + folder + "': " + error.message() +
                        "; make it, or set ~picture_folder to another one");
  }
  return canonical;
}

/// The home folder of this process's user; empty if there is none.
fs::path userFolder() {
  const char* const home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') {
    return fs::absolute(home);
  }
  std::array<char, 4096> texts{};
  passwd entry{};
  passwd* found = nullptr;
  const int error = ::getpwuid_r(::getuid(), &entry, texts.data(), texts.size(), &found);
  return error == 0 && found != nullptr ? found->pw_dir : "";
}

/// Opens the folder of a file. After the path was checked, somebody who may write into the folder for pictures may
/// replace a folder there by a link to somewhere else. An open folder cannot be replaced.
FileDescriptor openFolderOf(const fs::path& target) {
  std::error_code error;
  FileDescriptor folder(::open(target.parent_path().c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!folder.valid()) {
    throw FileException("cannot write " + target.string() + ": the folder " + target.parent_path().string() +
                        " does not exist on " + thisComputer() + " or may not be entered; make it first");
  }
  if (fs::read_symlink("/proc/self/fd/" + std::to_string(folder.get()), error) != target.parent_path()) {
    throw FileException("cannot write " + target.string() + ": its folder was moved or replaced meanwhile");
  }
  return folder;
}

void checkTarget(const FileDescriptor& folder, const fs::path& target) {
  std::error_code error;
  if (fs::exists(target, error) && !fs::is_regular_file(target, error)) {
    throw FileException("cannot write " + target.string() + ": it exists and is not a regular file");
  }
  if (fs::exists(target, error) && !isJpeg(folder, target.filename())) {
    throw FileException("cannot write " + target.string() +
                        ": it exists and is not a JPEG, or cannot be read; give another name, or remove it");
  }
}

/// True if a segment belongs to the image itself.
/// @param segment the segment without its marker: two bytes for its size, then its content
bool isOfImage(std::uint8_t marker, const std::uint8_t* segment, std::size_t size) {
  constexpr std::uint8_t kComment = 0xFE;
  constexpr std::uint8_t kApplication0 = 0xE0;
  constexpr std::uint8_t kApplication15 = 0xEF;
  constexpr std::size_t kJfifSize = 16;  // JFIF 1.02, without a thumbnail
  if (marker == kApplication0 && size == kJfifSize) {
    return std::memcmp(segment + 2, "JFIF", sizeof("JFIF")) == 0;
  }
  return marker != kComment && (marker < kApplication0 || marker > kApplication15);
}

std::string fileNameOnRobot(const std::string& name, const std::string& ending) {
  std::string file = text::plainLine(name);
  if (!file.empty() && file.find('.') == std::string::npos) {
    file += ending;
  }
  std::transform(file.begin(), file.end(), file.begin(), [](unsigned char c) { return std::toupper(c); });
  return file;
}

}  // namespace

FileDescriptor openToRead(const std::string& path, std::size_t longest_unpacked) {
  checkPath(path, "read");
  std::error_code error;
  if (!fs::exists(path, error)) {
    failToRead(path, "there is no such file on " + thisComputer() +
                         " (working directory: " + fs::current_path(error).string() + ")");
  }
  try {
    return unpacked(host_files::openRegularFile(path), longest_unpacked);
  } catch (const host_files::Unreadable& why) {
    failToRead(path, why.what());
  }
}

FileDescriptor memoryFile(const std::string& name, const std::string& content) {
  FileDescriptor file(::memfd_create(name.c_str(), MFD_CLOEXEC));
  if (!file.valid() ||
      ::pwrite(file.get(), content.data(), content.size(), 0) != static_cast<ssize_t>(content.size())) {
    throw FileException("no memory for " + name + ": " + std::strerror(errno));
  }
  return file;
}

std::vector<std::uint8_t> loadFile(const std::string& path, std::size_t longest) {
  const FileDescriptor file = openToRead(path, longest);
  try {
    return host_files::readRegularFile(file.get(), longest);
  } catch (const host_files::Unreadable& why) {
    failToRead(path, why.what());
  }
}

std::vector<std::uint8_t> loadMotion(const std::string& path) {
  std::vector<std::uint8_t> content = loadFile(path, mtn::MAX_FILE_SIZE);
  mtn::Motion motion;
  if (!motion.read(content.data(), content.size())) {
    throw FileException("'" + path + "' is not a motion file: " + motion.problem());
  }
  return content;
}

std::string rosHome() {
  const char* const ros_home = std::getenv("ROS_HOME");
  if (ros_home != nullptr && *ros_home != '\0') {
    return fs::absolute(ros_home);
  }
  const fs::path home = userFolder();
  if (home.empty()) {
    throw FileException("there is no folder for pictures and calibrations: HOME is not set, and the user " +
                        std::to_string(::getuid()) + " has no home; set HOME or ROS_HOME");
  }
  return home / ".ros";
}

std::string pictureFolder(const std::string& chosen) {
  if (!chosen.empty()) {
    return chosen;
  }
  std::error_code error;
  const fs::path home = userFolder();
  return !home.empty() && fs::is_directory(home / "Pictures", error) ? (home / "Pictures").string() : rosHome();
}

std::vector<std::uint8_t> withoutComments(const std::vector<std::uint8_t>& jpeg) {
  constexpr std::size_t kStart = 2;  // the size of the marker SOI
  constexpr std::uint8_t kStartOfScan = 0xDA;
  std::vector<std::uint8_t> kept(jpeg.begin(),
                                 jpeg.begin() + static_cast<std::ptrdiff_t>(std::min(kStart, jpeg.size())));
  std::size_t at = kStart;
  while (at + 4 <= jpeg.size() && jpeg[at] == 0xFF) {
    const std::uint8_t marker = jpeg[at + 1];
    const std::size_t size = static_cast<std::size_t>(jpeg[at + 2] << 8 | jpeg[at + 3]);  // without the marker
    const auto begin = jpeg.begin() + static_cast<std::ptrdiff_t>(at);
    if (marker == kStartOfScan) {
      kept.insert(kept.end(), begin, jpeg.end());
      return kept;
    }
    if (marker == 0xFF) {  // a fill byte before the marker
      ++at;
      continue;
    }
    if (size < 2 || size > jpeg.size() - at - 2) {
      break;
    }
    if (isOfImage(marker, &jpeg[at + 2], size)) {
      kept.insert(kept.end(), begin, begin + 2 + static_cast<std::ptrdiff_t>(size));
    }
    at += 2 + size;
  }
  throw FileException("the picture is not a JPEG that can be saved: a segment at byte " + std::to_string(at) +
                      " is damaged");
}

std::string saveJpeg(const std::string& folder, const std::string& path, const std::vector<std::uint8_t>& jpeg) {
  checkPath(path, "write");
  const fs::path allowed = canonicalFolder(folder);
  std::error_code error;
  // Links are followed. The file that a link points to has to be in the folder, and is replaced instead of the link.
  const fs::path target = fs::weakly_canonical(allowed / path, error);
  if (error || target.filename().empty() || path.back() == '/' || fs::is_directory(target, error)) {
    throw FileException("cannot write '" + path + "': that does not name a file" +
                        (error ? " (" + error.message() + ")" : ""));
  }
  if (!isJpegName(path)) {
    throw FileException("cannot write '" + path + "': the picture is a JPEG; name it " +
                        fs::path(path).replace_extension(".jpg").string());
  }
  if (!isJpegName(target)) {
    throw FileException("cannot write '" + path + "': it is a link to " + target.string());
  }
  if (!isWithin(allowed, target)) {
    throw FileException("cannot write " + target.string() + ": it is not in the folder for pictures, " +
                        allowed.string() + "; ~picture_folder sets another one");
  }
  const FileDescriptor parent = openFolderOf(target);
  checkTarget(parent, target);
  const std::vector<std::uint8_t> saved = withoutComments(jpeg);
  try {
    host_files::replaceFile(parent.get(), target.filename(), {saved.begin(), saved.end()});
  } catch (const host_files::Unwritable& why) {
    throw FileException("cannot write " + target.string() + ": " + why.what());
  }
  return target.string();
}

void replaceFile(const std::string& path, const std::string& content) {
  checkPath(path, "write");
  try {
    host_files::replaceFile(path, content);
  } catch (const host_files::Unwritable& why) {
    throw FileException("cannot write '" + path + "': " + why.what());
  }
}

std::string nameForPicture() {
  using std::chrono::system_clock;
  const system_clock::time_point now = system_clock::now();
  const std::time_t second = system_clock::to_time_t(now);
  std::tm local = {};
  ::localtime_r(&second, &local);
  char date[32];
  std::strftime(date, sizeof date, "%Y%m%d_%H%M%S", &local);
  const auto since_epoch = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
  char name[64];
  std::snprintf(name, sizeof name, "aibo_%s_%03d.jpg", date, static_cast<int>(since_epoch.count() % 1000));
  return name;
}

std::string motionFileName(const std::string& name) {
  return fileNameOnRobot(name, ".MTN");
}

std::string pictureFileName(const std::string& name) {
  return fileNameOnRobot(name, ".JPG");
}

}  // namespace aibo_driver::files
