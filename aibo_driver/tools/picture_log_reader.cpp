#include "tools/picture_log_reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <cerrno>
#include <sstream>
#include <system_error>

namespace aibo_driver::tools {
namespace {

// About ten seconds of pictures: a picture that arrives later than that is not found.
constexpr std::size_t kEntriesKept = 300;

}  // namespace

PictureLogReader::PictureLogReader(const std::string& path)
    : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot open the picture log " + path);
  }
}

PictureLogReader::~PictureLogReader() {
  ::close(descriptor_);
}

void PictureLogReader::readNewLines() {
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = ::read(descriptor_, buffer.data(), buffer.size());
    if (count <= 0) {
      return;  // the end for now, or a pipe without new lines
    }
    unfinished_line_.append(buffer.data(), static_cast<std::size_t>(count));
    std::size_t line_begin = 0;
    for (std::size_t line_end; (line_end = unfinished_line_.find('\n', line_begin)) != std::string::npos;
         line_begin = line_end + 1) {
      takeLine(unfinished_line_.substr(line_begin, line_end - line_begin));
    }
    unfinished_line_.erase(0, line_begin);
  }
}

void PictureLogReader::takeLine(const std::string& line) {
  std::istringstream fields(line);
  std::int64_t nanoseconds = 0;
  Entry entry{};
  if (!(fields >> nanoseconds >> entry.bytes >> entry.checksum)) {
    return;
  }
  entry.camera_time = Time(std::chrono::nanoseconds(nanoseconds));
  entries_.push_back(entry);
  if (entries_.size() > kEntriesKept) {
    entries_.pop_front();
  }
}

std::optional<PictureLogReader::Time> PictureLogReader::cameraTime(const std::vector<std::uint8_t>& jpeg,
                                                                   Time arrival) const {
  boost::crc_32_type crc;
  crc.process_bytes(jpeg.data(), jpeg.size());
  const std::uint32_t checksum = crc.checksum();
  const auto newest = std::find_if(entries_.rbegin(), entries_.rend(), [&](const Entry& entry) {
    return entry.camera_time <= arrival && entry.bytes == jpeg.size() && entry.checksum == checksum;
  });
  if (newest == entries_.rend()) {
    return std::nullopt;
  }
  return newest->camera_time;
}

}  // namespace aibo_driver::tools
