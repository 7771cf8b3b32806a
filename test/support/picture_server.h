/// @file picture_server.h
#ifndef TEST_SUPPORT_PICTURE_SERVER_H
#define TEST_SUPPORT_PICTURE_SERVER_H

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
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
#include "support/proxy/scanners.h"
#include "support/sockets.h"
#include "support/test_pictures.h"
#include "support/version2_frames.h"
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
  PictureServer(int version, std::chrono::microseconds period)
      : version_(version), period_(period), listener_(bindTo("127.0.0.1", 0)), times_(kRemembered) {
    test_pictures::makeNamed({});  // slow the first time
    port_ = portOf(listener_);
    check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
    thread_ = std::thread([this] { run(); });
  }

  ~PictureServer() {
    stopping_ = true;
    wake_up_.raise();
    thread_.join();
  }

  PictureServer(const PictureServer&) = delete;
  PictureServer& operator=(const PictureServer&) = delete;

  /// On 127.0.0.1.
  int port() const { return port_; }

  /// While it is stopped, it neither reads nor sends, like a process that is held by SIGSTOP.
  void setStopped(bool stopped) {
    stopped_ = stopped;
    wake_up_.raise();
  }

  /// From now on it sends this as fast as clients read, in addition to its answers. It is called on the server's
  /// thread. Null: nothing.
  void flood(Flood flood) {
    const std::lock_guard<std::mutex> lock(mutex_);
    flood_ = std::move(flood);
    wake_up_.raise();
  }

  /// Whether it sends telemetry when it is asked for it (version 2): joints 1 and 2 at 0 and a battery half full, every
  /// 32 ms. At first it does not.
  void setTelemetry(bool on) { telemetry_ = on; }

  /// Has the next picture of a stream sent as this function changes it.
  void spoilNext(std::function<Bytes(Bytes jpeg)> change) {
    const std::lock_guard<std::mutex> lock(mutex_);
    spoil_ = std::move(change);
  }

  /// Number of the picture that was sent last.
  std::uint64_t lastNumber() const { return number_; }

  /// When a picture was sent. Only the last 4096 pictures are known.
  TimePoint timeOf(std::uint64_t number) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return times_[number % kRemembered];
  }

 private:
  using milliseconds = std::chrono::milliseconds;
  using steady_clock = std::chrono::steady_clock;

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
  static constexpr std::size_t kFloodSize = 65536;  // a flood is made in portions of this size
  static constexpr milliseconds kTelemetryPeriod{32};

  void run() {
    next_picture_ = steady_clock::now();
    while (!stopping_) {
      std::vector<pollfd> polled = {{wake_up_.descriptor(), POLLIN, 0}};
      TimePoint end = steady_clock::now() + milliseconds(100);
      if (!stopped_) {
        polled.push_back({listener_.get(), POLLIN, 0});
        for (const Peer& peer : peers_) {
          polled.push_back({peer.socket.get(), static_cast<short>(peer.out.empty() ? POLLIN : POLLIN | POLLOUT), 0});
          end = peer.out.empty() ? next_picture_ : end;
        }
      }
      pollUntil(&polled, end);
      wake_up_.clear();
      if (!stopped_) {
        serveAll();
      }
    }
  }

  void serveAll() {
    for (host_files::FileDescriptor client; (client = acceptFrom(listener_)).valid();) {
      peers_.emplace_back(std::move(client), ++connections_, version_ > 1);
    }
    const TimePoint now = steady_clock::now();
    const bool picture = now >= next_picture_;
    const bool telemetry = telemetry_ && now >= next_telemetry_;
    for (Peer& peer : peers_) {
      receive(&peer);
      if (picture) {
        sendPictures(&peer);
      }
      if (telemetry) {
        sendTelemetry(&peer);
      }
      addFlood(&peer);
      flush(&peer);
    }
    next_telemetry_ = telemetry ? now + kTelemetryPeriod : next_telemetry_;
    peers_.remove_if([](const Peer& peer) { return peer.over; });
    if (picture) {
      next_picture_ = std::max(next_picture_ + period_, now);
    }
  }

  void receive(Peer* peer) {
    std::array<std::uint8_t, 4096> buffer;
    const ssize_t count = ::recv(peer->socket.get(), buffer.data(), buffer.size(), 0);
    if (count <= 0) {
      peer->over = peer->over || count == 0 || (errno != EAGAIN && errno != EINTR);
      return;
    }
    for (const Request& request : peer->requests.feed(buffer.data(), static_cast<std::size_t>(count))) {
      request.version2 ? answerVersion2(request, peer) : answerVersion1(request, peer);
    }
  }

  void answerVersion1(const Request& request, Peer* peer) {
    switch (request.kind) {
      case protocol::REQUEST_NEWER_VERSION:
        peer->version2 = version_ > 1;
        append(peer->version2 ? Bytes{'x', 2, 0, 0} : Bytes{'e', 0, 0, 0}, peer);
        break;
      case protocol::REQUEST_STREAM_TOGGLE:
        peer->streaming = !peer->streaming;
        break;
      case protocol::REQUEST_PICTURE:
        peer->owed.push_back(0);
        break;
      case protocol::REQUEST_JOINT:
      case protocol::REQUEST_SENSOR:
        append({static_cast<std::uint8_t>(protocol::version2::replyKind(request.kind)),
                static_cast<std::uint8_t>(request.id), 0, 0},
               peer);
        break;
      default:
        append({'e', 0, 0, 0}, peer);
    }
  }

  // Accepts unknown requests, too: the reply repeats the request.
  void answerVersion2(const Request& request, Peer* peer) {
    Bytes reply = request.payload;
    switch (request.kind) {
      case protocol::version2::REQUEST_HELLO:
        append(version2_frames::makeFrame('h', request.number, version2_frames::makeHello("F W J V T A")), peer);
        return;
      case protocol::version2::REQUEST_PICTURE:
        peer->owed.push_back(request.number);
        return;
      case protocol::version2::REQUEST_STREAM:
        peer->streaming = !request.payload.empty() && request.payload.front() != 0;
        break;
      case protocol::version2::REQUEST_TELEMETRY:
        peer->telemetry = request.payload != Bytes{0, 0};
        break;
      case protocol::version2::REQUEST_JOINTS:
      case protocol::version2::REQUEST_MOTORS:  // replies to orders are without their expiry
        reply.erase(reply.begin(), reply.size() < 4 ? reply.end() : reply.begin() + 4);
        break;
      case protocol::version2::REQUEST_PLAY:
        reply.clear();
        break;
      default:
        break;
    }
    Bytes frame = version2_frames::makeFrame(protocol::version2::replyKind(request.kind), request.number, reply);
    frame[1] = static_cast<std::uint8_t>(request.id);
    append(frame, peer);
    if (request.kind == protocol::version2::REQUEST_JOINTS) {
      const Bytes end = version2_frames::makeEnd(protocol::version2::ENDED_JOINTS, protocol::version2::END_DONE, "", "",
                                                 request.number);
      append(version2_frames::makeFrame(protocol::version2::END_PUSH, 0, end), peer);
    }
  }

  void sendPictures(Peer* peer) {
    if (peer->out.empty() && !peer->owed.empty()) {
      sendPicture(peer->owed.front(), false, peer);
      peer->owed.erase(peer->owed.begin());
    } else if (peer->out.empty() && peer->streaming) {
      sendPicture(0, true, peer);
    }
  }

  void sendTelemetry(Peer* peer) {
    if (peer->version2 && peer->telemetry) {
      const auto frame = static_cast<unsigned>(next_telemetry_.time_since_epoch() / milliseconds(8));
      append(version2_frames::makeFrame(
                 protocol::version2::TELEMETRY_PUSH, 0,
                 version2_frames::makeTelemetry(frame, {{'J', 1, 0}, {'J', 2, 0}, {'S', 66, 500000}})),
             peer);
    }
  }

  void addFlood(Peer* peer) {
    const std::lock_guard<std::mutex> lock(mutex_);
    while (flood_ && peer->out.size() < kFloodSize) {
      append(flood_(), peer);
    }
  }

  void sendPicture(int request, bool may_be_spoilt, Peer* peer) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const test_pictures::Name name = {peer->connection, ++number_};
    times_[name.number % kRemembered] = steady_clock::now();
    Bytes jpeg = test_pictures::makeNamed(name);
    if (spoil_ && may_be_spoilt) {
      jpeg = std::exchange(spoil_, nullptr)(std::move(jpeg));
    }
    append(peer->version2
               ? version2_frames::makeFrame(protocol::version2::PICTURE, request,
                                            version2_frames::makePicture(jpeg, static_cast<unsigned>(name.number)))
               : test_pictures::makeReply(jpeg),
           peer);
  }

  static void append(const Bytes& bytes, Peer* peer) { peer->out.insert(peer->out.end(), bytes.begin(), bytes.end()); }

  static void flush(Peer* peer) {
    if (peer->out.empty() || peer->over) {
      return;
    }
    const ssize_t count = ::send(peer->socket.get(), peer->out.data(), peer->out.size(), MSG_NOSIGNAL);
    if (count > 0) {
      peer->out.erase(peer->out.begin(), peer->out.begin() + count);
    } else {
      peer->over = errno != EAGAIN && errno != EINTR;
    }
  }

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
