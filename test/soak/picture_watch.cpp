#include "picture_watch.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <sstream>
#include <system_error>

namespace soak {
namespace {

using std::chrono::seconds;
using std::chrono::system_clock;

// A safety net for what comes within milliseconds.
constexpr seconds kPatience{2};

aibo_client::FileDescriptor makePipe(const std::string& path) {
  ::unlink(path.c_str());
  if (::mkfifo(path.c_str(), 0600) != 0) {
    throw std::system_error(errno, std::generic_category(), path);
  }
  // Opened for writing, too, so that it stays open when the robot is killed.
  aibo_client::FileDescriptor pipe(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  if (!pipe.valid()) {
    throw std::system_error(errno, std::generic_category(), path);
  }
  return pipe;
}

}  // namespace

PictureWatch::PictureWatch(const std::string& topic, const std::string& picture_log, Violations* violations)
    : violations_(violations), log_(makePipe(picture_log)) {
  subscriber_ =
      ros::NodeHandle().subscribe(topic, 1000, &PictureWatch::onPicture, this, ros::TransportHints().tcpNoDelay());
}

void PictureWatch::onPicture(const sensor_msgs::CompressedImage& picture) {
  const std::lock_guard<std::mutex> lock(mutex_);
  readLogLocked();
  for (const std::string& violation : audit_.published(picture.data, picture.header.stamp.toNSec())) {
    violations_->add(violation);
  }
  changed_.notify_all();
}

std::optional<std::chrono::duration<double>> PictureWatch::waitForPictureOf(PictureAudit::Time time, seconds patience) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!changed_.wait_for(lock, patience, [&] { return audit_.lastPublishedTime() >= time; })) {
    return std::nullopt;
  }
  return system_clock::now() - time;
}

void PictureWatch::beginCalm() {
  const std::lock_guard<std::mutex> lock(mutex_);
  audit_.setCalm(true);
}

void PictureWatch::endCalm() {
  std::unique_lock<std::mutex> lock(mutex_);
  readLogLocked();
  const std::uint64_t last = audit_.lastSent();
  if (!changed_.wait_for(lock, kPatience, [&] { return audit_.lastPublished() >= last; })) {
    violations_->add("the last " + std::to_string(last - audit_.lastPublished()) +
                     " pictures of a calm period were lost");
  }
  audit_.setCalm(false);
}

void PictureWatch::setDamaging(bool damaging) {
  const std::lock_guard<std::mutex> lock(mutex_);
  audit_.setDamaging(damaging);
}

void PictureWatch::readLog() {
  const std::lock_guard<std::mutex> lock(mutex_);
  readLogLocked();
}

void PictureWatch::readLogLocked() {
  std::array<char, 4096> buffer;
  for (ssize_t count; (count = ::read(log_.get(), buffer.data(), buffer.size())) > 0;) {
    unfinished_line_.append(buffer.data(), static_cast<std::size_t>(count));
  }
  const std::size_t end = unfinished_line_.rfind('\n') + 1;  // 0 if there is no whole line
  std::istringstream lines(unfinished_line_.substr(0, end));
  unfinished_line_.erase(0, end);
  for (std::string line; std::getline(lines, line);) {
    audit_.sent(line);
  }
}

PictureAudit PictureWatch::audit() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return audit_;
}

}  // namespace soak
