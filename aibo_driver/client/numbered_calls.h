/// @file numbered_calls.h
#ifndef AIBO_DRIVER_CLIENT_NUMBERED_CALLS_H
#define AIBO_DRIVER_CLIENT_NUMBERED_CALLS_H

#include <algorithm>
#include <chrono>
#include <list>
#include <optional>
#include <string>
#include <utility>

#include "client/call_outcome.h"

namespace aibo_driver {

/// Calls that wait for the robot, each for the reply with its request's number.
/// @tparam Call has `timeout`, `deadline` and fail()
template <typename Call>
class NumberedCalls {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// A call whose request has not been sent.
  void add(Call call) { calls_.push_back({kNotSent, std::move(call)}); }

  /// The oldest call whose request has not been sent; null if there is none.
  const Call* firstUnsent() const { return get(kNotSent); }

  /// The request of firstUnsent() has been sent with this number.
  void sent(int number) { find(kNotSent)->number = number; }

  /// The request with this number has to be sent again.
  void sendAgain(int number) { find(number)->number = kNotSent; }

  bool has(int number) const { return find(number) != calls_.end(); }

  /// The call that waits for this number; null if none does.
  const Call* get(int number) const {
    const auto found = find(number);
    return found == calls_.end() ? nullptr : &found->call;
  }

  /// Takes the call that waits for this number, if it does.
  std::optional<Call> take(int number) {
    const auto found = find(number);
    if (found == calls_.end()) {
      return std::nullopt;
    }
    Call call = std::move(found->call);
    calls_.erase(found);
    return call;
  }

  /// The deadline that passes first; TimePoint::max() if nobody waits.
  TimePoint nextDeadline() const {
    TimePoint earliest = TimePoint::max();
    for (const Entry& entry : calls_) {
      earliest = std::min(earliest, entry.call.deadline);
    }
    return earliest;
  }

  /// Ends the calls whose deadline has passed.
  /// @param missing what did not come
  /// @param remark added to the problem; may be empty
  void expire(TimePoint now, const std::string& missing, const std::string& remark) {
    calls_.remove_if([&](Entry& entry) {
      const bool expired = entry.call.deadline <= now;
      if (expired) {
        entry.call.fail(CallOutcome::kTimeout,
                        "no " + missing + " within " + std::to_string(entry.call.timeout.count()) + " ms" + remark);
      }
      return expired;
    });
  }

  /// None of the calls will be answered.
  void failAll(CallOutcome outcome, const std::string& problem) {
    for (Entry& entry : calls_) {
      entry.call.fail(outcome, problem);
    }
    calls_.clear();
  }

 private:
  static constexpr int kNotSent = 0;  // no request has this number

  struct Entry {
    int number;
    Call call;
  };

  template <typename List>
  static auto findIn(List& list, int number) {
    return std::find_if(list.begin(), list.end(), [number](const Entry& entry) { return entry.number == number; });
  }
  auto find(int number) { return findIn(calls_, number); }
  auto find(int number) const { return findIn(calls_, number); }

  std::list<Entry> calls_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_NUMBERED_CALLS_H
