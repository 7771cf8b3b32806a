/// @file ip_stack.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_IP_STACK_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_IP_STACK_H

#include <TCPEndpointMsg.h>
#include <UDPEndpointMsg.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "simulator/openr_host/ip_stack/endpoint.h"
#include "simulator/openr_host/ip_stack/poll_set.h"
#include "simulator/openr_host/ip_stack/shared_buffers.h"
#include "simulator/openr_host/ip_stack/tcp_endpoint.h"
#include "simulator/openr_host/ip_stack/tcp_listener.h"
#include "simulator/openr_host/ip_stack/udp_endpoint.h"

namespace openr_host {

/// The system object IPStack. It answers the messages of ant.h, TCPEndpointMsg.h and UDPEndpointMsg.h by means of this
/// computer's sockets.
class IpStack {
 public:
  /// @param bind_address this computer's IPv4 address for all ports
  /// @param deliver returns answered messages to their objects
  /// @param objects_are_busy true while messages are waiting for objects; meanwhile no client is turned away for lack
  ///   of an endpoint, because an object may be about to listen
  IpStack(std::string bind_address, Deliver deliver, std::function<bool()> objects_are_busy);

  /// Opens a port of this computer for a port of the robot.
  /// @return the computer's port
  /// @throw the exceptions of TcpListener
  std::uint16_t takePort(std::uint16_t robot_port, std::uint16_t host_port);

  /// Carries out antEnvMsg::Call().
  antError call(antEnvMsg& message, std::size_t size);

  /// Carries out antEnvMsg::Send().
  /// @param object, entry the receiver of the answer
  antError send(const antEnvMsg& message, std::size_t size, const OID& object, Selector entry);

  /// Removes closed endpoints, and adds all sockets that wait, with handlers.
  void addTo(PollSet& poll_set);

 private:
  struct TcpPort {
    TcpListener listener;
    std::deque<longword> waiting;  ///< listening endpoints, in the order of their requests
  };

  antError answerAtOnce(antEnvMsg& message);
  void createSharedBuffer(antEnvCreateSharedBufferMsg& message);
  void destroySharedBuffer(antEnvDestroySharedBufferMsg& message);
  void createEndpoint(antEnvCreateEndpointMsg& message);
  antError closeAtOnce(TCPEndpointCloseMsg& message);
  antError answerUdp(UDPEndpointBaseMsg& message);

  void listen(const Envelope& message);
  void forgetListeners();
  template <typename Message, typename Kind>
  void pass(const Envelope& message, void (Kind::*operation)(const Envelope&));
  template <typename Message, typename Kind>
  void passData(const Envelope& message, void (Kind::*operation)(const Envelope&));

  template <typename Kind>
  Kind* find(const antModuleRef& module);
  void acceptOn(TcpPort& port);

  const std::string bind_address_;
  const Deliver deliver_;
  const std::function<bool()> objects_are_busy_;
  SharedBuffers buffers_;
  std::map<longword, std::unique_ptr<Endpoint>> endpoints_;
  longword last_endpoint_ = 0;
  std::map<std::uint16_t, TcpPort> ports_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_IP_STACK_H
