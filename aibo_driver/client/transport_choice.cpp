#include "client/transport_choice.h"

#include <utility>

namespace aibo_client {

TransportChoice::Step TransportChoice::next(PictureTransport wanted, int port, bool streaming, TimePoint now) {
  next_look_ = TimePoint::max();
  if (wanted != std::exchange(wanted_, wanted)) {
    trials_ = Trials();
  }
  const bool is_possible = isUdpWanted() && port != 0;
  if (port_ != 0 && (!is_possible || trials_.given_up)) {
    port_ = 0;
    return Step::kEnd;
  }
  problem_.clear();
  if (!is_possible || port_ == port) {
    return Step::kNone;
  }
  if (port_ == 0 && !trials_.has_passed) {
    return streaming ? test(now) : Step::kNone;
  }
  port_ = port;
  trials_ = Trials();
  return Step::kBegin;
}

TransportChoice::Step TransportChoice::test(TimePoint now) {
  if (now < trials_.next_test) {
    next_look_ = trials_.next_test;
    return Step::kNone;
  }
  if (trials_.tests == kTests) {
    trials_.tests = 0;
    problem_ =
        "no test datagram has come; a firewall, a NAT or a tunnel between robot and computer does not let UDP "
        "through";
    next_look_ = trials_.next_test = now + kPause;
    return Step::kNone;
  }
  next_look_ = trials_.next_test = now + kFirstWait * (1 << trials_.tests);
  ++trials_.tests;
  return Step::kTest;
}

void TransportChoice::giveUp(TimePoint now) {
  trials_ = {true, false, 0, now + kPauseAfterFailure};
}

}  // namespace aibo_client
