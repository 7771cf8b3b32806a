#include "support/picture_server.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <list>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "client/event.h"
#include "support/sockets.h"
#include "support/test_pictures.h"
#include "support/version2_frames.h"

using aibo_driver::Event;
using aibo_driver::FileDescriptor;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace version2 = protocol::version2;

namespace fault_bench {
namespace {

constexpr std::size_t kRemembered = 4096;

struct Peer {
  FileDescriptor socket;
  std::uint32_t connection = 0;
  bool version2 = false;
  bool streaming = false;
  std::vector<int> owed{};  // request numbers of pictures; 0 in version 1
  Bytes in{};
  Bytes out{};
  bool over = false;
};

}  // namespace

class PictureServer::Implementation {
 public:
  Implementation(int version, std::chrono::microseconds period)
      : version_(version), period_(period), listener_(bindTo("127.0.0.1", 0)), times_(kRemembered) {
    makeNumberedPicture({});  // takes its time the first time
    port_ = portOf(listener_);
    check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
    thread_ = std::thread([this] { run(); });
  }

  ~Implementation() {
    stopping_ = true;
    wake_up_.raise();
    thread_.join();
  }

  int port() const { return port_; }

  void setStopped(bool stopped) {
    stopped_ = stopped;
    wake_up_.raise();
  }

  void spoilNext(std::function<Bytes(Bytes jpeg)> change) {
    const std::lock_guard<std::mutex> lock(mutex_);
    spoil_ = std::move(change);
  }

  std::pair<PictureName, Bytes> lastSpoilt() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return spoilt_;
  }

  std::uint64_t lastNumber() const { return number_; }

  TimePoint timeOf(std::uint64_t number) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return times_[number % kRemembered];
  }

  std::uint64_t jointCommands() const { return joint_commands_; }

 private:
  void run() {
    next_picture_ = steady_clock::now();
    while (!stopping_) {
      if (stopped_) {
        waitFor({{wake_up_.descriptor(), POLLIN, 0}}, steady_clock::now() + milliseconds(100));
        next_picture_ = steady_clock::now();
        continue;
      }
      std::vector<pollfd> polled = {{wake_up_.descriptor(), POLLIN, 0}, {listener_.get(), POLLIN, 0}};
      for (const Peer& peer : peers_) {
        polled.push_back({peer.socket.get(), static_cast<short>(peer.out.empty() ? POLLIN : POLLIN | POLLOUT), 0});
      }
      waitFor(std::move(polled), next_picture_);
      serveAll();
    }
  }

  void waitFor(std::vector<pollfd> polled, TimePoint end) {
    const auto left = std::max(std::chrono::nanoseconds(0), std::chrono::nanoseconds(end - steady_clock::now()));
    const timespec timeout = {left.count() / 1000000000, left.count() % 1000000000};
    ::ppoll(polled.data(), polled.size(), &timeout, nullptr);
    wake_up_.clear();
  }

  void serveAll() {
    for (FileDescriptor client; (client = acceptFrom(listener_)).valid();) {
      peers_.push_back({std::move(client), ++connections_});
    }
    const TimePoint now = steady_clock::now();
    const bool picture = now >= next_picture_;
    for (Peer& peer : peers_) {
      receive(&peer);
      if (picture) {
        sendPictures(&peer);
      }
      flush(&peer);
    }
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
    peer->in.insert(peer->in.end(), buffer.begin(), buffer.begin() + count);
    while (peer->version2 ? takeFrame(peer) : takeCommand(peer)) {
    }
  }

  bool takeCommand(Peer* peer) {
    if (peer->in.size() < protocol::BASIC_COMMAND_SIZE) {
      return false;
    }
    const protocol::BasicGetCommand command = protocol::decodeCommand(peer->in.data());
    consume(protocol::BASIC_COMMAND_SIZE, peer);
    switch (command.command) {
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
        append({static_cast<std::uint8_t>(version2::replyKind(command.command)), command.identifier, 0, 0}, peer);
        break;
      default:
        append({'e', 0, 0, 0}, peer);
    }
    return true;
  }

  bool takeFrame(Peer* peer) {
    if (peer->in.size() < version2::FRAME_HEADER_SIZE) {
      return false;
    }
    const version2::FrameHeader header = version2::decodeFrameHeader(peer->in.data());
    if (peer->in.size() < version2::FRAME_HEADER_SIZE + header.payload_size) {
      return false;
    }
    const auto payload = peer->in.begin() + version2::FRAME_HEADER_SIZE;
    answer(header, Bytes(payload, payload + header.payload_size), peer);
    consume(version2::FRAME_HEADER_SIZE + header.payload_size, peer);
    return true;
  }

  // What it does not know is carried out, too: the reply repeats the request.
  void answer(const version2::FrameHeader& header, const Bytes& payload, Peer* peer) {
    switch (header.kind) {
      case version2::REQUEST_HELLO:
        append(version2_frames::makeFrame('h', header.request_number, version2_frames::makeHello()), peer);
        return;
      case version2::REQUEST_PICTURE:
        peer->owed.push_back(header.request_number);
        return;
      case version2::REQUEST_STREAM:
        peer->streaming = !payload.empty() && payload.front() != 0;
        break;
      case version2::REQUEST_JOINTS:
        ++joint_commands_;
        break;
      default:
        break;
    }
    append(version2_frames::makeFrame(version2::replyKind(header.kind), header.request_number, payload), peer);
  }

  static void consume(std::size_t size, Peer* peer) {
    peer->in.erase(peer->in.begin(), peer->in.begin() + static_cast<std::ptrdiff_t>(size));
  }

  static void append(const Bytes& bytes, Peer* peer) { peer->out.insert(peer->out.end(), bytes.begin(), bytes.end()); }

  void sendPictures(Peer* peer) {
    if (!peer->out.empty()) {
      return;
    }
    if (!peer->owed.empty()) {
      const int request = peer->owed.front();
      peer->owed.erase(peer->owed.begin());
      append(wrap(nextPicture(*peer, false), request, *peer), peer);
    } else if (peer->streaming) {
      append(wrap(nextPicture(*peer, true), 0, *peer), peer);
    }
  }

  Bytes wrap(const Bytes& jpeg, int request, const Peer& peer) const {
    if (!peer.version2) {
      return test_pictures::makeReply(jpeg);
    }
    const Bytes payload = version2_frames::makePicture(jpeg, static_cast<unsigned>(number_));
    return version2_frames::makeFrame(version2::PICTURE, request, payload);
  }

  Bytes nextPicture(const Peer& peer, bool may_be_spoilt) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const PictureName name = {peer.connection, ++number_};
    times_[name.number % kRemembered] = steady_clock::now();
    Bytes jpeg = makeNumberedPicture(name);
    if (spoil_ && may_be_spoilt) {
      jpeg = std::exchange(spoil_, nullptr)(std::move(jpeg));
      spoilt_ = {name, jpeg};
    }
    return jpeg;
  }

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
  const FileDescriptor listener_;
  int port_ = 0;
  TimePoint next_picture_;
  std::list<Peer> peers_;
  std::uint32_t connections_ = 0;
  std::atomic<std::uint64_t> number_{0};
  std::atomic<std::uint64_t> joint_commands_{0};
  std::atomic<bool> stopped_{false};
  mutable std::mutex mutex_;  // guards what follows
  std::vector<TimePoint> times_;
  std::function<Bytes(Bytes jpeg)> spoil_;
  std::pair<PictureName, Bytes> spoilt_;

  Event wake_up_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

PictureServer::PictureServer(int version, std::chrono::microseconds period)
    : implementation_(std::make_unique<Implementation>(version, period)) {}

PictureServer::~PictureServer() = default;

int PictureServer::port() const {
  return implementation_->port();
}

void PictureServer::setStopped(bool stopped) {
  implementation_->setStopped(stopped);
}

void PictureServer::spoilNext(std::function<Bytes(Bytes jpeg)> change) {
  implementation_->spoilNext(std::move(change));
}

std::pair<PictureName, Bytes> PictureServer::lastSpoilt() const {
  return implementation_->lastSpoilt();
}

std::uint64_t PictureServer::lastNumber() const {
  return implementation_->lastNumber();
}

TimePoint PictureServer::timeOf(std::uint64_t number) const {
  return implementation_->timeOf(number);
}

std::uint64_t PictureServer::jointCommands() const {
  return implementation_->jointCommands();
}

}  // namespace fault_bench
