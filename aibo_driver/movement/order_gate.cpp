#include "movement/order_gate.h"

#include "text/number.h"

namespace aibo_driver::movement {

void OrderGate::overrule(SteadyTime received, const std::string& what) {
  if (received > not_before_) {
    not_before_ = received;
    overruled_by_ = what;
  }
}

std::string OrderGate::refusal(const Order& order, SteadyTime now, bool may_act_while_stopped) const {
  if (stopped_by_ && !may_act_while_stopped) {
    return "stopped by " + *stopped_by_ + "; call release";
  }
  if (order.received < not_before_) {
    return "it came before " + overruled_by_;
  }
  if (now - order.received > kLongestWait) {
    const double waited = std::chrono::duration<double>(now - order.received).count();
    return "too old: it has waited for " + text::decimal(waited, 1) + " s, and 0.5 s are allowed";
  }
  return "";
}

}  // namespace aibo_driver::movement
