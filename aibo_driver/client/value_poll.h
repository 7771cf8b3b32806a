/// @file value_poll.h
#ifndef AIBO_DRIVER_CLIENT_VALUE_POLL_H
#define AIBO_DRIVER_CLIENT_VALUE_POLL_H

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

namespace aibo_driver {

/// Decides when to ask a version 1 server for which joint or sensor. Such a server sends nothing unasked, so they are
/// polled one after the other.
class ValuePoll {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// From one request to the next. A request and its answer are six bytes in two packets: 80 small packets a second
  /// beside the 120 or so full ones of 30 pictures a second. On a wireless link of 11 Mbit/s a small packet takes about
  /// 0.75 ms, so the poll takes 6 % of its time.
  static constexpr std::chrono::milliseconds kPeriod{25};
  /// Commands go first, but hold up the poll for this long at most.
  static constexpr std::chrono::milliseconds kLongestWait{250};

  /// What to ask for.
  struct Value {
    char request;  ///< letter
    int id;
  };

  /// Begins with all joints and sensors of an ERS-7. (The joints of the ERS-210 have the same identifiers.)
  explicit ValuePoll(TimePoint now);

  /// True if there is nothing to ask for.
  bool empty() const;

  /// When to ask again; not if empty().
  TimePoint dueAt() const { return due_at_; }

  /// True if commands have held up the poll for long enough.
  bool isOverdue(TimePoint now) const { return now >= due_at_ + kLongestWait; }

  /// The value to ask for now: joints and sensors in turn.
  Value take(TimePoint now);

  /// The robot refused to report this value: it is not asked for again.
  void drop(const Value& value);

  /// The robot does not answer this request at all.
  void dropAll(char request);

 private:
  /// The values that one request asks for.
  struct Group {
    char request;
    std::vector<int> ids;
    std::size_t next;
  };

  Group& groupOf(char request);

  std::array<Group, 2> groups_;
  std::size_t turn_ = 0;  // which group is next, unless it is empty
  TimePoint due_at_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_VALUE_POLL_H
