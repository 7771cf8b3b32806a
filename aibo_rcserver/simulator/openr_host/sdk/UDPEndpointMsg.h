/// @file UDPEndpointMsg.h
/// Messages to a UDP endpoint (OPEN-R SDK Internet Protocol Version4, chapters 3 and 8). An endpoint must be bound
/// first. It can have one unfinished send and one unfinished receive.
#ifndef OPENR_UDPENDPOINTMSG_H
#define OPENR_UDPENDPOINTMSG_H

#include <IPAddress.h>
#include <ant.h>

enum UDPEndpointError {
  UDP_SUCCESS = 0,
  UDP_FAIL = 1,
  UDP_CONNECTION_CLOSED = 2,  ///< closed by a UDPEndpointCloseMsg
  UDP_CONNECTION_BUSY = 3,    ///< another send (for a send) or receive (for a receive) has not finished
  UDP_ADDRESSINUSE = 4,       ///< another program has the port
  UDP_ADDRESSERROR = 5,       ///< the address is invalid
  UDP_PORT_UNREACHABLE = 6,   ///< no program received an earlier packet
  UDP_PROTOCOL_UNREACHABLE = 7,
  UDP_HOST_UNREACHABLE = 8,
  UDP_NETWORK_UNREACHABLE = 9,
  UDP_MESSAGE_TOO_LONG = 10,  ///< the message is too large for a packet
  UDP_TTL_EXCEEDED = 11,
  UDP_TIME_EXCEEDED = 12,
  UDP_BUFFER_INVALID = 13,     ///< the data is not in a shared buffer, or a size is out of range
  UDP_OPERATION_INVALID = 14,  ///< there is no such endpoint, or its state does not allow it
  UDP_OPERATION_UNKNOWN = 15,
  UDP_WOULDBLOCK = 16
};

class UDPEndpointBaseMsg : public antEnvMsg {
 public:
  antModuleRef module;
  UDPEndpointError error;

 protected:
  UDPEndpointBaseMsg(antOperation asked, const antModuleRef& endpoint)
      : antEnvMsg(asked), module(endpoint), error(UDP_FAIL) {}
};

/// Takes a port. The answer has the address and port.
class UDPEndpointBindMsg : public UDPEndpointBaseMsg {
 public:
  /// @param local IP_ADDR_ANY; on Linux the machine's bind address counts
  /// @param local_port IP_PORT_ANY means any free one from 1024 up; on Linux the machine's ports count
  UDPEndpointBindMsg(const antModuleRef& endpoint, const IPAddress& local, Port local_port)
      : UDPEndpointBaseMsg(antOperation_UDPBind, endpoint), address(local), port(local_port) {}

  IPAddress address;
  Port port;
};

/// Sends a packet. The answer comes when the packet is in the stack's memory, or with an error.
class UDPEndpointSendMsg : public UDPEndpointBaseMsg {
 public:
  /// @param data the bytes, in a shared buffer; must not change until the answer
  /// @param bytes at least 1
  UDPEndpointSendMsg(const antModuleRef& endpoint, const IPAddress& foreign, Port foreign_port, byte* data, int bytes)
      : UDPEndpointBaseMsg(antOperation_UDPSend, endpoint),
        address(foreign),
        port(foreign_port),
        buffer(data),
        size(bytes) {}

  IPAddress address;
  Port port;
  byte* buffer;
  int size;
};

/// Receives a packet. Bytes that do not fit into the buffer are lost.
class UDPEndpointReceiveMsg : public UDPEndpointBaseMsg {
 public:
  /// @param data the place for the bytes, in a shared buffer with room for `bytes`, at least 1
  UDPEndpointReceiveMsg(const antModuleRef& endpoint, byte* data, int bytes)
      : UDPEndpointBaseMsg(antOperation_UDPReceive, endpoint), port(0), buffer(data), size(bytes) {}

  IPAddress address;  ///< in the answer: the address of the sender
  Port port;          ///< in the answer: the port of the sender
  byte* buffer;
  int size;  ///< in the answer: the bytes received
};

/// Closes the endpoint. An unfinished request is first answered with UDP_CONNECTION_CLOSED. After the answer the
/// endpoint no longer exists.
class UDPEndpointCloseMsg : public UDPEndpointBaseMsg {
 public:
  explicit UDPEndpointCloseMsg(const antModuleRef& endpoint) : UDPEndpointBaseMsg(antOperation_UDPClose, endpoint) {}
};

#endif  // OPENR_UDPENDPOINTMSG_H
