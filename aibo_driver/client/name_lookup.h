/// @file name_lookup.h
#ifndef AIBO_DRIVER_CLIENT_NAME_LOOKUP_H
#define AIBO_DRIVER_CLIENT_NAME_LOOKUP_H

#include <sys/socket.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace aibo_driver {

struct SocketAddress {
  sockaddr_storage storage;
  socklen_t size;
};

/// The addresses of a name, in the order in which to try them, or why there are none.
struct NameLookupResult {
  std::vector<SocketAddress> addresses;
  std::string problem;  ///< empty if there are addresses
};

/// Looks up a name, however long that takes. Called on a thread of its own.
using Resolver = std::function<NameLookupResult(const std::string& host, int port)>;

/// The system's resolver: /etc/hosts, DNS, mDNS, whatever is configured.
NameLookupResult resolveWithSystem(const std::string& host, int port);

/// Numeric addresses only; never blocks.
NameLookupResult resolveNumeric(const std::string& host, int port);

/// Looks up one name at a time, in the background.
///
/// The system's resolver blocks, at worst for half a minute, and cannot be interrupted. So it runs on a detached thread
/// that owns all that it touches, and the caller may stop waiting at any time. The next start() of the same name waits
/// for the lookup that is still running, so lookups of one name never pile up. (The library is linked with
/// `-z nodelete`, so the code of a thread that was left behind stays loaded.)
class NameLookup {
 public:
  explicit NameLookup(Resolver resolver);

  /// Begins a lookup, unless one of this name is still running.
  void start(const std::string& host, int port);

  /// poll() finds it readable once there is a result. Valid after start().
  int descriptor() const;

  /// Takes the result, once descriptor() is readable.
  NameLookupResult take();

 private:
  struct Lookup;

  Resolver resolver_;
  std::shared_ptr<Lookup> lookup_;  // null if none has been started since the last take()
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_NAME_LOOKUP_H
