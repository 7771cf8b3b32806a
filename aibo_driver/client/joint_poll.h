/// @file joint_poll.h
#ifndef AIBO_DRIVER_CLIENT_JOINT_POLL_H
#define AIBO_DRIVER_CLIENT_JOINT_POLL_H

#include <chrono>
#include <cstddef>
#include <vector>

namespace aibo_driver {

/// When a version 1 server is asked for which joint: one after the other, for such a server sends nothing unasked.
class JointPoll {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// From one request to the next. A request and its answer are six bytes in two packets, beside the 60 packets or so
  /// that 30 pictures a second take: they cost the stream nothing.
  static constexpr std::chrono::milliseconds kPeriod{50};
  /// A poll waits so long at most for commands to the joints, which go first.
  static constexpr std::chrono::milliseconds kLongestWait{250};

  /// Begins with all joints of an Aibo (the ERS-7 and the ERS-210 have the same identifiers).
  explicit JointPoll(TimePoint now);

  /// True if there is no joint to ask for.
  bool empty() const { return ids_.empty(); }

  /// When to ask again; not if empty().
  TimePoint dueAt() const { return due_at_; }

  /// True if commands have held up the poll for long enough.
  bool isOverdue(TimePoint now) const { return now >= due_at_ + kLongestWait; }

  /// The joint to ask for now.
  int take(TimePoint now);

  /// The robot refuses to tell this joint: it is not asked for again.
  void drop(int id);

 private:
  std::vector<int> ids_;
  std::size_t next_ = 0;
  TimePoint due_at_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_JOINT_POLL_H
