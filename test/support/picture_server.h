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
#include <deque>
#include <functional>
#include <future>
#include <list>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "host_files/file_descriptor.h"
#include "support/proxy/scanner.h"
#include "support/sockets.h"
#include "support/test_pictures.h"
#include "support/version2_frames.h"

namespace test_support {

/// A server that speaks both versions of the protocol to any number of clients, each on a thread of its own. It has a
/// new picture much more often than a camera, so that many faults fit into a minute. As on the robot, a picture that
/// would have to wait is left out. Pictures are numbered in the order in which they are sent. Unlike a ScriptedServer,
/// it answers by itself.
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
    check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
    accepting_ = std::async(std::launch::async, [this] { acceptClients(); });
  }

  ~PictureServer() {
    is_stopping_ = true;
    accepting_.wait();
  }

  /// On 127.0.0.1.
  int port() const { return portOf(listener_); }

  /// From now on it sends this as fast as clients read, in addition to its answers, while it is not empty. It is called
  /// by one thread at a time. Null: nothing.
  void flood(Flood flood) {
    const std::lock_guard<std::mutex> lock(mutex_);
    flood_ = std::move(flood);
  }

  /// Whether it sends telemetry when it is asked for it (version 2): joints 1 and 2 at 0 and a battery half full, in
  /// each period. At first it does not.
  void setTelemetry(bool on) { telemetry_ = on; }

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
    host_files::FileDescriptor socket;
    std::uint32_t connection;
    bool version2 = false;
    bool streaming = false;
    bool telemetry = false;  // wanted
    std::deque<int> owed{};  // request numbers of pictures; 0 in version 1
    bool is_over = false;
  };

  static constexpr std::size_t kRemembered = 4096;
  static constexpr std::size_t kFloodSize = 65536;  // a flood is made in portions of this size
  static constexpr milliseconds kTick{10};          // all threads look this often whether they have to end

  void acceptClients() {
    std::list<std::future<void>> served;
    for (std::uint32_t connections = 0; !is_stopping_;) {
      if (isReady(listener_, POLLIN, kTick)) {
        Peer peer{acceptFrom(listener_), ++connections};
        served.push_back(std::async(std::launch::async, [this, peer = std::move(peer)]() mutable { serve(&peer); }));
      }
      served.remove_if([](auto& each) { return each.wait_for(milliseconds(0)) == std::future_status::ready; });
    }
  }

  void serve(Peer* peer) {
    Scanner requests(Direction::kToServer, version_ > 1);
    for (TimePoint next = steady_clock::now(); !peer->is_over && !is_stopping_;) {
      const Bytes flood = nextOfFlood();
      send(flood, peer);
      const TimePoint::duration left = std::min<TimePoint::duration>(next - steady_clock::now(), kTick);
      isReady(peer->socket, POLLIN, flood.empty() ? left : TimePoint::duration::zero());
      receive(&requests, peer);
      if (const TimePoint now = steady_clock::now(); now >= next) {
        sendWhatIsDue(peer);
        next = std::max(next + period_, now);
      }
    }
  }

  Bytes nextOfFlood() {
    const std::lock_guard<std::mutex> lock(mutex_);
    Bytes bytes;
    for (Bytes more; flood_ && bytes.size() < kFloodSize && !(more = flood_()).empty();) {
      bytes.insert(bytes.end(), more.begin(), more.end());
    }
    return bytes;
  }

  void receive(Scanner* requests, Peer* peer) {
    std::array<std::uint8_t, 4096> buffer;
    const ssize_t count = ::recv(peer->socket.get(), buffer.data(), buffer.size(), 0);
    if (count <= 0) {
      peer->is_over = peer->is_over || count == 0 || errno != EAGAIN;
      return;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (const std::optional<Message> request = requests->take(buffer[i])) {
        request->version2 ? answerVersion2(*request, peer) : answerVersion1(*request, peer);
      }
    }
  }

  void answerVersion1(const Message& request, Peer* peer) {
    switch (request.kind) {
      case protocol::REQUEST_NEWER_VERSION:
        peer->version2 = version_ > 1;
        send(peer->version2 ? Bytes{'x', 2, 0, 0} : Bytes{'e', 0, 0, 0}, peer);
        break;
      case protocol::REQUEST_STREAM_TOGGLE:
        peer->streaming = !peer->streaming;
        break;
      case protocol::REQUEST_PICTURE:
        peer->owed.push_back(0);
        break;
      case protocol::REQUEST_JOINT:
      case protocol::REQUEST_SENSOR:
        send({static_cast<std::uint8_t>(protocol::version2::replyKind(request.kind)),
              static_cast<std::uint8_t>(request.id), 0, 0},
             peer);
        break;
      default:
        send({'e', 0, 0, 0}, peer);
    }
  }

  // Accepts unknown requests, too: the reply repeats the request.
  void answerVersion2(const Message& request, Peer* peer) {
    Bytes reply = request.payload;
    switch (request.kind) {
      case protocol::version2::REQUEST_HELLO:
        reply = version2_frames::makeHello("F W J V T A");
        break;
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
    send(frame, peer);
    if (request.kind == protocol::version2::REQUEST_JOINTS) {
      const Bytes end = version2_frames::makeEnd(protocol::version2::ENDED_JOINTS, protocol::version2::END_DONE, "", "",
                                                 request.number);
      send(version2_frames::makeFrame(protocol::version2::END_PUSH, 0, end), peer);
    }
  }

  void sendWhatIsDue(Peer* peer) {
    if (!peer->owed.empty()) {
      sendPicture(peer->owed.front(), peer);
      peer->owed.pop_front();
    } else if (peer->streaming) {
      sendPicture(0, peer);
    }
    if (peer->version2 && peer->telemetry && telemetry_) {
      const auto frame = static_cast<unsigned>(steady_clock::now().time_since_epoch() / milliseconds(8));
      send(version2_frames::makeFrame(
               protocol::version2::TELEMETRY_PUSH, 0,
               version2_frames::makeTelemetry(frame, {{'J', 1, 0}, {'J', 2, 0}, {'S', 66, 500000}})),
           peer);
    }
  }

  void sendPicture(int request, Peer* peer) {
    test_pictures::Name name = {peer->connection, 0};
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      name.number = ++number_;
      times_[name.number % kRemembered] = steady_clock::now();
    }
    const Bytes jpeg = test_pictures::makeNamed(name);
    send(peer->version2
             ? version2_frames::makeFrame(protocol::version2::PICTURE, request,
                                          version2_frames::makePicture(jpeg, static_cast<unsigned>(name.number)))
             : test_pictures::makeReply(jpeg),
         peer);
  }

  void send(const Bytes& bytes, Peer* peer) {
    const auto may_wait = [&] { return !is_stopping_ && !isReady(peer->socket, POLLRDHUP, milliseconds(0)); };
    peer->is_over = peer->is_over || !sendAll(peer->socket, bytes.data(), bytes.size(), may_wait);
  }

  const int version_;
  const std::chrono::microseconds period_;
  const host_files::FileDescriptor listener_;
  std::atomic<std::uint64_t> number_{0};
  std::atomic<bool> telemetry_{false};
  std::atomic<bool> is_stopping_{false};
  mutable std::mutex mutex_;  // guards what follows, down to the future
  std::vector<TimePoint> times_;
  Flood flood_;
  std::future<void> accepting_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PICTURE_SERVER_H
