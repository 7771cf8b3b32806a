#include "support/picture_server.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>
#include <vector>

#include "support/sockets.h"
#include "support/test_pictures.h"
#include "support/version2_frames.h"

using host_files::FileDescriptor;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace version2 = protocol::version2;

namespace test_support {
namespace {

// A flood is made in portions of this size.
constexpr std::size_t kFloodSize = 65536;

constexpr milliseconds kTelemetryPeriod{32};

}  // namespace

PictureServer::PictureServer(int version, std::chrono::microseconds period)
    : version_(version), period_(period), listener_(bindTo("127.0.0.1", 0)), times_(kRemembered) {
  test_pictures::makeNamed({});  // slow the first time
  port_ = portOf(listener_);
  check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
  thread_ = std::thread([this] { run(); });
}

PictureServer::~PictureServer() {
  stopping_ = true;
  wake_up_.raise();
  thread_.join();
}

void PictureServer::setStopped(bool stopped) {
  stopped_ = stopped;
  wake_up_.raise();
}

void PictureServer::spoilNext(std::function<Bytes(Bytes jpeg)> change) {
  const std::lock_guard<std::mutex> lock(mutex_);
  spoil_ = std::move(change);
}

void PictureServer::flood(Flood flood) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    flood_ = std::move(flood);
  }
  wake_up_.raise();
}

TimePoint PictureServer::timeOf(std::uint64_t number) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return times_[number % kRemembered];
}

void PictureServer::run() {
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
    const bool is_anybody_ready =
        std::any_of(peers_.begin(), peers_.end(), [](const Peer& peer) { return peer.out.empty(); });
    waitFor(std::move(polled), is_anybody_ready ? next_picture_ : steady_clock::now() + milliseconds(100));
    serveAll();
  }
}

void PictureServer::waitFor(std::vector<pollfd> polled, TimePoint end) {
  const auto left = std::max(std::chrono::nanoseconds(0), std::chrono::nanoseconds(end - steady_clock::now()));
  const timespec timeout = {left.count() / 1000000000, left.count() % 1000000000};
  ::ppoll(polled.data(), polled.size(), &timeout, nullptr);
  wake_up_.clear();
}

void PictureServer::serveAll() {
  for (FileDescriptor client; (client = acceptFrom(listener_)).valid();) {
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

void PictureServer::receive(Peer* peer) {
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

void PictureServer::answerVersion1(const Request& request, Peer* peer) {
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
      append(
          {static_cast<std::uint8_t>(version2::replyKind(request.kind)), static_cast<std::uint8_t>(request.id), 0, 0},
          peer);
      break;
    default:
      append({'e', 0, 0, 0}, peer);
  }
}

// Accepts unknown requests, too: the reply repeats the request.
void PictureServer::answerVersion2(const Request& request, Peer* peer) {
  Bytes reply = request.payload;
  switch (request.kind) {
    case version2::REQUEST_HELLO:
      append(version2_frames::makeFrame('h', request.number, version2_frames::makeHello("F W J V T A")), peer);
      return;
    case version2::REQUEST_PICTURE:
      peer->owed.push_back(request.number);
      return;
    case version2::REQUEST_STREAM:
      peer->streaming = !request.payload.empty() && request.payload.front() != 0;
      break;
    case version2::REQUEST_TELEMETRY:
      peer->telemetry = request.payload != Bytes{0, 0};
      break;
    case version2::REQUEST_JOINTS:
    case version2::REQUEST_MOTORS:  // replies to orders are without their expiry
      reply.erase(reply.begin(),
                  reply.begin() + std::min<std::ptrdiff_t>(4, static_cast<std::ptrdiff_t>(reply.size())));
      break;
    case version2::REQUEST_PLAY:
      reply.clear();
      break;
    default:
      break;
  }
  Bytes frame = version2_frames::makeFrame(version2::replyKind(request.kind), request.number, reply);
  frame[1] = static_cast<std::uint8_t>(request.id);
  append(frame, peer);
  if (request.kind == version2::REQUEST_JOINTS) {
    const Bytes end = version2_frames::makeEnd(version2::ENDED_JOINTS, version2::END_DONE, "", "", request.number);
    append(version2_frames::makeFrame(version2::END_PUSH, 0, end), peer);
  }
}

void PictureServer::append(const Bytes& bytes, Peer* peer) {
  peer->out.insert(peer->out.end(), bytes.begin(), bytes.end());
}

void PictureServer::sendPictures(Peer* peer) {
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

void PictureServer::sendTelemetry(Peer* peer) {
  if (peer->version2 && peer->telemetry) {
    const auto frame = static_cast<unsigned>(next_telemetry_.time_since_epoch() / milliseconds(8));
    append(version2_frames::makeFrame(
               version2::TELEMETRY_PUSH, 0,
               version2_frames::makeTelemetry(frame, {{'J', 1, 0}, {'J', 2, 0}, {'S', 66, 500000}})),
           peer);
  }
}

void PictureServer::addFlood(Peer* peer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  while (flood_ && peer->out.size() < kFloodSize) {
    append(flood_(), peer);
  }
}

Bytes PictureServer::wrap(const Bytes& jpeg, int request, const Peer& peer) const {
  if (!peer.version2) {
    return test_pictures::makeReply(jpeg);
  }
  const Bytes payload = version2_frames::makePicture(jpeg, static_cast<unsigned>(number_));
  return version2_frames::makeFrame(version2::PICTURE, request, payload);
}

Bytes PictureServer::nextPicture(const Peer& peer, bool may_be_spoilt) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const test_pictures::Name name = {peer.connection, ++number_};
  times_[name.number % kRemembered] = steady_clock::now();
  Bytes jpeg = test_pictures::makeNamed(name);
  if (spoil_ && may_be_spoilt) {
    jpeg = std::exchange(spoil_, nullptr)(std::move(jpeg));
  }
  return jpeg;
}

void PictureServer::flush(Peer* peer) {
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

}  // namespace test_support
