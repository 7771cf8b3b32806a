/// @file fault.h
/// Why a connection, or an attempt to make one, ended: all reasons there are, in words a user can act on.
#ifndef AIBO_DRIVER_CLIENT_FAULT_H
#define AIBO_DRIVER_CLIENT_FAULT_H

#include <chrono>
#include <string>

#include "aibo_driver/exceptions.h"

namespace aibo_driver {

enum class FaultKind {
  kNameNotFound,  ///< the robot's name cannot be looked up
  kRefused,       ///< nobody listens at the robot's port
  kUnreachable,   ///< no way to the robot, or none any more
  kNoAnswer,      ///< the attempt to connect took too long
  kTurnedAway,    ///< the robot accepted the connection and closed it at once
  kClosed,        ///< the robot closed a connection that had been working
  kSilent,        ///< bytes were due and none came
  kProtocol,      ///< the peer sent what no RCServer sends
  kInternal       ///< this side failed
};

/// Ends a connection or the attempt to make one; what() says why.
class Fault : public NetworkException {
 public:
  Fault(FaultKind kind, const std::string& reason, std::string advice);

  FaultKind kind() const { return kind_; }
  /// What the user should check: one or two sentences.
  const std::string& advice() const { return advice_; }

  // `address` is "host:port"; `detail` is what the operating system or the parser says.
  static Fault nameNotFound(const std::string& host, const std::string& detail);
  static Fault refused(const std::string& address);
  static Fault unreachable(const std::string& address, const std::string& detail);
  static Fault noAnswer(const std::string& address, std::chrono::milliseconds limit);
  static Fault turnedAway(const std::string& address);
  static Fault closed(const std::string& address);
  static Fault silent(const std::string& address, std::chrono::milliseconds limit);
  static Fault pictureOverdue(const std::string& address, std::chrono::milliseconds limit);
  static Fault unanswered(const std::string& address, const std::string& request, std::chrono::milliseconds limit);
  static Fault agreedTooLate(const std::string& address);
  static Fault protocol(const std::string& address, const std::string& detail);
  static Fault internal(const std::string& detail);

 private:
  FaultKind kind_;
  std::string advice_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_FAULT_H
