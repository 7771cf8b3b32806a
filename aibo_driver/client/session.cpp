#include "client/session.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "aibo_driver/exceptions.h"
#include "aibo_driver/jpeg_inspector.h"
#include "client/fault.h"

namespace aibo_driver {
namespace {

// A connection on which nothing is due works if it stands for so long. One that the robot turns away is closed sooner.
constexpr std::chrono::milliseconds kSettleTime{1000};

protocol::BasicGetCommand makeCommand(char letter, int quality) {
  protocol::BasicGetCommand command;
  command.command = letter;
  command.identifier = static_cast<unsigned char>(quality);
  return command;
}

}  // namespace

Session::Session(std::string address, std::chrono::milliseconds read_timeout, const Notifier& notifier,
                 Counters& counters, TimePoint connected)
    : address_(std::move(address)),
      read_timeout_(read_timeout),
      notifier_(notifier),
      counters_(counters),
      connected_(connected),
      stream_(connected),
      stall_detector_(connected),
      last_sign_(connected) {}

void Session::add(PictureRequest request, TimePoint now) {
  request.since = now;
  requests_.add(std::move(request));
}

// One thing at a time: while a picture is owed, a toggle would have to wait behind it anyway, and a second `F` would
// leave open which answer belongs to which quality. `F` is never sent into the own stream.
std::optional<protocol::BasicGetCommand> Session::nextCommand(const StreamWish& wish, TimePoint now) {
  if (picture_owed_) {
    return std::nullopt;
  }
  if (wish.streaming != stream_.on()) {
    stream_.toggled(now);
    stall_detector_.restart(now);
    last_sign_ = now;
    return makeCommand(protocol::REQUEST_STREAM_TOGGLE, wish.jpeg_quality);
  }
  if (mayRequestPicture(now)) {
    picture_owed_ = true;
    last_sign_ = now;
    const int quality = requests_.front().quality;
    return makeCommand(protocol::REQUEST_PICTURE, quality == 0 ? wish.jpeg_quality : quality);
  }
  return std::nullopt;
}

bool Session::mayRequestPicture(TimePoint now) const {
  return !requests_.empty() && !stream_.on() && parser_.betweenReplies() && now >= stream_.drainedAt();
}

void Session::bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now) {
  counters_.bytes_received += size;
  heard_ = true;
  last_sign_ = now;
  now_ = now;
  if (stream_.on()) {
    stall_detector_.bytesArrived(now);
  } else if (!picture_owed_) {
    stream_.lateBytes(now);
  }
  try {
    parser_.feed(data, size, now, *this);
  } catch (const ProtocolException& error) {
    throw Fault::protocol(address_, error.what());
  }
}

void Session::onPicture(std::vector<std::uint8_t> jpeg, TimePoint first_byte_time) {
  JpegInspection inspection = inspectJpeg(jpeg.data(), jpeg.size());
  if (!inspection.good()) {
    onDamagedPicture(inspection.problem);
    return;
  }
  settled_ = true;
  if (!stream_.on() && !picture_owed_) {
    ++counters_.unexpected_pictures;
    if (stream_.isOverdue(now_)) {
      throw Fault::protocol(address_, "it goes on sending pictures although it was told to stop, or never asked");
    }
    return;
  }
  if (stream_.on() && stall_detector_.isStale(first_byte_time)) {
    ++counters_.stale_pictures;
    return;
  }
  auto picture = std::make_shared<Picture>();
  picture->jpeg = std::move(jpeg);
  picture->first_byte_time = first_byte_time;
  picture->width = inspection.width;
  picture->height = inspection.height;
  deliver(picture);
}

void Session::deliver(const PicturePtr& picture) {
  ++counters_.pictures;
  notifier_.picture(picture);
  if (picture_owed_) {
    picture_owed_ = false;
    requests_.answerFront(picture);
  } else {
    requests_.answerFromStream(picture);
  }
}

// If it was the answer to a request, the request is made again, as long as its time allows.
void Session::onDamagedPicture(const std::string& problem) {
  ++counters_.corrupt_pictures;
  picture_owed_ = false;
  if (problem != std::exchange(last_damage_, problem)) {
    notifier_.log(LogLevel::kWarn, address_ + " sent a damaged picture, which is dropped: " + problem + ".");
  }
}

void Session::onValueReply(const protocol::ValueReply& reply) {
  const bool error = reply.letter == protocol::REPLY_ERROR;
  const std::string code = "error code " + std::to_string(reply.value);
  if (error && picture_owed_) {
    settled_ = true;
    picture_owed_ = false;
    requests_.failFront(PictureAnswer::Outcome::kRefused, address_ + " refused to take a picture: " + code + ".");
  } else if (error && stream_.on()) {
    throw Fault::protocol(address_, "it refused to stream pictures: " + code);
  } else {
    notifier_.log(LogLevel::kWarn, address_ + " sent an answer that nobody had asked for: '" + reply.letter + "', " +
                                       std::to_string(reply.value) + ".");
  }
}

bool Session::pictureDue() const {
  return stream_.on() || picture_owed_ || !parser_.betweenReplies();
}

Session::TimePoint Session::silenceLimit() const {
  return pictureDue() ? last_sign_ + read_timeout_ : TimePoint::max();
}

void Session::checkDeadlines(TimePoint now) {
  if (now >= silenceLimit()) {
    throw Fault::silent(address_, read_timeout_);
  }
  const bool owed_in_vain = picture_owed_ && now >= requests_.front().deadline;
  const std::chrono::milliseconds allowed = owed_in_vain ? requests_.front().timeout : std::chrono::milliseconds(0);
  requests_.expire(now, last_damage_.empty() ? "." : "; the last one was damaged: " + last_damage_ + ".");
  if (owed_in_vain) {
    throw Fault::pictureOverdue(address_, allowed);
  }
  if (!pictureDue() && now >= connected_ + kSettleTime) {
    settled_ = true;
  }
}

Session::TimePoint Session::nextDeadline() const {
  TimePoint next = std::min(requests_.nextDeadline(), silenceLimit());
  if (stream_.on()) {
    next = std::min(next, stall_detector_.nextLook());
  } else if (!requests_.empty() && !picture_owed_ && parser_.betweenReplies()) {
    next = std::min(next, stream_.drainedAt());
  }
  if (!settled_ && !pictureDue()) {
    next = std::min(next, connected_ + kSettleTime);
  }
  return next;
}

}  // namespace aibo_driver
