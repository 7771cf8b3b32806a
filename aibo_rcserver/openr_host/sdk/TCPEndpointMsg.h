/// @file TCPEndpointMsg.h
/// What can be asked of a TCP endpoint.
///
/// An endpoint listens once; the connection that comes then is the endpoint's own. At one time, one send and one
/// receive may be under way. Errors: OPEN-R SDK Internet Protocol Version4.
#ifndef OPENR_TCPENDPOINTMSG_H
#define OPENR_TCPENDPOINTMSG_H

#include <IPAddress.h>
#include <ant.h>

enum TCPEndpointError {
  TCP_SUCCESS = 0,
  TCP_FAIL = 1,                ///< the host could not do it, or it cannot be called, only sent
  TCP_CONNECTION_CLOSED = 2,   ///< the client, or a TCPEndpointCloseMsg, has closed the connection
  TCP_CONNECTION_RESET = 3,    ///< the client has broken the connection off
  TCP_CONNECTION_TIMEOUT = 4,  ///< the client has vanished, or has not read for 2 s
  TCP_CONNECTION_BUSY = 5,     ///< a send (for a send) or a receive (for a receive) is under way
  TCP_ADDRESSINUSE = 6,        ///< another program has the port
  TCP_BUFFER_INVALID = 16,     ///< the data does not lie in a shared buffer, or a size makes no sense
  TCP_OPERATION_INVALID = 17   ///< no such endpoint, or in its state this cannot be asked
};

/// Waits for one client.
class TCPEndpointListenMsg : public antEnvMsg {
 public:
  /// @param address IP_ADDR_ANY; on Linux the machine's bind address decides
  TCPEndpointListenMsg(const antModuleRef& endpoint, IPAddress address, Port port)
      : antEnvMsg(antOperation_TCPListen),
        module(endpoint),
        error(TCP_FAIL),
        lAddress(address),
        lPort(port),
        fAddress(IP_ADDR_ANY),
        fPort(0) {}

  antModuleRef module;
  TCPEndpointError error;
  IPAddress lAddress;
  Port lPort;
  IPAddress fAddress;  ///< answer: the client's
  Port fPort;          ///< answer: the client's
};

/// Sends. Answered when all bytes are in the stack's own memory, or with an error.
class TCPEndpointSendMsg : public antEnvMsg {
 public:
  /// @param data in a shared buffer; must stay as it is until the answer comes
  /// @param bytes at least 1
  TCPEndpointSendMsg(const antModuleRef& endpoint, byte* data, int bytes)
      : antEnvMsg(antOperation_TCPSend), module(endpoint), error(TCP_FAIL), buffer(data), size(bytes) {}

  antModuleRef module;
  TCPEndpointError error;
  byte* buffer;
  int size;
};

/// Receives. Answered as soon as sizeMin bytes are there, or with an error.
class TCPEndpointReceiveMsg : public antEnvMsg {
 public:
  /// @param data in a shared buffer with room for `max` bytes
  /// @param min 1..max
  TCPEndpointReceiveMsg(const antModuleRef& endpoint, byte* data, int min, int max)
      : antEnvMsg(antOperation_TCPReceive),
        module(endpoint),
        error(TCP_FAIL),
        buffer(data),
        sizeMin(min),
        sizeMax(max) {}

  antModuleRef module;
  TCPEndpointError error;
  byte* buffer;
  int sizeMin;  ///< answer: how many bytes there are; with an error, those that came before it
  int sizeMax;
};

/// Closes, whatever the endpoint is doing; a listen, send or receive under way is answered with
/// TCP_CONNECTION_CLOSED first. The endpoint is no more afterwards.
class TCPEndpointCloseMsg : public antEnvMsg {
 public:
  explicit TCPEndpointCloseMsg(const antModuleRef& endpoint)
      : antEnvMsg(antOperation_TCPClose), module(endpoint), error(TCP_FAIL), abort(false) {}

  antModuleRef module;
  TCPEndpointError error;
  bool abort;  ///< true: the client sees a reset; false: it gets what was sent, then the end
};

#endif  // OPENR_TCPENDPOINTMSG_H
