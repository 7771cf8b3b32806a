#include "openr_host/ip_stack/endpoint.h"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <utility>

namespace openr_host {
namespace {

TCPEndpointError errorOf(int error) {
  switch (error) {
    case EPIPE:
      return TCP_CONNECTION_CLOSED;
    case ECONNRESET:
      return TCP_CONNECTION_RESET;
    case ETIMEDOUT:
    case EHOSTUNREACH:
    case ENETUNREACH:
      return TCP_CONNECTION_TIMEOUT;
    default:
      return TCP_FAIL;
  }
}

std::size_t sizeOf(int size) {
  return static_cast<std::size_t>(size);
}

}  // namespace

Endpoint::Endpoint(std::size_t pool_size, Deliver deliver) : pool_size_(pool_size), deliver_(std::move(deliver)) {}

template <typename Message>
void Endpoint::refuse(const Envelope& message, TCPEndpointError error) const {
  message.as<Message>().error = error;
  deliver_(message);
}

template <typename Message>
void Endpoint::answer(std::optional<Envelope>& message, TCPEndpointError error) {
  if (message) {
    refuse<Message>(*std::exchange(message, std::nullopt), error);
  }
}

template <typename Message>
bool Endpoint::mayBegin(const std::optional<Envelope>& under_way, const Envelope& message) const {
  if (state_ != State::kConnected) {
    refuse<Message>(message, state_ == State::kBroken ? why_broken_ : TCP_OPERATION_INVALID);
    return false;
  }
  if (under_way) {
    refuse<Message>(message, TCP_CONNECTION_BUSY);
    return false;
  }
  return true;
}

void Endpoint::listen(const Envelope& message) {
  state_ = State::kListening;
  listening_ = message;
}

void Endpoint::accept(TcpConnection connection) {
  socket_ = std::move(connection.socket);
  state_ = State::kConnected;
  const int buffer_size = static_cast<int>(std::min<std::size_t>(pool_size_, INT_MAX));
  setsockopt(socket_.get(), SOL_SOCKET, SO_SNDBUF, &buffer_size, sizeof(buffer_size));
  auto& message = listening_->as<TCPEndpointListenMsg>();
  message.fAddress = connection.address;
  message.fPort = connection.port;
  answer<TCPEndpointListenMsg>(listening_, TCP_SUCCESS);
}

void Endpoint::send(const Envelope& message) {
  if (mayBegin<TCPEndpointSendMsg>(sending_, message)) {
    sending_ = message;
    sent_ = 0;
    goOnSending();
  }
}

void Endpoint::goOnSending() {
  const auto& message = sending_->as<TCPEndpointSendMsg>();
  while (sent_ < sizeOf(message.size)) {
    const ssize_t count =
        ::send(socket_.get(), message.buffer + sent_, sizeOf(message.size) - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) {
      if (errno == EINTR) {
        continue;
      }
      if (errno != EAGAIN) {
        breakOff(errno);
      }
      return;
    }
    sent_ += static_cast<std::size_t>(count);
  }
  answer<TCPEndpointSendMsg>(sending_, TCP_SUCCESS);
}

void Endpoint::receive(const Envelope& message) {
  if (mayBegin<TCPEndpointReceiveMsg>(receiving_, message)) {
    receiving_ = message;
    received_ = 0;
    goOnReceiving();
  }
}

void Endpoint::goOnReceiving() {
  auto& message = receiving_->as<TCPEndpointReceiveMsg>();
  const std::size_t wanted = sizeOf(message.sizeMin);
  while (received_ < wanted) {
    const ssize_t count =
        ::recv(socket_.get(), message.buffer + received_, sizeOf(message.sizeMax) - received_, MSG_DONTWAIT);
    if (count < 0) {
      if (errno == EINTR) {
        continue;
      }
      if (errno != EAGAIN) {
        breakOff(errno);
      }
      return;
    }
    if (count == 0) {
      message.sizeMin = static_cast<int>(received_);
      answer<TCPEndpointReceiveMsg>(receiving_, TCP_CONNECTION_CLOSED);
      return;
    }
    received_ += static_cast<std::size_t>(count);
  }
  message.sizeMin = static_cast<int>(received_);
  answer<TCPEndpointReceiveMsg>(receiving_, TCP_SUCCESS);
}

void Endpoint::breakOff(int error) {
  state_ = State::kBroken;
  why_broken_ = errorOf(error);
  socket_.close();
  if (receiving_) {
    receiving_->as<TCPEndpointReceiveMsg>().sizeMin = static_cast<int>(received_);
  }
  answer<TCPEndpointReceiveMsg>(receiving_, why_broken_);
  answer<TCPEndpointSendMsg>(sending_, why_broken_);
}

FileDescriptor Endpoint::close() {
  if (receiving_) {
    receiving_->as<TCPEndpointReceiveMsg>().sizeMin = static_cast<int>(received_);
  }
  answer<TCPEndpointListenMsg>(listening_, TCP_CONNECTION_CLOSED);
  answer<TCPEndpointReceiveMsg>(receiving_, TCP_CONNECTION_CLOSED);
  answer<TCPEndpointSendMsg>(sending_, TCP_CONNECTION_CLOSED);
  return std::move(socket_);
}

bool Endpoint::uses(const std::function<bool(const void*, std::size_t)>& is_concerned) const {
  const auto* sending = sending_ ? &sending_->as<TCPEndpointSendMsg>() : nullptr;
  const auto* receiving = receiving_ ? &receiving_->as<TCPEndpointReceiveMsg>() : nullptr;
  return (sending != nullptr && is_concerned(sending->buffer, sizeOf(sending->size))) ||
         (receiving != nullptr && is_concerned(receiving->buffer, sizeOf(receiving->sizeMax)));
}

void Endpoint::addTo(PollSet& poll_set) {
  if (!sending_ && !receiving_) {
    return;  // nobody is there to be told, and a broken connection would wake the poll again and again
  }
  const int events = (receiving_ ? POLLIN : 0) | (sending_ ? POLLOUT : 0);
  poll_set.add(socket_.get(), static_cast<short>(events), [this] {
    if (receiving_) {
      goOnReceiving();
    }
    if (sending_) {
      goOnSending();
    }
  });
}

}  // namespace openr_host
