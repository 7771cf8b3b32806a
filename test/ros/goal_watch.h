/// @file goal_watch.h
#ifndef TEST_ROS_GOAL_WATCH_H
#define TEST_ROS_GOAL_WATCH_H

#include <actionlib/client/action_client.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <memory>
#include <mutex>

#include "support/ros/topics.h"

namespace test_support {

/// One goal of an action, from its beginning to its end. It ends once, and its status says the same as its result.
template <typename Action>
class GoalWatch {
 public:
  using Client = actionlib::ActionClient<Action>;
  using Goal = typename Action::_action_goal_type::_goal_type;
  using Result = typename Action::_action_result_type::_result_type;
  using Feedback = typename Action::_action_feedback_type::_feedback_type;
  using ResultPtr = boost::shared_ptr<const Result>;
  using FeedbackPtr = boost::shared_ptr<const Feedback>;

  /// Gives a goal again and again, until its first feedback comes: a driver that stalls for half a second refuses
  /// goals.
  static std::unique_ptr<GoalWatch> begin(Client& client, const Goal& goal) {
    std::unique_ptr<GoalWatch> watch;
    for (int attempt = 0; attempt < 10 && (!watch || !watch->waitForFeedback()); ++attempt) {
      watch = std::make_unique<GoalWatch>(client, goal);
    }
    EXPECT_TRUE(watch->waitForFeedback());
    return watch;
  }

  GoalWatch(Client& client, const Goal& goal) {
    handle_ = client.sendGoal(
        goal, [this](typename Client::GoalHandle handle) { changed(handle); },
        [this](typename Client::GoalHandle, const FeedbackPtr& feedback) { received(feedback); });
  }

  ~GoalWatch() { handle_.reset(); }

  /// Null if the goal ends without feedback, or if none comes in time.
  FeedbackPtr waitForFeedback() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, kSafetyNet, [this] { return feedback_ != nullptr || over_; });
    return feedback_;
  }

  /// LOST if it does not end in time.
  actionlib::TerminalState::StateEnum waitForEnd() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, kSafetyNet, [this] { return over_; });
    return over_ ? end_ : actionlib::TerminalState::LOST;
  }

  /// How many have come so far.
  int feedbacks() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return feedbacks_;
  }

  /// Null before the end.
  ResultPtr result() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return result_;
  }

  void cancel() { handle_.cancel(); }

 private:
  void changed(typename Client::GoalHandle& handle) {
    if (handle.getCommState() != actionlib::CommState::DONE) {
      return;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_FALSE(over_);
    over_ = true;
    end_ = handle.getTerminalState().state_;
    result_ = handle.getResult();
    if (result_) {
      EXPECT_EQ(handle.getTerminalState().text_, textOf(*result_));
    }
    changed_.notify_all();
  }

  template <typename Any>
  static auto textOf(const Any& result) -> decltype(result.message) {
    return result.message;
  }
  template <typename Any>
  static auto textOf(const Any& result) -> decltype(result.error_string) {
    return result.error_string;
  }

  void received(const FeedbackPtr& feedback) {
    const std::lock_guard<std::mutex> lock(mutex_);
    feedback_ = feedback;
    ++feedbacks_;
    changed_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  actionlib::TerminalState::StateEnum end_ = actionlib::TerminalState::LOST;
  ResultPtr result_;
  FeedbackPtr feedback_;
  int feedbacks_ = 0;
  typename Client::GoalHandle handle_;
};

}  // namespace test_support

#endif  // TEST_ROS_GOAL_WATCH_H
