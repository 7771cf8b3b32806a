/// @file picture_server.h
#ifndef TEST_SUPPORT_PICTURE_SERVER_H
#define TEST_SUPPORT_PICTURE_SERVER_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "support/numbered_pictures.h"
#include "support/proxy/fault.h"

namespace fault_bench {

/// A server that speaks both versions of the protocol and has a new picture much more often than a camera: as many
/// faults fit into a minute. Serves any number of clients. A picture that would have to wait is left out, as on the
/// robot; pictures are numbered in the order in which they are sent.
///
/// Every function may be called from any thread.
class PictureServer {
 public:
  /// @param version newest version of the protocol that it speaks, 1 or 2
  PictureServer(int version, std::chrono::microseconds period);
  ~PictureServer();

  PictureServer(const PictureServer&) = delete;
  PictureServer& operator=(const PictureServer&) = delete;

  /// On 127.0.0.1.
  int port() const;

  /// From now on it is like a process that does not run: what comes waits; or it runs again.
  void setStopped(bool stopped);

  /// The next picture of a stream is sent changed by this.
  void spoilNext(std::function<Bytes(Bytes jpeg)> change);

  /// The picture that was spoilt last, as it was sent; its name has the number 0 if there has been none.
  std::pair<PictureName, Bytes> lastSpoilt() const;

  /// Number of the picture that was sent last.
  std::uint64_t lastNumber() const;

  /// When that picture of the last 4096 was sent.
  TimePoint timeOf(std::uint64_t number) const;

  /// Commands to joints that have come, over all connections.
  std::uint64_t jointCommands() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fault_bench

#endif  // TEST_SUPPORT_PICTURE_SERVER_H
