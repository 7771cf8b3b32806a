/// @file exceptions.h
/// What the client library throws. Every message says what was wrong, where, and what to check.
#ifndef AIBO_DRIVER_EXCEPTIONS_H
#define AIBO_DRIVER_EXCEPTIONS_H

#include <stdexcept>

namespace aibo_driver {

/// Base of everything the client library throws.
class Exception : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An option or argument is outside its allowed range, which the message names.
class InvalidArgumentException : public Exception {
 public:
  using Exception::Exception;
};

/// The robot cannot be reached, or the connection broke.
class NetworkException : public Exception {
 public:
  using Exception::Exception;
};

/// There was no answer in the time allowed.
class TimeoutException : public NetworkException {
 public:
  using NetworkException::NetworkException;
};

/// The peer sent what no RCServer sends.
class ProtocolException : public Exception {
 public:
  using Exception::Exception;
};

/// The robot answered, and refused.
class CommandException : public Exception {
 public:
  using Exception::Exception;
};

/// The client was told to stop while the call was waiting.
class StoppedException : public Exception {
 public:
  using Exception::Exception;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_EXCEPTIONS_H
