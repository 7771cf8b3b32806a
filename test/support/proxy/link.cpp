#include "support/proxy/link.h"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "support/sockets.h"

namespace test_support {
namespace {

constexpr short kGone = POLLHUP | POLLERR | POLLNVAL;

}  // namespace

Link::Link(std::size_t number, aibo_client::FileDescriptor client, aibo_client::FileDescriptor server, unsigned seed)
    : number_(number),
      client_{std::move(client), Pipe(Direction::kToClient, seed)},
      server_{std::move(server), Pipe(Direction::kToServer, seed + 1)} {}

bool Link::mayRead(const Side& from, const Side& to, const Conditions& conditions) const {
  const bool paused = conditions.paused && &from == &server_;
  return !from.ended && !to.out.isFull(conditions) && !paused;
}

std::array<pollfd, 2> Link::interests(TimePoint now, const Conditions& conditions) {
  const auto interest = [&](Side& side, const Side& other) {
    const bool may_send = side.blocked || (!side.out.pieces().empty() && side.out.pieces().front().due <= now);
    const int events = (mayRead(side, other, conditions) ? POLLIN : 0) | (may_send ? POLLOUT : 0);
    return pollfd{events == 0 ? -1 : side.socket.get(), static_cast<short>(events), 0};
  };
  if (draining_) {
    return {{{client_.socket.get(), POLLIN, 0}, {-1, 0, 0}}};
  }
  if (silent_) {
    return {{{client_.socket.get(), POLLRDHUP, 0}, {server_.socket.get(), POLLRDHUP, 0}}};
  }
  if (connecting_) {
    return {{{-1, 0, 0}, {server_.socket.get(), POLLOUT, 0}}};
  }
  return {{interest(client_, server_), interest(server_, client_)}};
}

TimePoint Link::nextDue() const {
  TimePoint next = TimePoint::max();
  if (!draining_ && !silent_ && !connecting_) {
    for (const Side* side : {&client_, &server_}) {
      if (!side->out.pieces().empty() && !side->blocked) {
        next = std::min(next, side->out.pieces().front().due);
      }
    }
  }
  return next;
}

void Link::serve(const std::array<pollfd, 2>& polled, TimePoint now, const Conditions& conditions, FaultQueue* faults,
                 const Tap& tap, std::vector<FaultReport>* reports) {
  if (draining_) {
    std::array<std::uint8_t, 4096> ignored;
    const ssize_t count = ::recv(client_.socket.get(), ignored.data(), ignored.size(), 0);
    over_ = count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
    return;
  }
  if (silent_) {
    if (polled[0].revents != 0) {
      client_.socket.close();  // the server does not notice
    }
    over_ = polled[1].revents != 0 || !server_.socket.valid();
    return;
  }
  if (connecting_) {
    if (polled[1].revents != 0) {
      int error = 0;
      socklen_t size = sizeof error;
      ::getsockopt(server_.socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
      connecting_ = false;
      over_ = error != 0;
    }
    return;
  }
  if ((polled[1].revents & (POLLIN | kGone)) != 0 && mayRead(server_, client_, conditions)) {
    receive(&server_, &client_, Direction::kToClient, now, conditions, faults, tap, reports);
  }
  if ((polled[0].revents & (POLLIN | kGone)) != 0 && !over_ && mayRead(client_, server_, conditions)) {
    receive(&client_, &server_, Direction::kToServer, now, conditions, faults, tap, reports);
  }
  client_.blocked = client_.blocked && polled[0].revents == 0;
  server_.blocked = server_.blocked && polled[1].revents == 0;
  const TimePoint sending = std::chrono::steady_clock::now();
  send(&client_, Direction::kToClient, sending);
  send(&server_, Direction::kToServer, sending);
}

void Link::receive(Side* from, Side* to, Direction direction, TimePoint now, const Conditions& conditions,
                   FaultQueue* faults, const Tap& tap, std::vector<FaultReport>* reports) {
  std::array<std::uint8_t, 4096> buffer;
  const ssize_t count = ::recv(from->socket.get(), buffer.data(), buffer.size(), 0);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return;
  }
  if (count < 0) {
    end(Action::kReset, direction);
    return;
  }
  if (count == 0) {
    from->ended = true;
    to->out.end(Action::kHalfClose, now);
    return;
  }
  const auto size = static_cast<std::size_t>(count);
  if (tap) {
    tap(number_, direction, buffer.data(), size);
  }
  for (FaultReport& report : to->out.take(buffer.data(), size, now, conditions, faults)) {
    report.connection = number_;
    reports->push_back(std::move(report));
  }
}

void Link::send(Side* side, Direction direction, TimePoint now) {
  std::deque<Pipe::Piece>& pieces = side->out.pieces();
  while (!pieces.empty() && pieces.front().due <= now && !side->blocked && !over_ && !draining_ && !silent_) {
    if (pieces.front().end) {
      const Action action = *pieces.front().end;
      pieces.pop_front();
      end(action, direction);
    } else if (side->told) {
      side->out.sent(pieces.front().bytes.size());  // lost, because this side has got a FIN
      pieces.pop_front();
    } else if (!sendFront(side)) {
      end(Action::kReset, direction);
    }
  }
}

/// @return false if the connection is broken
bool Link::sendFront(Side* side) {
  Bytes& bytes = side->out.pieces().front().bytes;
  const ssize_t count = ::send(side->socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (count < 0) {
    side->blocked = errno == EAGAIN;
    return errno == EAGAIN || errno == EINTR;
  }
  side->out.sent(static_cast<std::size_t>(count));
  if (static_cast<std::size_t>(count) == bytes.size()) {
    side->out.pieces().pop_front();
  } else {
    bytes.erase(bytes.begin(), bytes.begin() + count);
  }
  return true;
}

void Link::end(Action end, Direction direction) {
  Side& receiver = direction == Direction::kToClient ? client_ : server_;
  switch (end) {
    case Action::kClose:
      // A close() with unread bytes would be a reset. So the client gets a FIN first, and closes its side.
      ::shutdown(client_.socket.get(), SHUT_WR);
      server_.socket.close();
      draining_ = true;
      break;
    case Action::kHalfClose:
      ::shutdown(receiver.socket.get(), SHUT_WR);
      receiver.told = true;
      over_ = client_.told && server_.told;
      break;
    case Action::kSilence:
      silent_ = true;
      break;
    default:
      resetWhenClosed(client_.socket);
      resetWhenClosed(server_.socket);
      over_ = true;
  }
}

}  // namespace test_support
