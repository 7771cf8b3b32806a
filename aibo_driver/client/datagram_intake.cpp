#include "client/datagram_intake.h"

#include <algorithm>

namespace aibo_driver {

namespace version2 = protocol::version2;

void DatagramIntake::begin(TimePoint now) {
  on_ = true;
  used_ = true;
  window_ = {};
  assembly_ = {};
  newest_ = acknowledged_ = -1;
  to_acknowledge_.reset();
  expectFrom(now);
}

void DatagramIntake::expectFrom(TimePoint now) {
  last_datagram_ = now;
  tcp_worked_.reset();
}

void DatagramIntake::heardByTcp(TimePoint now) {
  if (!tcp_worked_ && now >= last_datagram_ + kMissing) {
    tcp_worked_ = now;
  }
}

std::optional<PictureAssembly::Whole> DatagramIntake::arrived(const std::uint8_t* data, std::size_t size,
                                                              TimePoint now) {
  version2::PictureDatagram datagram = {};
  if (const char* problem = version2::decodePictureDatagram(data, size, &datagram)) {
    refuse(problem);
    return std::nullopt;
  }
  const std::uint64_t lost = window_.lost();
  const SequenceWindow::Verdict verdict =
      datagram.picture > datagram.sequence ? SequenceWindow::Verdict::kImpossible : window_.add(datagram.sequence);
  if (verdict == SequenceWindow::Verdict::kImpossible) {
    refuse("its number is impossible");
    return std::nullopt;
  }
  context_.counters.lost_datagrams += window_.lost() - lost;
  count(verdict);
  something_came_ = true;
  expectFrom(now);
  std::optional<PictureAssembly::Whole> whole;
  const std::uint64_t lost_pictures = assembly_.lost();
  if (assembly_.add(datagram, data + version2::DATAGRAM_HEADER_SIZE, now, &whole) ==
      PictureAssembly::Result::kContradiction) {
    refuse("other parts of its picture describe the picture differently");
  }
  context_.counters.lost_pictures += assembly_.lost() - lost_pictures;
  acknowledge(datagram);
  return whole;
}

// When the last part has come, or, if that is lost, a part of the next picture.
void DatagramIntake::acknowledge(const version2::PictureDatagram& datagram) {
  const std::int64_t before = newest_;
  newest_ = std::max<std::int64_t>(newest_, datagram.picture);
  const bool is_last = datagram.part + 1U == version2::numberOfParts(datagram.jpeg_size);
  const std::int64_t done = is_last ? datagram.picture : newest_ > before ? before : -1;
  if (done > acknowledged_) {
    acknowledged_ = done;
    to_acknowledge_ = static_cast<std::uint32_t>(done);
  }
}

void DatagramIntake::count(SequenceWindow::Verdict verdict) {
  Counters& counters = context_.counters;
  ++counters.datagrams;
  counters.reordered_datagrams += verdict == SequenceWindow::Verdict::kReordered ? 1 : 0;
  counters.duplicate_datagrams += verdict == SequenceWindow::Verdict::kDuplicate ? 1 : 0;
}

void DatagramIntake::refuse(const std::string& problem) {
  ++context_.counters.bad_datagrams;
  if (!warned_) {
    warned_ = true;
    context_.warn("sent a datagram that is dropped (" + problem + "); further ones are only counted");
  }
}

DatagramIntake::TimePoint DatagramIntake::deadline(std::chrono::milliseconds extra_interval) const {
  if (on_ && assembly_.givenUpInARow() >= kMostGivenUp) {
    return last_datagram_;
  }
  if (!on_ || !tcp_worked_) {
    return TimePoint::max();
  }
  return std::max(last_datagram_ + kSilence + extra_interval, *tcp_worked_ + kGrace);
}

std::string DatagramIntake::problem(TimePoint now, std::chrono::milliseconds extra_interval) const {
  if (on_ && assembly_.givenUpInARow() >= kMostGivenUp) {
    return "so many datagrams are lost that no picture is complete; smaller pictures get through a weak radio link "
           "better";
  }
  if (now < deadline(extra_interval)) {
    return "";
  }
  return "no datagram has come for 1 s, while TCP works; a firewall, a NAT or a tunnel between robot and computer does "
         "not let UDP through";
}

}  // namespace aibo_driver
