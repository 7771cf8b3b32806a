/// @file wire_audit.h
#ifndef TEST_SOAK_WIRE_AUDIT_H
#define TEST_SOAK_WIRE_AUDIT_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "order_events.h"
#include "protocol/frame_reader.h"
#include "protocol/version1.h"

namespace soak {

/// Reads what the robot sends to the driver: which targets of joints it accepts, and whether the joints are measured
/// there when it says that they have arrived (docs/protocol.md, "Orders"). Not thread-safe.
class WireAudit {
 public:
  /// @param complain is called with each violation
  explicit WireAudit(std::function<void(const std::string&)> complain) : complain_(std::move(complain)) {}

  /// Takes the next bytes of the robot's side of a connection. The newest connection counts.
  /// @param time s
  void hear(std::size_t connection, const std::uint8_t* data, std::size_t size, double time);

  /// The targets that the robot has accepted since the last call.
  std::vector<Accepted> takeAccepted() { return std::exchange(accepted_, {}); }

  /// Prints figures.
  void report() const;

 private:
  using Positions = std::map<int, int>;  ///< microradian, by the joint's id

  struct Done {
    Positions targets;
    int missed;  ///< microradian, when the robot said it
  };

  void takeFrame(double time);
  void takeAcceptedTargets(double time);
  void takeEnd();
  void takeMeasurements();
  int farthest(const Positions& targets) const;

  const std::function<void(const std::string&)> complain_;
  std::vector<Accepted> accepted_;
  std::vector<double> missed_;  ///< rad, how far the farthest joint of each order was that is done

  std::size_t connection_ = 0;
  std::size_t negotiation_left_ = protocol::VALUE_REPLY_SIZE;  ///< bytes
  std::vector<std::uint8_t> payload_ = std::vector<std::uint8_t>(protocol::version2::MAX_PAYLOAD_TOWARDS_CLIENT);
  protocol::version2::FrameReader frames_{payload_.data(), payload_.size()};
  std::map<int, Positions> orders_;  ///< targets of joints that no other order has taken, by number
  Positions measured_;
  std::vector<Done> done_;  ///< until the next measurement
};

}  // namespace soak

#endif  // TEST_SOAK_WIRE_AUDIT_H
