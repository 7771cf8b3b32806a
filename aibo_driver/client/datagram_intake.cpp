#include "client/datagram_intake.h"

#include <algorithm>
#include <utility>

#include "client/call.h"

namespace aibo_client {

namespace version2 = protocol::version2;

void DatagramIntake::begin(const Start& start, TimePoint now) {
  DatagramIntake next(*context_);  // without the state of the previous request
  next.on_ = next.used_ = true;
  next.start_ = start;
  next.last_datagram_ = now;
  next.expectFrom(now);
  *this = std::move(next);
}

void DatagramIntake::heardByTcp(TimePoint now) {
  if (!tcp_worked_ && now >= good_picture_ + kMissing) {
    tcp_worked_ = now;
  }
}

bool DatagramIntake::arrived(const std::uint8_t* data, std::size_t size, TimePoint now) {
  version2::PictureDatagram datagram = {};
  if (const char* problem = version2::decodePictureDatagram(data, size, &datagram)) {
    refuse(problem);
    return false;
  }
  datagram.sequence -= start_.sequence;
  datagram.picture -= start_.picture;
  if (!isPossible(datagram)) {
    refuse("its number is impossible");
    return false;
  }
  const std::int64_t missing = datagram.sequence - next_sequence_;
  next_sequence_ += std::max<std::int64_t>(missing + 1, 0);
  ++context_->counters.datagrams;
  context_->counters.reordered_datagrams += missing < 0 ? 1 : 0;
  context_->counters.lost_datagrams += static_cast<std::uint64_t>(std::max<std::int64_t>(missing, 0));
  if (now > last_datagram_ + kOutage) {
    settle(std::int64_t{datagram.picture} - 1);
  }
  if (missing == 0 && datagram.picture == last_picture_) {
    const TimePoint::duration spacing = now - last_datagram_;
    spacing_ = spacing_ == TimePoint::duration::zero() ? spacing : spacing_ + (spacing - spacing_) / 16;
  }
  last_picture_ = datagram.picture;
  last_datagram_ = last_exchange_ = now;
  repeats_ = 0;
  if (!assembly_.add(datagram, data + version2::DATAGRAM_HEADER_SIZE, now)) {
    refuse("other parts of its picture describe the picture differently");
  }
  return true;
}

bool DatagramIntake::isPossible(const version2::PictureDatagram& datagram) const {
  return datagram.picture <= datagram.sequence && datagram.picture <= assembly_.lastSettled() + kMostPicturesAhead &&
         datagram.sequence <= next_sequence_ + kMostDatagramsAhead;
}

void DatagramIntake::goodPicture(std::int64_t number, TimePoint now) {
  settle(number);
  expectFrom(now);
}

void DatagramIntake::settle(std::int64_t number) {
  const std::uint64_t lost = assembly_.lost();
  assembly_.settle(number);
  context_->counters.lost_pictures += assembly_.lost() - lost;
}

DatagramIntake::Bytes DatagramIntake::takeStatus(TimePoint now) {
  const bool is_overdue = now >= nextLook();
  Status status = assembly_.status(is_overdue);
  if (!on_ || (!is_overdue && !isNew(status))) {
    return {};
  }
  repeats_ += is_overdue ? 1 : 0;
  last_exchange_ = now;
  told_ = status;
  status.picture += start_.picture;
  return encoded(status);
}

bool DatagramIntake::isNew(const Status& status) const {
  // Only the first 64 parts of a picture have bits of their own.
  const auto parts_in = [](const Status& each) {
    return each.first_part < 64 ? std::uint64_t{each.missing} << each.first_part : each.missing;
  };
  return status.picture != told_.picture || (parts_in(status) & ~parts_in(told_)) != 0;
}

DatagramIntake::TimePoint DatagramIntake::nextLook() const {
  if (!on_ || last_exchange_ == TimePoint() || repeats_ >= kMostRepeats) {
    return TimePoint::max();
  }
  const bool is_due = assembly_.isIncomplete() && spacing_ != TimePoint::duration::zero();
  const auto wait = is_due ? std::max<TimePoint::duration>(kShortest, kDatagrams * spacing_) : kPictureInterval;
  return last_exchange_ + std::min<TimePoint::duration>(wait, kPictureInterval) * (1 << repeats_);
}

void DatagramIntake::refuse(const std::string& problem) {
  ++context_->counters.bad_datagrams;
  context_->warnOnce("datagram", "sent a datagram that is dropped (" + problem + "); further ones are only counted");
}

DatagramIntake::TimePoint DatagramIntake::deadline(std::chrono::milliseconds extra_interval) const {
  if (on_ && assembly_.givenUpInARow() >= kMostGivenUp) {
    return last_datagram_;
  }
  return on_ && tcp_worked_ ? std::max(good_picture_ + kSilence + kMostGivenUp * extra_interval, *tcp_worked_ + kGrace)
                            : TimePoint::max();
}

std::string DatagramIntake::problem(TimePoint now, std::chrono::milliseconds extra_interval) const {
  if (now < deadline(extra_interval)) {
    return "";
  }
  if (assembly_.givenUpInARow() >= kMostGivenUp) {
    return "so many datagrams are lost that no picture is complete; smaller pictures get through a weak radio link "
           "better";
  }
  if (now < last_datagram_ + kSilence) {
    return "datagrams come, but no good picture: too many are lost, or somebody else sends some in the robot's name";
  }
  return "no datagram has come for 1 s, while TCP works; a firewall, a NAT or a tunnel between robot and computer does "
         "not let UDP through";
}

}  // namespace aibo_client
