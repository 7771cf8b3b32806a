/// @file transport_choice.h
#ifndef AIBO_DRIVER_CLIENT_TRANSPORT_CHOICE_H
#define AIBO_DRIVER_CLIENT_TRANSPORT_CHOICE_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "client/connection.h"
#include "client/datagram_intake.h"
#include "client/session.h"
#include "protocol/version2.h"

namespace aibo_client {

/// Decides over one connection whether the stream's pictures come by TCP or by UDP. Before pictures come by UDP, the
/// robot sends a test datagram, so that no picture is lost where datagrams do not get through. It does no I/O and reads
/// no clock.
class TransportChoice {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Order = protocol::version2::DatagramOrder;

  /// How many tests are sent, because one can be lost. The wait after each is twice as long as the one before.
  static constexpr int kTests = 4;
  static constexpr std::chrono::milliseconds kFirstWait{50};
  /// The time until the next tests if none has come.
  static constexpr std::chrono::seconds kPause{10};
  /// The time until the next tests if UDP was given up in use (our choice). The transport must not change all the time.
  static constexpr std::chrono::seconds kPauseAfterFailure{60};

  TransportChoice(Connection& connection, DatagramIntake& datagrams);

  /// The next order for the robot. It counts as sent, so the caller has to send it. Empty if nothing is to be ordered.
  std::optional<Order> next(const Settings& wanted, TimePoint now);

  /// Call this when the robot has answered an order. Datagrams may come before.
  void answered(const Order& order, TimePoint now);

  /// Call this when the robot has refused the newest order.
  void refused(const std::string& problem, TimePoint now);

  /// Call this when a datagram has come although the pictures come by TCP: it may be the test.
  void arrived(const std::uint8_t* data, std::size_t size);

  /// Call this when the pictures have to come by TCP again, because UDP does not work.
  /// @param why the reason in words that follow a colon
  void giveUp(const std::string& why, TimePoint now);

  /// The latest time to call next() again.
  TimePoint nextLook() const { return next_look_; }

 private:
  /// What is forgotten when the user changes the transport, and when UDP is used.
  struct Trials {
    bool given_up = false;
    bool has_passed = false;
    int tests = 0;  ///< how many were sent since the last pause
    TimePoint next_test{};
  };

  std::optional<Order> test(int port, TimePoint now);
  void useTcp(TimePoint now);

  Connection& connection_;
  DatagramIntake& datagrams_;
  const DatagramIntake::Start test_start_;  // the numbers of this connection's test datagrams
  DatagramIntake::Start start_;             // of the datagrams as last ordered
  PictureTransport wanted_ = PictureTransport::kTcp;
  Trials trials_;
  int port_ = 0;  // to which the robot was told to send; 0 if by TCP
  TimePoint next_look_ = TimePoint::max();
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_TRANSPORT_CHOICE_H
