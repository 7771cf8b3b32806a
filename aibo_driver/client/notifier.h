/// @file notifier.h
#ifndef AIBO_DRIVER_CLIENT_NOTIFIER_H
#define AIBO_DRIVER_CLIENT_NOTIFIER_H

#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "aibo_client/callbacks.h"
#include "aibo_client/status.h"
#include "system/rate_limit.h"

namespace aibo_client {

/// Calls the callbacks of the client's user if they are set. It logs exceptions that callbacks throw. The robot can
/// cause nearly everything that is logged, so all of it is limited. Without a limit, a robot could fill the disk.
class Notifier {
 public:
  /// At most this many lines may be logged at once and, in the long run, one per kLogPeriod.
  static constexpr int kLogBurst = 20;
  static constexpr std::chrono::seconds kLogPeriod{1};

  using Clock = std::function<aibo_system::RateLimit::TimePoint()>;

  explicit Notifier(Callbacks callbacks, Clock clock = aibo_system::RateLimit::TimePoint::clock::now)
      : callbacks_(std::move(callbacks)), clock_(std::move(clock)) {}

  /// Calls a callback.
  /// @param name the callback's name, for the message if it throws
  template <typename... Arguments>
  void tell(std::function<void(Arguments...)> Callbacks::*callback, const char* name,
            const std::decay_t<Arguments>&... arguments) const noexcept {
    try {
      if (callbacks_.*callback) {
        (callbacks_.*callback)(arguments...);
      }
    } catch (const std::exception& error) {
      log(LogLevel::kError, std::string("The callback ") + name + " threw an exception: " + error.what());
    }
  }

  void log(LogLevel level, const std::string& message) const noexcept {
    try {
      const aibo_system::RateLimit::Admission admission = log_limit_.admit(clock_(), kLogPeriod);
      const std::string left_out = std::to_string(admission.left_out);
      if (!callbacks_.log) {
        return;
      }
      if (!admission.is_admitted && admission.left_out == 1) {
        callbacks_.log(LogLevel::kWarn, "There are more messages than can be logged. Some are left out and counted.");
      } else if (admission.is_admitted) {
        callbacks_.log(level,
                       admission.left_out == 0 ? message : message + " (earlier messages left out: " + left_out + ")");
      }
    } catch (...) {  // there is nobody left to report it to
    }
  }

 private:
  Callbacks callbacks_;
  Clock clock_;
  mutable aibo_system::RateLimit log_limit_{kLogBurst};
};

/// What the parts of a connection need to know about their client.
struct ConnectionContext {
  std::string address;                     ///< the server's address, for messages
  std::chrono::milliseconds read_timeout;  ///< a server that owes a picture may be silent for this long
  const Notifier& notifier;
  ClientStatistics& counters;
  std::uint64_t number = 0;  ///< the number of the connection; the client's first one is 1

  /// Logs what the server did, for example "ADDRESS sent something strange.".
  void warn(const std::string& what) const { notifier.log(LogLevel::kWarn, address + " " + what + "."); }

  /// Does the same, but only once over this connection.
  /// @param subject what the line is about; only few are possible
  void warnOnce(const std::string& subject, const std::string& what) const {
    if (warned.insert(subject).second) {
      warn(what);
    }
  }

  mutable std::set<std::string> warned{};  ///< the subjects of warnOnce()
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_NOTIFIER_H
