/// @file log.h
/// The client library prints nothing itself. It hands its messages to a sink that its user provides.
#ifndef AIBO_DRIVER_LOG_H
#define AIBO_DRIVER_LOG_H

#include <functional>
#include <string>

namespace aibo_driver {

enum class LogLevel { kDebug, kInfo, kWarn, kError };

/// Receives one line. Called from the library's own threads; must be thread-safe and must not block.
using LogSink = std::function<void(LogLevel level, const std::string& message)>;

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_LOG_H
