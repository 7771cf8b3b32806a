/// @file link.h
#ifndef TEST_SUPPORT_PROXY_LINK_H
#define TEST_SUPPORT_PROXY_LINK_H

#include <poll.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "client/file_descriptor.h"
#include "support/proxy/pipe.h"

namespace test_support {

/// Called on the proxy's thread with what one side has sent, before it is passed on.
using Tap =
    std::function<void(std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size)>;

/// One connection through the proxy: two sockets, and a pipe in each direction. Never blocks. Only for the proxy's
/// thread.
class Link {
 public:
  /// @param server a socket that is connected, or being connected
  Link(std::size_t number, aibo_client::FileDescriptor client, aibo_client::FileDescriptor server, unsigned seed);

  /// What to wait for: an entry for each socket, the client's first; -1 for a socket that need not be waited for.
  std::array<pollfd, 2> interests(TimePoint now, const Conditions& conditions);

  /// When serve() has to be called at the latest.
  TimePoint nextDue() const;

  /// Does what can be done now.
  /// @param polled the entries of interests(), after poll()
  void serve(const std::array<pollfd, 2>& polled, TimePoint now, const Conditions& conditions, FaultQueue* faults,
             const Tap& tap, std::vector<FaultReport>* reports);

  /// Ends the connection now.
  /// @param end kClose, kReset, kHalfClose or kSilence
  void end(Action end, Direction direction);

  /// True when the connection has ended.
  bool isOver() const { return over_; }
  bool isSilent() const { return silent_; }

 private:
  struct Side {
    aibo_client::FileDescriptor socket;
    Pipe out;              // towards this side
    bool ended = false;    // this side sends no more
    bool told = false;     // this side has got a FIN
    bool blocked = false;  // the kernel takes no more for it
  };

  bool mayRead(const Side& from, const Side& to, const Conditions& conditions) const;
  void receive(Side* from, Side* to, Direction direction, TimePoint now, const Conditions& conditions,
               FaultQueue* faults, const Tap& tap, std::vector<FaultReport>* reports);
  void send(Side* side, Direction direction, TimePoint now);
  bool sendFront(Side* side);

  const std::size_t number_;
  Side client_;
  Side server_;
  bool connecting_ = true;  // to the server
  bool draining_ = false;   // the client has got a FIN, and has yet to close
  bool silent_ = false;
  bool over_ = false;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_LINK_H
