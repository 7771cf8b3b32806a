/// @file fault.h
/// The reasons that end a connection or an attempt to connect, in words that help a user to act.
#ifndef AIBO_DRIVER_CLIENT_FAULT_H
#define AIBO_DRIVER_CLIENT_FAULT_H

#include <chrono>
#include <cstddef>
#include <string>

#include "aibo_client/exceptions.h"
#include "protocol/fields.h"

namespace aibo_client {

/// The reason why a connection has ended, or why an attempt to make one has failed. what() gives it in words.
class Fault : public NetworkException {
 public:
  Fault(FaultKind kind, const std::string& reason, std::string advice);

  /// What the user should check: one or two sentences.
  const std::string& advice() const { return advice_; }

  /// The same fault, if the robot had announced that it goes off.
  /// @param said what the robot said
  Fault sinceRobotWentOff(const std::string& said) const;

  // `address` is "host:port"; `detail` is the message of the operating system or of the parser.
  static Fault nameNotFound(const std::string& host, const std::string& detail);
  static Fault refused(const std::string& address);
  static Fault unreachable(const std::string& address, const std::string& detail);
  static Fault noAnswer(const std::string& address, std::chrono::milliseconds limit);
  static Fault turnedAway(const std::string& address);
  static Fault closed(const std::string& address);
  static Fault silent(const std::string& address, std::chrono::milliseconds limit);
  static Fault unanswered(const std::string& address, const std::string& request, std::chrono::milliseconds limit);
  static Fault protocol(const std::string& address, const std::string& detail);
  static Fault internal(const std::string& detail);

 private:
  std::string advice_;
};

/// Thrown if the peer sent something that no RCServer sends. The connection loop turns it into a Fault::protocol().
class ProtocolException : public Exception {
 public:
  using Exception::Exception;
};

/// @param problem what a decoder of the protocol says; null if nothing is wrong
/// @param what the name of what was decoded, for the message
/// @throw ProtocolException something is wrong
inline void expectGood(const char* problem, const char* what) {
  if (problem != nullptr) {
    throw ProtocolException(std::string("bad ") + what + ": " + problem);
  }
}

/// Decodes a payload of version 2.
/// @throw ProtocolException it is malformed
template <typename Content>
Content decoded(const unsigned char* payload, std::size_t size, const char* what) {
  Content content;
  expectGood(protocol::version2::decode(payload, size, &content), what);
  return content;
}

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_FAULT_H
