/// @file transport_choice.h
#ifndef AIBO_DRIVER_CLIENT_TRANSPORT_CHOICE_H
#define AIBO_DRIVER_CLIENT_TRANSPORT_CHOICE_H

#include <chrono>
#include <string>

#include "aibo_client/camera.h"

namespace aibo_client {

/// Decides over one connection whether the stream's pictures come by TCP or by UDP. Before pictures come by UDP, the
/// robot sends a test datagram, so that no picture is lost where datagrams do not get through. It does no I/O and reads
/// no clock.
class TransportChoice {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// How many tests are sent, because one can be lost. The wait after each is twice as long as the one before.
  static constexpr int kTests = 4;
  static constexpr std::chrono::milliseconds kFirstWait{50};
  /// The time until the next tests if none has come.
  static constexpr std::chrono::seconds kPause{10};
  /// The time until the next tests if UDP was given up in use (our choice). The transport must not change all the time.
  static constexpr std::chrono::seconds kPauseAfterFailure{60};

  /// What to ask the robot for.
  enum class Step { kNone, kTest, kBegin, kEnd };

  /// The next step. The caller has to take it, because it then counts as taken.
  /// @param port the client's port for datagrams; 0 if there is none
  Step next(PictureTransport wanted, int port, bool streaming, TimePoint now);

  /// Call this when the test datagram has come.
  void testArrived() { trials_.has_passed = true; }

  /// Call this when the pictures have to come by TCP again, because UDP does not work.
  void giveUp(TimePoint now);

  bool isUdpWanted() const { return wanted_ == PictureTransport::kUdp; }

  /// Why UDP does not work, if next() has just given up a series of tests; otherwise empty.
  const std::string& problem() const { return problem_; }

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

  Step test(TimePoint now);

  PictureTransport wanted_ = PictureTransport::kTcp;
  Trials trials_;
  int port_ = 0;
  TimePoint next_look_ = TimePoint::max();
  std::string problem_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_TRANSPORT_CHOICE_H
