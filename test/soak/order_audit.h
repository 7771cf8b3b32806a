/// @file order_audit.h
#ifndef TEST_SOAK_ORDER_AUDIT_H
#define TEST_SOAK_ORDER_AUDIT_H

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "order_events.h"

namespace soak {

/// Judges what happened in each round by the contract of docs/ros_interface.md, and adds up the figures.
class OrderAudit {
 public:
  /// @param complain is called with each violation
  /// @param limits lowest and highest position of each joint, to which the driver clamps targets
  OrderAudit(const std::function<void(const std::string&)>& complain,
             const std::map<std::string, std::pair<double, double>>& limits)
      : complain_(complain), limits_(limits) {}

  /// @param round in which all orders have ended
  void judge(const Round& round);

  /// Prints a table.
  void report() const;

 private:
  void judgeStops(const Round& round);
  void judgeStop(const Round& round, const Call& stop);
  void judgeEnds(const Round& round);
  void judgeDone(const Round& round, const Ended& end);
  double farthest(const Measured& measured, const Order& order, const std::vector<std::string>& joints) const;
  double clamp(const std::string& joint, double target) const;

  const std::function<void(const std::string&)> complain_;
  const std::map<std::string, std::pair<double, double>> limits_;

  std::size_t rounds_ = 0;
  std::size_t orders_ = 0;
  std::size_t ends_ = 0;
  std::size_t calls_ = 0;
  std::size_t faults_ = 0;
  std::vector<double> moved_in_stops_;  ///< rad, the most of any joint in each stop
  std::vector<double> missed_;          ///< rad, of joints whose movement is done
};

}  // namespace soak

#endif  // TEST_SOAK_ORDER_AUDIT_H
