#include "client/transport_choice.h"

#include <algorithm>
#include <utility>

namespace aibo_client {

TransportChoice::Step TransportChoice::next(const Situation& situation, TimePoint now) {
  next_look_ = TimePoint::max();
  wanted_ = situation.wanted;
  if (situation.changes != std::exchange(changes_, situation.changes)) {
    given_up_ = has_passed_ = false;
    tests_ = 0;
    next_test_ = now;
    pause_ = kPause;
  }
  const bool is_possible = wanted_ != PictureTransport::kTcp && situation.port != 0;
  if (port_ != 0 && (!is_possible || (given_up_ && situation.can_repeat))) {
    port_ = 0;
    return Step::kEnd;
  }
  problem_.clear();
  if (!is_possible || port_ == situation.port) {
    return Step::kNone;
  }
  if (insists() && !situation.can_send) {
    problem_ = "its server has no request for it";
  } else if (port_ != 0 || has_passed_ || (insists() && !given_up_)) {
    return begin(situation.port, now);
  } else if (!situation.can_repeat) {
    problem_ = insists() ? "" : "its server does not repeat lost datagrams";
  } else if (situation.streaming) {
    return test(now);
  }
  return Step::kNone;
}

TransportChoice::Step TransportChoice::begin(int port, TimePoint now) {
  port_ = port;
  began_ = now;
  given_up_ = has_passed_ = false;
  tests_ = 0;
  return Step::kBegin;
}

TransportChoice::Step TransportChoice::test(TimePoint now) {
  if (now < next_test_) {
    next_look_ = next_test_;
    return Step::kNone;
  }
  if (tests_ == kTests) {
    tests_ = 0;
    problem_ =
        "no test datagram has come; a firewall, a NAT or a tunnel between robot and computer does not let UDP "
        "through";
    next_look_ = next_test_ = now + kPause;
    return Step::kNone;
  }
  next_look_ = next_test_ = now + kFirstWait * (1 << tests_);
  ++tests_;
  return Step::kTest;
}

void TransportChoice::giveUp(TimePoint now) {
  pause_ = now >= began_ + kProven ? kPause : pause_;
  given_up_ = true;
  has_passed_ = false;
  next_test_ = now + pause_;
  pause_ = std::min(2 * pause_, kLongestPause);
}

}  // namespace aibo_client
