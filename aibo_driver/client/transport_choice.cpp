#include "client/transport_choice.h"

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "protocol/picture_datagram.h"

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

// Random numbers, so that only somebody who hears the connection knows them.
DatagramIntake::Start randomStart() {
  std::random_device random;
  return {random(), random()};
}

TransportChoice::Order orderOf(int port, bool is_test, const DatagramIntake::Start& start) {
  return {static_cast<unsigned short>(port), is_test, start.sequence, start.picture};
}

}  // namespace

TransportChoice::TransportChoice(Connection& connection, DatagramIntake& datagrams)
    : connection_(connection), datagrams_(datagrams), test_start_(randomStart()) {}

std::optional<TransportChoice::Order> TransportChoice::next(const Settings& wanted, TimePoint now) {
  next_look_ = TimePoint::max();
  if (wanted.transport != std::exchange(wanted_, wanted.transport)) {
    trials_ = Trials();
  }
  const int port = wanted_ == PictureTransport::kUdp ? wanted.datagram_port : 0;
  if (port_ != 0 && (port == 0 || trials_.given_up)) {
    port_ = 0;
    useTcp(now);
    return orderOf(0, false, start_);
  }
  if (port_ == port) {
    return std::nullopt;
  }
  if (port_ == 0 && !trials_.has_passed) {
    return wanted.streaming ? test(port, now) : std::nullopt;
  }
  port_ = port;
  trials_ = Trials();
  start_ = randomStart();
  datagrams_.begin(start_, now);
  return orderOf(port, false, start_);
}

std::optional<TransportChoice::Order> TransportChoice::test(int port, TimePoint now) {
  if (now < trials_.next_test) {
    next_look_ = trials_.next_test;
    return std::nullopt;
  }
  if (trials_.tests == kTests) {
    trials_.tests = 0;
    next_look_ = trials_.next_test = now + kPause;
    connection_.giveUpDatagrams(
        "no test datagram has come; a firewall, a NAT or a tunnel between robot and computer does not let UDP through");
    return std::nullopt;
  }
  next_look_ = trials_.next_test = now + kFirstWait * (1 << trials_.tests);
  ++trials_.tests;
  return orderOf(port, true, test_start_);
}

void TransportChoice::answered(const Order& order, TimePoint now) {
  if (order.port == 0 || order.is_test || order.first_sequence != start_.sequence ||
      order.first_picture != start_.picture) {
    return;
  }
  connection_.status.transport = PictureTransport::kUdp;
  connection_.status.transport_problem.clear();
  datagrams_.expectFrom(now);
}

void TransportChoice::refused(const std::string& problem, TimePoint now) {
  if (wanted_ == PictureTransport::kUdp) {
    giveUp("it refused to: " + problem, now);
  }
}

void TransportChoice::arrived(const std::uint8_t* data, std::size_t size) {
  std::array<std::uint8_t, version2::MAX_DATAGRAM_SIZE> test;
  version2::encodeTest(orderOf(0, true, test_start_), test.data());
  trials_.has_passed = trials_.has_passed || std::equal(test.begin(), test.end(), data, data + size);
}

void TransportChoice::giveUp(const std::string& why, TimePoint now) {
  connection_.giveUpDatagrams(why);
  trials_ = {true, false, 0, now + kPauseAfterFailure};
  useTcp(now);
}

// From now on, pictures are due by TCP.
void TransportChoice::useTcp(TimePoint now) {
  datagrams_.end();
  connection_.status.transport = PictureTransport::kTcp;
  connection_.pictures.signOfPicture(now);
}

}  // namespace aibo_client
