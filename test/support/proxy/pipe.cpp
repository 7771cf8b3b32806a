#include "support/proxy/pipe.h"

#include <algorithm>
#include <utility>

namespace test_support {

using std::chrono::microseconds;

namespace {

constexpr std::size_t kSlowCapacity = 4 * 1024;
constexpr std::size_t kCapacity = 64 * 1024;

}  // namespace

std::vector<FaultReport> Pipe::take(const std::uint8_t* data, std::size_t size, TimePoint now,
                                    const Conditions& conditions, FaultQueue* faults) {
  const std::vector<std::uint64_t> begins =
      direction_ == Direction::kToClient ? scanner_.feed(data, size) : std::vector<std::uint64_t>();
  std::vector<FaultReport> reports;
  const std::uint64_t end = offset_ + size;
  while (findPlace(*faults, begins) && *fault_at_ < end) {
    const std::size_t before = static_cast<std::size_t>(*fault_at_ - offset_);
    pass(data, before, now, conditions);
    data += before;
    const Fault fault = faults->take();
    carryOut(fault, now);
    reports.push_back({fault, 0, offset_, now});
  }
  pass(data, static_cast<std::size_t>(end - offset_), now, conditions);
  return reports;
}

/// Finds out where the next fault takes place.
/// @return false if that is not known yet
bool Pipe::findPlace(const FaultQueue& faults, const std::vector<std::uint64_t>& picture_begins) {
  if (faults.empty() || faults.front().direction != direction_) {
    return false;
  }
  if (std::exchange(fault_turn_, faults.turn()) != faults.turn()) {
    fault_at_.reset();
  }
  const Fault& fault = faults.front();
  if (!fault_at_ && fault.place == Place::kPicture) {
    const auto begin = std::lower_bound(picture_begins.begin(), picture_begins.end(), offset_);
    if (begin != picture_begins.end()) {
      fault_at_ = *begin + fault.offset;
    }
  } else if (!fault_at_) {
    fault_at_ = std::max(offset_, fault.place == Place::kByte ? fault.offset : 0);
  }
  return fault_at_.has_value();
}

void Pipe::carryOut(const Fault& fault, TimePoint now) {
  switch (fault.action) {
    case Action::kDrop:
      drop_ += fault.count;
      break;
    case Action::kOverwrite:
      drop_ += fault.bytes.size();
      addPiece(fault.bytes, now, Conditions());
      break;
    case Action::kInsert:
      addPiece(fault.bytes, now, Conditions());
      break;
    case Action::kFlip:
      masks_.assign(fault.bytes.begin(), fault.bytes.end());
      break;
    case Action::kPause:
    case Action::kSplit:
      not_before_ = std::max(not_before_, now) + fault.time;
      split_ = true;
      break;
    default:
      end(fault.action, now);
  }
}

void Pipe::pass(const std::uint8_t* data, std::size_t size, TimePoint now, const Conditions& conditions) {
  offset_ += size;
  const std::size_t dropped = std::min(drop_, size);
  drop_ -= dropped;
  Bytes bytes(data + dropped, data + size);
  for (std::size_t i = 0; i < bytes.size() && !masks_.empty(); ++i) {
    bytes[i] ^= masks_.front();
    masks_.pop_front();
  }
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t part = std::min(pieceSize(conditions), bytes.size() - begin);
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(begin);
    addPiece(Bytes(from, from + static_cast<std::ptrdiff_t>(part)), now, conditions);
    begin += part;
  }
}

std::size_t Pipe::pieceSize(const Conditions& conditions) {
  constexpr std::size_t kPacket = 1460;  // the unit to which a rate applies
  if (conditions.largest_piece == 0) {
    return conditions.bytes_per_second == 0 ? SIZE_MAX : kPacket;
  }
  return std::uniform_int_distribution<std::size_t>(1, conditions.largest_piece)(random_);
}

void Pipe::addPiece(Bytes bytes, TimePoint now, const Conditions& conditions) {
  const TimePoint due = dueTime(bytes.size(), now, conditions);
  waiting_ += bytes.size();
  const bool alone = conditions.join.count() == 0 || std::exchange(split_, false);
  if (!alone && !pieces_.empty() && !pieces_.back().end && pieces_.back().due == due) {
    pieces_.back().bytes.insert(pieces_.back().bytes.end(), bytes.begin(), bytes.end());
  } else {
    pieces_.push_back({std::move(bytes), due, std::nullopt});
  }
}

TimePoint Pipe::dueTime(std::size_t size, TimePoint now, const Conditions& conditions) {
  TimePoint due = now + conditions.delay;
  if (conditions.jitter.count() > 0) {
    due += microseconds(std::uniform_int_distribution<microseconds::rep>(0, conditions.jitter.count())(random_));
  }
  if (conditions.join.count() > 0) {
    due += conditions.join - (due.time_since_epoch() % conditions.join);
  }
  due = std::max(due, not_before_);
  not_before_ = due;
  if (conditions.bytes_per_second > 0) {
    not_before_ += microseconds(size * 1000000 / conditions.bytes_per_second);
  }
  return due;
}

// A slow way holds little, or bytes would wait in it for seconds. A way with a delay holds all bytes under way.
bool Pipe::isFull(const Conditions& conditions) const {
  const bool slow = conditions.largest_piece > 0 || conditions.bytes_per_second > 0;
  return waiting_ > (slow ? kSlowCapacity : kCapacity);
}

void Pipe::end(Action end, TimePoint now) {
  pieces_.push_back({{}, std::max(now, not_before_), end});
}

}  // namespace test_support
