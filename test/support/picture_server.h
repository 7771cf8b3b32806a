/// @file picture_server.h
#ifndef TEST_SUPPORT_PICTURE_SERVER_H
#define TEST_SUPPORT_PICTURE_SERVER_H

#include <poll.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "host_files/file_descriptor.h"
#include "support/proxy/fault.h"
#include "support/proxy/scanners.h"
#include "support/test_pictures.h"
#include "system/event.h"

namespace test_support {

/// A server that speaks both versions of the protocol to any number of clients. It has a new picture much more often
/// than a camera, so that many faults fit into a minute. As on the robot, a picture that would have to wait is left
/// out. Pictures are numbered in the order in which they are sent. Unlike a ScriptedServer, it answers by itself.
///
/// Every function may be called from any thread.
class PictureServer {
 public:
  /// Makes the next bytes of a flood.
  using Flood = std::function<Bytes()>;

  /// @param version newest version of the protocol that it speaks, 1 or 2
  /// @param period from one picture to the next; 0 = as fast as the client takes them
  PictureServer(int version, std::chrono::microseconds period);
  ~PictureServer();

  PictureServer(const PictureServer&) = delete;
  PictureServer& operator=(const PictureServer&) = delete;

  /// On 127.0.0.1.
  int port() const { return port_; }

  /// While it is stopped, it neither reads nor sends, like a process that is held by SIGSTOP.
  void setStopped(bool stopped);

  /// From now on it sends this as fast as clients read, in addition to its answers. It is called on the server's
  /// thread. Null: nothing.
  void flood(Flood flood);

  /// Whether it sends telemetry when it is asked for it (version 2): joints 1 and 2 at 0 and a battery half full, every
  /// 32 ms. At first it does not.
  void setTelemetry(bool on) { telemetry_ = on; }

  /// Has the next picture of a stream sent as this function changes it.
  void spoilNext(std::function<Bytes(Bytes jpeg)> change);

  /// Number of the picture that was sent last.
  std::uint64_t lastNumber() const { return number_; }

  /// When a picture was sent. Only the last 4096 pictures are known.
  TimePoint timeOf(std::uint64_t number) const;

 private:
  struct Peer {
    Peer(host_files::FileDescriptor client, std::uint32_t number, bool knows_version2)
        : socket(std::move(client)), connection(number), requests(knows_version2) {}
    host_files::FileDescriptor socket;
    std::uint32_t connection;
    RequestScanner requests;
    bool version2 = false;
    bool streaming = false;
    bool telemetry = false;   // wanted
    std::vector<int> owed{};  // request numbers of pictures; 0 in version 1
    Bytes out{};
    bool over = false;
  };

  static constexpr std::size_t kRemembered = 4096;

  void run();
  void waitFor(std::vector<pollfd> polled, TimePoint end);
  void serveAll();
  void receive(Peer* peer);
  void answerVersion1(const Request& request, Peer* peer);
  void answerVersion2(const Request& request, Peer* peer);
  void sendPictures(Peer* peer);
  void sendTelemetry(Peer* peer);
  void addFlood(Peer* peer);
  Bytes wrap(const Bytes& jpeg, int request, const Peer& peer) const;
  Bytes nextPicture(const Peer& peer, bool may_be_spoilt);
  static void append(const Bytes& bytes, Peer* peer);
  static void flush(Peer* peer);

  const int version_;
  const std::chrono::microseconds period_;
  const host_files::FileDescriptor listener_;
  int port_ = 0;
  TimePoint next_picture_;
  std::list<Peer> peers_;
  std::uint32_t connections_ = 0;
  std::atomic<std::uint64_t> number_{0};
  std::atomic<bool> stopped_{false};
  std::atomic<bool> telemetry_{false};
  TimePoint next_telemetry_;
  mutable std::mutex mutex_;  // guards what follows, down to the event
  std::vector<TimePoint> times_;
  std::function<Bytes(Bytes jpeg)> spoil_;
  Flood flood_;
  aibo_system::Event wake_up_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PICTURE_SERVER_H
