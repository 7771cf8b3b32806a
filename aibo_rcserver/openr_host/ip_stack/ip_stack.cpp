#include "openr_host/ip_stack/ip_stack.h"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace openr_host {
namespace {

/// More connections than this do not wait for their clients' side of the closing.
constexpr std::size_t kMostClosing = 16;

std::size_t sizeOf(antOperation operation) {
  switch (operation) {
    case antOperation_CreateSharedBuffer:
      return sizeof(antEnvCreateSharedBufferMsg);
    case antOperation_DestroySharedBuffer:
      return sizeof(antEnvDestroySharedBufferMsg);
    case antOperation_CreateEndpoint:
      return sizeof(antEnvCreateEndpointMsg);
    case antOperation_TCPListen:
      return sizeof(TCPEndpointListenMsg);
    case antOperation_TCPSend:
      return sizeof(TCPEndpointSendMsg);
    case antOperation_TCPReceive:
      return sizeof(TCPEndpointReceiveMsg);
    case antOperation_TCPClose:
      return sizeof(TCPEndpointCloseMsg);
  }
  return 0;
}

/// Throws away what the client still sends.
/// @return false when it has closed its side
bool drain(int socket) {
  char scrap[4096];
  for (;;) {
    const ssize_t count = recv(socket, scrap, sizeof(scrap), MSG_DONTWAIT);
    if (count == 0) {
      return false;
    }
    if (count < 0) {
      return errno == EAGAIN || errno == EINTR;
    }
  }
}

}  // namespace

IpStack::IpStack(std::string bind_address, Endpoint::Deliver deliver, std::function<bool()> objects_are_busy,
                 OnSend on_send)
    : bind_address_(std::move(bind_address)),
      deliver_(std::move(deliver)),
      objects_are_busy_(std::move(objects_are_busy)),
      on_send_(std::move(on_send)) {}

std::uint16_t IpStack::takePort(std::uint16_t robot_port, std::uint16_t host_port) {
  const auto taken = ports_.emplace(robot_port, TcpPort{TcpListener(bind_address_, host_port), {}}).first;
  return taken->second.listener.port();
}

antError IpStack::call(antEnvMsg& message, std::size_t size) {
  return size == sizeOf(message.operation) ? answerAtOnce(message) : ANT_FAIL;
}

antError IpStack::send(const Envelope& message, std::size_t size) {
  if (size != sizeOf(message.message().operation)) {
    return ANT_FAIL;
  }
  switch (message.message().operation) {
    case antOperation_TCPListen:
      listen(message);
      break;
    case antOperation_TCPSend:
      sendData(message);
      break;
    case antOperation_TCPReceive:
      receiveData(message);
      break;
    default:
      answerAtOnce(message.message());
      deliver_(message);
      break;
  }
  return ANT_SUCCESS;
}

antError IpStack::answerAtOnce(antEnvMsg& message) {
  switch (message.operation) {
    case antOperation_CreateSharedBuffer:
      createSharedBuffer(static_cast<antEnvCreateSharedBufferMsg&>(message));
      return ANT_SUCCESS;
    case antOperation_DestroySharedBuffer:
      destroySharedBuffer(static_cast<antEnvDestroySharedBufferMsg&>(message));
      return ANT_SUCCESS;
    case antOperation_CreateEndpoint:
      createEndpoint(static_cast<antEnvCreateEndpointMsg&>(message));
      return ANT_SUCCESS;
    case antOperation_TCPClose:
      closeEndpoint(static_cast<TCPEndpointCloseMsg&>(message));
      return ANT_SUCCESS;
    default:
      // The others wait for a client, and the one thread that could bring it would wait here.
      return ANT_FAIL;
  }
}

void IpStack::createSharedBuffer(antEnvCreateSharedBufferMsg& message) {
  void* address = buffers_.create(message.size);
  message.buffer = antSharedBuffer(address);
  message.error = address != nullptr ? ANT_SUCCESS : ANT_FAIL;
}

void IpStack::destroySharedBuffer(antEnvDestroySharedBufferMsg& message) {
  const void* address = message.buffer.GetAddress();
  const auto is_in_it = [&](const void* begin, std::size_t size) {
    return buffers_.containsRange(address, begin, size);
  };
  const bool in_use = std::any_of(endpoints_.begin(), endpoints_.end(),
                                  [&](const auto& endpoint) { return endpoint.second.uses(is_in_it); });
  if (in_use || !buffers_.contains(address)) {
    message.error = ANT_FAIL;
    return;
  }
  buffers_.destroy(address);
  message.error = ANT_SUCCESS;
}

void IpStack::createEndpoint(antEnvCreateEndpointMsg& message) {
  if (message.type != EndpointType_TCP) {
    message.error = ANT_FAIL;
    return;
  }
  endpoints_.try_emplace(++last_endpoint_, message.size, deliver_);
  message.moduleRef = antModuleRef(last_endpoint_);
  message.error = ANT_SUCCESS;
}

Endpoint* IpStack::find(const antModuleRef& module) {
  const auto found = endpoints_.find(module.Id());
  return found == endpoints_.end() ? nullptr : &found->second;
}

template <typename Message>
void IpStack::refuse(const Envelope& message, TCPEndpointError error) {
  message.as<Message>().error = error;
  deliver_(message);
}

void IpStack::listen(const Envelope& message) {
  const auto& request = message.as<TCPEndpointListenMsg>();
  Endpoint* endpoint = find(request.module);
  if (endpoint == nullptr || !endpoint->isNew()) {
    refuse<TCPEndpointListenMsg>(message, TCP_OPERATION_INVALID);
    return;
  }
  if (ports_.count(request.lPort) == 0) {
    try {
      takePort(request.lPort, request.lPort);
    } catch (const std::system_error& error) {
      refuse<TCPEndpointListenMsg>(message, error.code().value() == EADDRINUSE ? TCP_ADDRESSINUSE : TCP_FAIL);
      return;
    }
  }
  ports_.at(request.lPort).waiting.push_back(request.module.Id());
  endpoint->listen(message);
}

void IpStack::sendData(const Envelope& message) {
  const auto& request = message.as<TCPEndpointSendMsg>();
  Endpoint* endpoint = find(request.module);
  if (endpoint == nullptr) {
    refuse<TCPEndpointSendMsg>(message, TCP_OPERATION_INVALID);
  } else if (request.size < 1 || !buffers_.containsRange(request.buffer, static_cast<std::size_t>(request.size))) {
    refuse<TCPEndpointSendMsg>(message, TCP_BUFFER_INVALID);
  } else {
    if (on_send_) {
      on_send_(request.buffer, static_cast<std::size_t>(request.size));
    }
    endpoint->send(message);
  }
}

void IpStack::receiveData(const Envelope& message) {
  const auto& request = message.as<TCPEndpointReceiveMsg>();
  Endpoint* endpoint = find(request.module);
  if (endpoint == nullptr) {
    refuse<TCPEndpointReceiveMsg>(message, TCP_OPERATION_INVALID);
  } else if (request.sizeMin < 1 || request.sizeMax < request.sizeMin ||
             !buffers_.containsRange(request.buffer, static_cast<std::size_t>(request.sizeMax))) {
    refuse<TCPEndpointReceiveMsg>(message, TCP_BUFFER_INVALID);
  } else {
    endpoint->receive(message);
  }
}

void IpStack::closeEndpoint(TCPEndpointCloseMsg& message) {
  Endpoint* endpoint = find(message.module);
  if (endpoint == nullptr) {
    message.error = TCP_OPERATION_INVALID;
    return;
  }
  for (auto& port : ports_) {
    auto& waiting = port.second.waiting;
    waiting.erase(std::remove(waiting.begin(), waiting.end(), message.module.Id()), waiting.end());
  }
  letGo(endpoint->close(), message.abort);
  endpoints_.erase(message.module.Id());
  message.error = TCP_SUCCESS;
}

void IpStack::letGo(FileDescriptor socket, bool abort) {
  if (!socket.isOpen()) {
    return;
  }
  if (abort) {
    const linger reset{1, 0};
    setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &reset, sizeof(reset));
    return;
  }
  // Closed while unread bytes are there or still come, the kernel would reset the connection, and what was sent last
  // would be lost to the client.
  ::shutdown(socket.get(), SHUT_WR);
  if (closing_.size() == kMostClosing) {
    closing_.pop_front();
  }
  closing_.push_back(std::move(socket));
}

void IpStack::acceptOn(TcpPort& port) {
  while (!port.waiting.empty() || !objects_are_busy_()) {
    auto connection = port.listener.accept();
    if (!connection) {
      return;
    }
    if (!port.waiting.empty()) {
      const longword endpoint = port.waiting.front();
      port.waiting.pop_front();
      endpoints_.at(endpoint).accept(std::move(*connection));
    }
    // Else nobody listens, and the client finds its connection closed.
  }
}

void IpStack::addTo(PollSet& poll_set) {
  closing_.erase(std::remove_if(closing_.begin(), closing_.end(), [](const auto& socket) { return !socket.isOpen(); }),
                 closing_.end());
  for (auto& socket : closing_) {
    poll_set.add(socket.get(), POLLIN, [&socket] {
      if (!drain(socket.get())) {
        socket.close();
      }
    });
  }
  for (auto& endpoint : endpoints_) {
    endpoint.second.addTo(poll_set);
  }
  // Last, so that the end of a connection is known before the next client is looked at.
  for (auto& port : ports_) {
    poll_set.add(port.second.listener.fd(), POLLIN, [this, &port] { acceptOn(port.second); });
  }
}

}  // namespace openr_host
