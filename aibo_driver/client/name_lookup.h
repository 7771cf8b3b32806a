/// @file name_lookup.h
#ifndef AIBO_DRIVER_CLIENT_NAME_LOOKUP_H
#define AIBO_DRIVER_CLIENT_NAME_LOOKUP_H

#include <sys/socket.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace aibo_client {

struct SocketAddress {
  sockaddr_storage storage;
  socklen_t size;
};

/// The addresses of a name, in the order in which to try them, or the reason why there are none.
struct NameLookupResult {
  std::vector<SocketAddress> addresses;
  std::string problem;  ///< empty if there are addresses
};

/// Looks up a name, however long that takes. It is called on a thread of its own.
using Resolver = std::function<NameLookupResult(const std::string& host, int port)>;

/// Uses the system's resolver: /etc/hosts, DNS, mDNS or others, as configured.
NameLookupResult resolveWithSystem(const std::string& host, int port);

/// Looks up one name at a time, in the background.
///
/// The system's resolver may block for half a minute and cannot be interrupted. So it runs on a detached thread that
/// owns everything it uses, and the caller may stop waiting at any time. The next start() of the same name waits for
/// the lookup that is still running, so lookups of one name never pile up. The library is linked with `-z nodelete`, so
/// the code stays loaded even if such a thread is left behind.
class NameLookup {
 public:
  explicit NameLookup(Resolver resolver);

  /// Begins a lookup, unless a lookup of this name is still running.
  void start(const std::string& host, int port);

  /// A descriptor that becomes readable when there is a result. It is valid after start().
  int descriptor() const;

  /// Returns the result. Call it when descriptor() is readable.
  /// @throw the exceptions of the resolver
  NameLookupResult take();

 private:
  struct Lookup;

  Resolver resolver_;
  std::shared_ptr<Lookup> lookup_;  // null if none has been started since the last take()
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_NAME_LOOKUP_H
