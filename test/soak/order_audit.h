/// @file order_audit.h
#ifndef TEST_SOAK_ORDER_AUDIT_H
#define TEST_SOAK_ORDER_AUDIT_H

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "order_events.h"

namespace soak {

/// Judges what happened in each round by the contract of docs/ros_interface.md, and adds up the figures.
class OrderAudit {
 public:
  /// @param complain is called with each violation
  explicit OrderAudit(std::function<void(const std::string&)> complain) : complain_(std::move(complain)) {}

  /// @param round in which all orders have ended
  void judge(const Round& round);

  /// Prints a table.
  void report() const;

 private:
  void judgeEnds(const Round& round);
  void judgeStop(const Round& round, const Call& stop);
  void judgeAge(const Round& round);

  const std::function<void(const std::string&)> complain_;

  std::size_t rounds_ = 0;
  std::size_t orders_ = 0;
  std::size_t ends_ = 0;
  std::size_t calls_ = 0;
  std::size_t faults_ = 0;
  std::vector<double> moved_in_stops_;  ///< rad, the most of any joint in each stop
  std::vector<double> ages_;            ///< s, of commands when the robot has accepted them
};

/// A time in words: the seconds since the last full hour.
std::string hourClock(double time);

/// Prints a line: how many values there are, and how large.
void printFigures(const char* title, std::vector<double> values);

}  // namespace soak

#endif  // TEST_SOAK_ORDER_AUDIT_H
