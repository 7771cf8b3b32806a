/// @file log.h
/// The client library prints nothing itself. It hands its messages to a function that its user provides.
#ifndef AIBO_CLIENT_LOG_H
#define AIBO_CLIENT_LOG_H

#include <functional>
#include <string>

namespace aibo_client {

enum class LogLevel { kDebug, kInfo, kWarn, kError };

/// Receives one line. The library's own threads call it, so it must be thread-safe and must not block.
using LogSink = std::function<void(LogLevel level, const std::string& message)>;

}  // namespace aibo_client

#endif  // AIBO_CLIENT_LOG_H
