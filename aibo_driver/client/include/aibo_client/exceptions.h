/// @file exceptions.h
/// The exceptions of the client library. Every message says what was wrong, where, and what to check.
#ifndef AIBO_CLIENT_EXCEPTIONS_H
#define AIBO_CLIENT_EXCEPTIONS_H

#include <stdexcept>
#include <string>

namespace aibo_client {

/// Why there is no connection to the robot, or why it broke. New kinds may be added at the end.
enum class FaultKind {
  kNone,          ///< no fault: the first attempt to connect is not over yet, or only this call ran out of time
  kNameNotFound,  ///< the robot's name cannot be looked up
  kRefused,       ///< no program listens at the robot's port
  kUnreachable,   ///< the network has no way to the robot, or has lost it
  kNoAnswer,      ///< the attempt to connect took longer than ClientOptions::connect_timeout
  kTurnedAway,    ///< the robot accepted the connection and closed it at once: another client is probably connected
  kClosed,        ///< the robot closed a connection that had been working
  kSilent,        ///< a picture or an answer was due and did not come in time
  kProtocol,      ///< the peer sent something that no RCServer sends
  kInternal       ///< this computer failed, for example for lack of memory or file descriptors
};

/// The base class of all exceptions that the client library throws.
///
/// @code
/// try {
///   robot.playMotion("NOD.MTN", 1, 2s);
/// } catch (const aibo_client::NetworkException& error) {
///   std::cerr << error.what() << (error.wasSent() ? " It may nod nevertheless.\n" : "\n");
/// } catch (const aibo_client::Exception& error) {
///   std::cerr << error.what() << '\n';  // for example, the robot has no such motion
/// }
/// @endcode
class Exception : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown if an option or argument is outside its allowed range. The message names the range.
class InvalidArgumentException : public Exception {
 public:
  using Exception::Exception;
};

/// Thrown if the robot cannot be reached or the connection broke.
class NetworkException : public Exception {
 public:
  /// @param message the text of what()
  /// @param kind see kind()
  /// @param was_sent see wasSent()
  explicit NetworkException(const std::string& message, FaultKind kind = FaultKind::kNone, bool was_sent = false)
      : Exception(message), kind_(kind), was_sent_(was_sent) {}

  /// @return the kind of reason that the message gives in words
  FaultKind kind() const noexcept { return kind_; }

  /// True if the request had been sent when the call ended, so that the robot may still carry it out. If it is false,
  /// the request has not been sent and never will be.
  bool wasSent() const noexcept { return was_sent_; }

 private:
  FaultKind kind_;
  bool was_sent_;
};

/// Thrown if no answer came in the allowed time. kind() is FaultKind::kNone if the time of this call has passed. It is
/// FaultKind::kSilent if the client gave up the connection while the call waited, because nothing came from the robot.
class TimeoutException : public NetworkException {
 public:
  using NetworkException::NetworkException;
};

/// Thrown if the robot refused. It is also thrown if the client did not send the request, because it had become too old
/// or a stop came before it. In any case, the robot does not carry out the request.
class CommandException : public Exception {
 public:
  using Exception::Exception;
};

/// Thrown if the client was told to stop while the call was waiting.
class StoppedException : public Exception {
 public:
  using Exception::Exception;
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_EXCEPTIONS_H
