/// @file value_poll.h
#ifndef AIBO_DRIVER_CLIENT_VALUE_POLL_H
#define AIBO_DRIVER_CLIENT_VALUE_POLL_H

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

namespace aibo_driver {

/// When a version 1 server is asked for which joint or sensor: one after the other, for such a server sends nothing
/// unasked.
class ValuePoll {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// From one request to the next. A request and its answer are six bytes in two packets: 80 small packets a second
  /// beside the 120 or so full ones of 30 pictures a second. On a wireless link of 11 Mbit/s a small packet takes about
  /// 0.75 ms, so that these take 6 % of its time.
  static constexpr std::chrono::milliseconds kPeriod{25};
  /// A poll waits so long at most for commands, which go first.
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

  /// What to ask for now: joints and sensors in turn.
  Value take(TimePoint now);

  /// The robot refuses to tell this: it is not asked for again.
  void drop(const Value& value);

  /// The robot does not know this request at all.
  void dropAll(char request);

 private:
  /// Things that are asked for by the same request.
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
