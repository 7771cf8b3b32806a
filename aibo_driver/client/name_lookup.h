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

/// Where a name leads, in the order in which to try; or why it leads nowhere.
struct NameLookupResult {
  std::vector<SocketAddress> addresses;
  std::string problem;  ///< empty if there are addresses
};

/// Looks a name up, however long it takes. Called on a thread of its own.
using Resolver = std::function<NameLookupResult(const std::string& host, int port)>;

/// The system's resolver: /etc/hosts, DNS, mDNS, whatever is configured.
NameLookupResult resolveWithSystem(const std::string& host, int port);

/// Numeric addresses only; never blocks.
NameLookupResult resolveNumeric(const std::string& host, int port);

/// Looks up one name at a time, in the background.
///
/// The system's resolver blocks, at worst for half a minute, and cannot be interrupted. So it runs on a detached thread
/// which owns all that it touches, and who is tired of waiting walks away. What was walked away from is taken up again
/// by the next start(), so there is never more than one such thread. (The library is linked with `-z nodelete`: the
/// code of a thread left behind stays where it is.)
class NameLookup {
 public:
  explicit NameLookup(Resolver resolver);

  /// Begins a lookup, unless one of this name is still going on.
  void start(const std::string& host, int port);

  /// Readable with poll() once the result is there. Valid after start().
  int descriptor() const;

  /// The result, to be taken once descriptor() is readable.
  NameLookupResult take();

 private:
  struct Lookup;

  Resolver resolver_;
  std::shared_ptr<Lookup> lookup_;  // null if none has been started since the last take()
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_NAME_LOOKUP_H
