#include "motion_tool/archive.h"

#include <fcntl.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

#include "host_files/file_descriptor.h"
#include "host_files/gzip.h"
#include "host_files/regular_file.h"
#include "host_files/replace_file.h"
#include "mtn/layout.h"

namespace motion_tool {
namespace {

namespace fs = std::filesystem;

const std::string kMagic = "ODAR";
constexpr std::size_t kHeaderSize = 64;
constexpr std::size_t kCountOffset = 8;
constexpr std::size_t kEntrySizeOffset = 12;

constexpr std::size_t kEntrySize = 144;
constexpr std::size_t kTypeSize = 4;
constexpr std::size_t kNameSize = 128;
constexpr std::size_t kOffsetOffset = kTypeSize + kNameSize;
constexpr std::size_t kSizeOffset = kOffsetOffset + 4;

std::size_t decode32(const std::string& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i > 0; --i) {
    value = value << 8 | static_cast<unsigned char>(bytes[offset + i - 1]);
  }
  return value;
}

// The most bytes of all files together. Sony's memory sticks have 16 MB.
constexpr std::size_t kLongestContents = 64U << 20U;  // bytes

ArchivedFile readEntry(const std::string& bytes, std::size_t number) {
  const std::size_t entry = kHeaderSize + number * kEntrySize;
  const std::string name = bytes.substr(entry + kTypeSize, kNameSize);
  const std::size_t offset = decode32(bytes, entry + kOffsetOffset);
  const std::size_t size = decode32(bytes, entry + kSizeOffset);
  if (offset > bytes.size() || size > bytes.size() - offset) {
    throw std::runtime_error("file " + std::to_string(number + 1) + " of the archive is cut off: it has " +
                             std::to_string(size) + " bytes from byte " + std::to_string(offset) +
                             ", and the archive has " + std::to_string(bytes.size()));
  }
  return {name.substr(0, name.find('\0')), bytes.substr(offset, size)};
}

void unpackContent(ArchivedFile& file) {
  try {
    file.content = host_files::unpacked(std::move(file.content), kLongestContents);
  } catch (const host_files::Unreadable& why) {
    throw std::runtime_error(fileNameOf(file) + " in the archive cannot be unpacked: " + why.what());
  }
}

}  // namespace

bool isArchive(const std::string& bytes) {
  return bytes.compare(0, kMagic.size(), kMagic) == 0;
}

std::vector<ArchivedFile> readArchive(const std::string& bytes) {
  if (!isArchive(bytes)) {
    throw std::runtime_error("it is not an archive: it does not begin with " + kMagic);
  }
  if (bytes.size() < kHeaderSize) {
    throw std::runtime_error("the archive is cut off within its header");
  }
  const std::size_t entry_size = decode32(bytes, kEntrySizeOffset);
  if (entry_size != kEntrySize) {
    throw std::runtime_error("the archive has entries of " + std::to_string(entry_size) + " bytes; only " +
                             std::to_string(kEntrySize) + " are supported");
  }
  const std::size_t count = decode32(bytes, kCountOffset);
  if (count > (bytes.size() - kHeaderSize) / kEntrySize) {
    throw std::runtime_error("the archive is cut off: it claims to have " + std::to_string(count) + " files");
  }
  std::vector<ArchivedFile> files;
  std::size_t packed_size = 0;
  std::size_t size = 0;
  for (std::size_t i = 0; i < count; ++i) {
    files.push_back(readEntry(bytes, i));
    packed_size += files.back().content.size();
    if (packed_size > bytes.size()) {  // or a small archive could take hours
      throw std::runtime_error("the archive's files overlap");
    }
    unpackContent(files.back());
    size += files.back().content.size();
    if (size > kLongestContents) {  // a small archive could fill any disk
      throw std::runtime_error("the archive's files have more than 64 MiB unpacked");
    }
  }
  return files;
}

std::string fileNameOf(const ArchivedFile& file) {
  std::string name = file.name.empty() ? "_" : file.name;
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return c > '~' || (std::isalnum(c) == 0 && c != '-' && c != '_'); }, '_');
  if (name.front() == '-') {  // most programs would take the name for an option
    name.front() = '_';
  }
  const std::string begin = file.content.substr(0, 4);
  return name + (begin == mtn::MAGIC ? ".mtn" : begin == "RIFF" ? ".wav" : ".bin");
}

void unpack(const std::vector<ArchivedFile>& files, const std::string& folder, bool overwrite) {
  std::set<std::string> names;
  for (const ArchivedFile& file : files) {
    const std::string name = fileNameOf(file);
    if (!names.insert(name).second) {
      throw std::runtime_error("nothing was written: the archive has two files that would be named " + name);
    }
    if (!overwrite && fs::exists(fs::symlink_status(fs::path(folder) / name))) {
      throw std::runtime_error("nothing was written: " + (fs::path(folder) / name).string() +
                               " already exists; --force overwrites it");
    }
  }
  fs::create_directories(folder);
  const host_files::FileDescriptor opened(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!opened.valid()) {
    throw std::runtime_error(folder + " cannot be opened: " + std::strerror(errno));
  }
  for (const ArchivedFile& file : files) {
    try {
      host_files::replaceFile(opened.get(), fileNameOf(file), file.content);  // a link is replaced, not followed
    } catch (const host_files::Unwritable& why) {
      throw std::runtime_error((fs::path(folder) / fileNameOf(file)).string() + " cannot be written: " + why.what());
    }
  }
}

}  // namespace motion_tool
