/// @file session.h
#ifndef AIBO_DRIVER_CLIENT_SESSION_H
#define AIBO_DRIVER_CLIENT_SESSION_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aibo_driver/camera.h"
#include "client/call.h"
#include "client/color_intake.h"

namespace aibo_driver {

/// What the user wants for as long as there is a connection, and again over the next one.
struct Wish {
  bool streaming = false;
  int jpeg_quality = 0;      ///< 1..100, of the stream
  int telemetry_period = 0;  ///< OPEN-R frames of 8 ms; 0 = no telemetry
  StreamFormat format{};
  CameraSettings camera{};
  PictureTransport transport = PictureTransport::kTcp;
  unsigned transport_changes = 0;  ///< how often the user has changed it
  int datagram_port = 0;           ///< to which pictures can be sent by UDP; 0 = they come by TCP
  ColorDetection colors{};
  ColorTables color_tables{};  ///< sent only while colours are detected
};

/// Speaks one version of the protocol over one Connection: what to send, how to take apart what arrives, and when to
/// give up. It does no I/O and reads no clock: bytes and times are handed in. Used by one thread.
class Session {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Bytes = std::vector<std::uint8_t>;

  Session() = default;
  virtual ~Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  virtual int protocolVersion() const = 0;

  /// True once the server has answered: requests can be made, and Connection::robot is known.
  virtual bool ready() const = 0;

  /// Takes over a call.
  virtual void add(Call call) = 0;

  /// The request to send now, empty if there is none; from then on it counts as sent. Whenever anything may have
  /// changed, call this until nothing is left. Each request has to be sent in one piece: some servers recognise a
  /// request by the number of bytes that arrive at once.
  virtual Bytes nextRequest(const Wish& wish, TimePoint now) = 0;

  /// Bytes were read at this time.
  /// @throw ProtocolException no server of this version sends that
  /// @throw Fault the connection cannot go on
  virtual void bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now) = 0;

  /// A datagram has come from the server's address at this time.
  /// @return the datagrams to send back
  /// @throw as bytesArrived()
  virtual std::vector<Bytes> datagramArrived(const std::uint8_t* data, std::size_t size, TimePoint now) = 0;

  /// To be called when nextDeadline() has passed and what had arrived until then has been handed in.
  /// @throw Fault something was due and did not come
  virtual void checkDeadlines(TimePoint now) = 0;

  /// When to look at the socket and to call checkDeadlines() and nextRequest() again at the latest.
  virtual TimePoint nextDeadline() const = 0;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_SESSION_H
