#include "simulator/openr_host/ip_stack/tcp_endpoint.h"

#include <sys/socket.h>

#include <cerrno>
#include <utility>

#include "simulator/openr_host/ip_stack/socket.h"

namespace openr_host {
namespace {

/// The errors of a connection that was not established.
const std::map<int, TCPEndpointError> kConnectErrors = {
    {ECONNREFUSED, TCP_PORT_UNREACHABLE}, {EHOSTUNREACH, TCP_HOST_UNREACHABLE}, {ENETUNREACH, TCP_NETWORK_UNREACHABLE},
    {EINVAL, TCP_ADDRESSERROR},           {EACCES, TCP_ADDRESSERROR},           {EADDRNOTAVAIL, TCP_ADDRESSERROR},
    {EPIPE, TCP_CONNECTION_CLOSED},       {ECONNRESET, TCP_CONNECTION_RESET},   {ETIMEDOUT, TCP_CONNECTION_TIMEOUT}};

/// The errors of a connection that broke.
const std::map<int, TCPEndpointError> kErrors = {{EPIPE, TCP_CONNECTION_CLOSED},
                                                 {ECONNRESET, TCP_CONNECTION_RESET},
                                                 {ETIMEDOUT, TCP_CONNECTION_TIMEOUT},
                                                 {EHOSTUNREACH, TCP_CONNECTION_TIMEOUT},
                                                 {ENETUNREACH, TCP_CONNECTION_TIMEOUT}};

/// Discards received bytes.
/// @return 0 if the other side has closed the connection, otherwise an error number
int drain(int socket) {
  char scrap[4096];
  ssize_t count = 0;
  do {
    count = recv(socket, scrap, sizeof(scrap), MSG_DONTWAIT);
  } while (count > 0);
  return count == 0 ? 0 : errno;
}

}  // namespace

TcpEndpoint::TcpEndpoint(int pool_size, const Deliver& deliver)
    : pool_size_(pool_size),
      deliver_(deliver),
      listening_(deliver),
      connecting_(deliver),
      sending_(deliver),
      receiving_(deliver),
      closing_(deliver) {}

template <typename Message>
bool TcpEndpoint::mayBegin(const PendingMessage<Message>& under_way, const Envelope& message) const {
  if (state_ != State::kConnected) {
    answer<Message>(deliver_, message, state_ == State::kBroken ? why_broken_ : TCP_OPERATION_INVALID);
    return false;
  }
  if (under_way) {
    answer<Message>(deliver_, message, TCP_CONNECTION_BUSY);
    return false;
  }
  return true;
}

void TcpEndpoint::listen(const Envelope& message) {
  state_ = State::kListening;
  listening_.begin(message);
}

void TcpEndpoint::accept(TcpConnection connection) {
  becomeConnected(std::move(connection.socket));
  listening_->lAddress = SocketAddress::ofSocket(socket_.get()).address;
  listening_->fAddress = connection.client.address;
  listening_->fPort = connection.client.port;
  listening_.end(TCP_SUCCESS);
}

void TcpEndpoint::becomeConnected(FileDescriptor socket) {
  socket_ = std::move(socket);
  state_ = State::kConnected;
  setsockopt(socket_.get(), SOL_SOCKET, SO_SNDBUF, &pool_size_, sizeof(pool_size_));
}

void TcpEndpoint::connect(const Envelope& message) {
  if (state_ != State::kNew) {
    answer<TCPEndpointConnectMsg>(deliver_, message, TCP_OPERATION_INVALID);
    return;
  }
  state_ = State::kConnecting;
  connecting_.begin(message);
  socket_ = FileDescriptor(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const sockaddr_in server = SocketAddress(connecting_->fAddress, connecting_->fPort).system();
  if (::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&server), sizeof(server)) == 0) {
    finishConnecting();
  } else if (errno != EINPROGRESS) {
    breakOff(errno);
  }
}

void TcpEndpoint::finishConnecting() {
  int error = 0;
  socklen_t size = sizeof(error);
  if (getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &error, &size) != 0 || error != 0 ||
      !configureTcpConnection(socket_.get())) {
    breakOff(error);
    return;
  }
  becomeConnected(std::move(socket_));
  const auto local = SocketAddress::ofSocket(socket_.get());
  connecting_->lAddress = local.address;
  connecting_->lPort = local.port;
  connecting_.end(TCP_SUCCESS);
}

void TcpEndpoint::send(const Envelope& message) {
  if (mayBegin(sending_, message)) {
    sending_.begin(message);
    sent_ = 0;
    goOnSending();
  }
}

void TcpEndpoint::goOnSending() {
  while (sent_ < sizeOf(sending_->size)) {
    const ssize_t count =
        ::send(socket_.get(), sending_->buffer + sent_, sizeOf(sending_->size) - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) {
      breakOffUnlessTransient(errno);
      return;
    }
    sent_ += static_cast<std::size_t>(count);
  }
  sending_.end(TCP_SUCCESS);
}

void TcpEndpoint::receive(const Envelope& message) {
  if (mayBegin(receiving_, message)) {
    receiving_.begin(message);
    received_ = 0;
    goOnReceiving();
  }
}

void TcpEndpoint::goOnReceiving() {
  while (received_ < sizeOf(receiving_->sizeMin)) {
    const ssize_t count =
        ::recv(socket_.get(), receiving_->buffer + received_, sizeOf(receiving_->sizeMax) - received_, MSG_DONTWAIT);
    if (count < 0) {
      breakOffUnlessTransient(errno);
      return;
    }
    if (count == 0) {
      endReceive(TCP_CONNECTION_CLOSED);
      return;
    }
    received_ += static_cast<std::size_t>(count);
  }
  endReceive(TCP_SUCCESS);
}

void TcpEndpoint::endReceive(TCPEndpointError error) {
  if (receiving_) {
    receiving_->sizeMin = static_cast<int>(received_);
    receiving_->sizeMax = static_cast<int>(received_);
    receiving_.end(error);
  }
}

void TcpEndpoint::breakOffUnlessTransient(int error) {
  if (!isTransient(error)) {
    breakOff(error);
  }
}

void TcpEndpoint::breakOff(int error) {
  why_broken_ = errorOf(error, state_ == State::kConnecting ? kConnectErrors : kErrors, TCP_FAIL);
  state_ = closing_ ? State::kClosed : State::kBroken;
  socket_.close();
  connecting_.end(why_broken_);
  endReceive(why_broken_);
  sending_.end(why_broken_);
  closing_.end(why_broken_);
}

bool TcpEndpoint::closesAtOnce(bool abort) const {
  if (abort || !socket_.isOpen() || state_ == State::kConnecting) {
    return true;
  }
  char next = 0;
  return !sending_ && recv(socket_.get(), &next, sizeof(next), MSG_PEEK | MSG_DONTWAIT) == 0;
}

void TcpEndpoint::closeAtOnce(bool abort) {
  state_ = State::kClosed;
  if (abort) {
    const linger reset{1, 0};
    setsockopt(socket_.get(), SOL_SOCKET, SO_LINGER, &reset, sizeof(reset));
  }
  socket_.close();
  listening_.end(TCP_CONNECTION_CLOSED);
  connecting_.end(TCP_CONNECTION_CLOSED);
  endReceive(TCP_CONNECTION_CLOSED);
  sending_.end(TCP_CONNECTION_CLOSED);
  closing_.end(TCP_CONNECTION_RESET);
}

void TcpEndpoint::close(const Envelope& message) {
  const bool abort = message.as<TCPEndpointCloseMsg>().abort;
  if (closing_ && !abort) {
    answer<TCPEndpointCloseMsg>(deliver_, message, TCP_OPERATION_INVALID);
  } else if (closesAtOnce(abort)) {
    closeAtOnce(abort);
    answer<TCPEndpointCloseMsg>(deliver_, message, TCP_SUCCESS);
  } else {
    state_ = State::kClosing;
    closing_.begin(message);
    endReceive(TCP_CONNECTION_CLOSED);
    goOnClosing();
  }
}

void TcpEndpoint::goOnClosing() {
  if (!sending_ && !said_goodbye_) {
    shutdown(socket_.get(), SHUT_WR);
    said_goodbye_ = true;
  }
  // If the socket were closed with unread bytes, the kernel would reset the connection, and the other side would lose
  // what was sent last.
  if (!other_side_closed_) {
    const int error = drain(socket_.get());
    if (error != 0 && !isTransient(error)) {
      breakOff(error);
      return;
    }
    other_side_closed_ = error == 0;
  }
  if (said_goodbye_ && other_side_closed_) {
    state_ = State::kClosed;
    socket_.close();
    closing_.end(TCP_SUCCESS);
  }
}

bool TcpEndpoint::uses(const std::function<bool(const void*, std::size_t)>& is_concerned) const {
  return (sending_ && is_concerned(sending_->buffer, sizeOf(sending_->size))) ||
         (receiving_ && is_concerned(receiving_->buffer, sizeOf(receiving_->sizeMax)));
}

void TcpEndpoint::addTo(PollSet& poll_set) {
  if (connecting_) {
    poll_set.add(socket_.get(), POLLOUT, [this] { finishConnecting(); });
    return;
  }
  const bool reads = receiving_ || (closing_ && !other_side_closed_);
  if (!sending_ && !reads) {
    // There is nothing to wait for: no request is unanswered, and a broken connection would wake the poll again and
    // again.
    return;
  }
  const int events = (reads ? POLLIN : 0) | (sending_ ? POLLOUT : 0);
  poll_set.add(socket_.get(), static_cast<short>(events), [this] {
    if (receiving_) {
      goOnReceiving();
    }
    if (sending_) {
      goOnSending();
    }
    if (closing_) {
      goOnClosing();
    }
  });
}

}  // namespace openr_host
