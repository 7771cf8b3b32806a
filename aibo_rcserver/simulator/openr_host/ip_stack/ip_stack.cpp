#include "simulator/openr_host/ip_stack/ip_stack.h"

#include <EndpointTypes.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace openr_host {
namespace {

const std::map<antOperation, std::size_t> kSizes = {
    {antOperation_CreateSharedBuffer, sizeof(antEnvCreateSharedBufferMsg)},
    {antOperation_DestroySharedBuffer, sizeof(antEnvDestroySharedBufferMsg)},
    {antOperation_CreateEndpoint, sizeof(antEnvCreateEndpointMsg)},
    {antOperation_TCPListen, sizeof(TCPEndpointListenMsg)},
    {antOperation_TCPConnect, sizeof(TCPEndpointConnectMsg)},
    {antOperation_TCPSend, sizeof(TCPEndpointSendMsg)},
    {antOperation_TCPReceive, sizeof(TCPEndpointReceiveMsg)},
    {antOperation_TCPClose, sizeof(TCPEndpointCloseMsg)},
    {antOperation_UDPBind, sizeof(UDPEndpointBindMsg)},
    {antOperation_UDPSend, sizeof(UDPEndpointSendMsg)},
    {antOperation_UDPReceive, sizeof(UDPEndpointReceiveMsg)},
    {antOperation_UDPClose, sizeof(UDPEndpointCloseMsg)},
};

/// The size of an operation's message; 0 if there is no such operation.
std::size_t sizeOf(antOperation operation) {
  const auto found = kSizes.find(operation);
  return found == kSizes.end() ? 0 : found->second;
}

bool hasBuffer(const SharedBuffers& buffers, const TCPEndpointReceiveMsg& message) {
  return message.sizeMin >= 1 && message.sizeMax >= message.sizeMin &&
         buffers.containsRange(message.buffer, static_cast<std::size_t>(message.sizeMax));
}

template <typename Message>
bool hasBuffer(const SharedBuffers& buffers, const Message& message) {
  return message.size >= 1 && buffers.containsRange(message.buffer, static_cast<std::size_t>(message.size));
}

}  // namespace

IpStack::IpStack(std::string bind_address, Deliver deliver, std::function<bool()> objects_are_busy)
    : bind_address_(std::move(bind_address)),
      deliver_(std::move(deliver)),
      objects_are_busy_(std::move(objects_are_busy)) {}

std::uint16_t IpStack::takePort(std::uint16_t robot_port, std::uint16_t host_port) {
  const auto taken = ports_.emplace(robot_port, TcpPort{TcpListener(bind_address_, host_port), {}}).first;
  return taken->second.listener.port();
}

antError IpStack::call(antEnvMsg& message, std::size_t size) {
  return size >= sizeOf(message.operation) ? answerAtOnce(message) : ANT_FAIL;
}

antError IpStack::send(const antEnvMsg& asked, std::size_t size, const OID& object, Selector entry) {
  if (size < sizeOf(asked.operation)) {
    return ANT_FAIL;
  }
  const Envelope message(asked, sizeOf(asked.operation), object, entry);
  switch (asked.operation) {
    case antOperation_TCPListen:
      listen(message);
      break;
    case antOperation_TCPConnect:
      pass<TCPEndpointConnectMsg>(message, &TcpEndpoint::connect);
      break;
    case antOperation_TCPSend:
      passData<TCPEndpointSendMsg>(message, &TcpEndpoint::send);
      break;
    case antOperation_TCPReceive:
      passData<TCPEndpointReceiveMsg>(message, &TcpEndpoint::receive);
      break;
    case antOperation_TCPClose:
      pass<TCPEndpointCloseMsg>(message, &TcpEndpoint::close);
      forgetListeners();
      break;
    case antOperation_UDPSend:
      passData<UDPEndpointSendMsg>(message, &UdpEndpoint::send);
      break;
    case antOperation_UDPReceive:
      passData<UDPEndpointReceiveMsg>(message, &UdpEndpoint::receive);
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
      return closeAtOnce(static_cast<TCPEndpointCloseMsg&>(message));
    case antOperation_UDPBind:
    case antOperation_UDPClose:
      return answerUdp(static_cast<UDPEndpointBaseMsg&>(message));
    default:
      // All other requests wait for the other side, and would block the only thread.
      return ANT_FAIL;
  }
}

antError IpStack::closeAtOnce(TCPEndpointCloseMsg& message) {
  auto* endpoint = find<TcpEndpoint>(message.module);
  if (endpoint == nullptr) {
    message.error = TCP_OPERATION_INVALID;
    return ANT_SUCCESS;
  }
  if (!endpoint->closesAtOnce(message.abort)) {
    return ANT_FAIL;
  }
  endpoint->closeAtOnce(message.abort);
  forgetListeners();
  message.error = TCP_SUCCESS;
  return ANT_SUCCESS;
}

antError IpStack::answerUdp(UDPEndpointBaseMsg& message) {
  auto* endpoint = find<UdpEndpoint>(message.module);
  if (endpoint == nullptr) {
    message.error = UDP_OPERATION_INVALID;
  } else if (message.operation == antOperation_UDPBind) {
    auto& bind = static_cast<UDPEndpointBindMsg&>(message);
    const auto taken = ports_.find(bind.port);
    endpoint->bind(bind, bind_address_, taken == ports_.end() ? bind.port : taken->second.listener.port());
  } else {
    endpoint->close(static_cast<UDPEndpointCloseMsg&>(message));
  }
  return ANT_SUCCESS;
}

void IpStack::createSharedBuffer(antEnvCreateSharedBufferMsg& message) {
  void* address = buffers_.create(message.size);
  message.buffer =
      address != nullptr ? antSharedBuffer(address, static_cast<uint32>(buffers_.sizeOf(address))) : antSharedBuffer();
  message.error = address != nullptr ? ANT_SUCCESS : ANT_FAIL;
}

void IpStack::destroySharedBuffer(antEnvDestroySharedBufferMsg& message) {
  const void* address = message.buffer.GetAddress();
  const auto is_in_it = [&](const void* begin, std::size_t size) {
    return buffers_.containsRange(address, begin, size);
  };
  const bool in_use = std::any_of(endpoints_.begin(), endpoints_.end(),
                                  [&](const auto& endpoint) { return endpoint.second->uses(is_in_it); });
  if (in_use || !buffers_.contains(address)) {
    message.error = ANT_FAIL;
    return;
  }
  buffers_.destroy(address);
  message.error = ANT_SUCCESS;
}

void IpStack::createEndpoint(antEnvCreateEndpointMsg& message) {
  std::unique_ptr<Endpoint> endpoint;
  if (message.protocol == EndpointType_TCP) {
    endpoint = std::make_unique<TcpEndpoint>(message.poolSize, deliver_);
  } else if (message.protocol == EndpointType_UDP) {
    endpoint = std::make_unique<UdpEndpoint>(message.poolSize, deliver_);
  } else {
    message.error = ANT_FAIL;
    return;
  }
  endpoints_[++last_endpoint_] = std::move(endpoint);
  message.moduleRef = antModuleRef(last_endpoint_);
  message.error = ANT_SUCCESS;
}

template <typename Kind>
Kind* IpStack::find(const antModuleRef& module) {
  const auto found = endpoints_.find(module.Id());
  return found == endpoints_.end() || found->second->isClosed() ? nullptr : dynamic_cast<Kind*>(found->second.get());
}

template <typename Message, typename Kind>
void IpStack::pass(const Envelope& message, void (Kind::*operation)(const Envelope&)) {
  if (Kind* endpoint = find<Kind>(message.as<Message>().module)) {
    (endpoint->*operation)(message);
  } else {
    answer<Message>(deliver_, message, Kind::kOperationInvalid);
  }
}

template <typename Message, typename Kind>
void IpStack::passData(const Envelope& message, void (Kind::*operation)(const Envelope&)) {
  const auto& request = message.as<Message>();
  if (!hasBuffer(buffers_, request)) {
    answer<Message>(deliver_, message, Kind::kBufferInvalid);
  } else {
    pass<Message>(message, operation);
  }
}

void IpStack::listen(const Envelope& message) {
  const auto& request = message.as<TCPEndpointListenMsg>();
  auto* endpoint = find<TcpEndpoint>(request.module);
  if (endpoint == nullptr || !endpoint->isNew()) {
    answer<TCPEndpointListenMsg>(deliver_, message, TCP_OPERATION_INVALID);
    return;
  }
  if (ports_.count(request.lPort) == 0) {
    try {
      takePort(request.lPort, request.lPort);
    } catch (const std::system_error& error) {
      answer<TCPEndpointListenMsg>(deliver_, message, error.code().value() == EADDRINUSE ? TCP_ADDRESSINUSE : TCP_FAIL);
      return;
    }
  }
  ports_.at(request.lPort).waiting.push_back(request.module.Id());
  endpoint->listen(message);
}

void IpStack::forgetListeners() {
  for (auto& port : ports_) {
    auto& waiting = port.second.waiting;
    const auto has_gone = [this](longword id) { return find<TcpEndpoint>(antModuleRef(id)) == nullptr; };
    waiting.erase(std::remove_if(waiting.begin(), waiting.end(), has_gone), waiting.end());
  }
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
      find<TcpEndpoint>(antModuleRef(endpoint))->accept(std::move(*connection));
    }
    // If no endpoint is listening, the client's connection is closed.
  }
}

void IpStack::addTo(PollSet& poll_set) {
  for (auto endpoint = endpoints_.begin(); endpoint != endpoints_.end();) {
    if (endpoint->second->isClosed()) {
      endpoint = endpoints_.erase(endpoint);
    } else {
      endpoint->second->addTo(poll_set);
      ++endpoint;
    }
  }
  // Ports come last, so that the end of a connection is handled before the next client.
  for (auto& port : ports_) {
    poll_set.add(port.second.listener.fd(), POLLIN, [this, &port] { acceptOn(port.second); });
  }
}

}  // namespace openr_host
