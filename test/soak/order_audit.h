/// @file order_audit.h
#ifndef TEST_SOAK_ORDERS_ORDER_AUDIT_H
#define TEST_SOAK_ORDERS_ORDER_AUDIT_H

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
  void judgeAges(const Round& round);
  void judgeEnds(const Round& round);
  void judgeEndsOfTheRest(const Round& round);
  void judgeDone(const Round& round, const Ended& end);
  double farthest(const Measured& measured, const Order& order, const std::vector<std::string>& joints) const;
  void judgeMoves(const Round& round);
  void judgeThaws(const Round& round);
  bool isClaimed(const Round& round, const std::string& joint, double begin, double end) const;
  double clamp(const std::string& joint, double target) const;

  const std::function<void(const std::string&)> complain_;
  const std::map<std::string, std::pair<double, double>> limits_;

  std::size_t rounds_ = 0;
  std::size_t judged_stops_ = 0;
  std::size_t unjudged_stops_ = 0;  ///< the robot was told to rest meanwhile, or nothing was measured
  std::size_t given_in_stops_ = 0;  ///< orders
  std::size_t merged_ = 0;
  std::size_t unread_ = 0;
  std::size_t thawed_ = 0;
  std::map<std::string, std::size_t> orders_;      ///< by kind
  std::map<std::string, std::size_t> calls_;       ///< by service
  std::map<std::string, std::size_t> done_calls_;  ///< by service
  std::map<std::string, std::size_t> ends_;        ///< by kind and how
  std::map<Fault::Kind, std::size_t> faults_;
  std::vector<double> moved_in_stops_;  ///< rad, the most of any joint in each stop
  std::vector<double> ages_;            ///< s, of orders when they leave for the robot
  std::vector<double> missed_;          ///< rad, of joints whose movement is done
  std::vector<double> call_times_;      ///< s
};

}  // namespace soak

#endif  // TEST_SOAK_ORDERS_ORDER_AUDIT_H
