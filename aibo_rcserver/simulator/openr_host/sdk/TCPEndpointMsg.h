/// @file TCPEndpointMsg.h
/// Messages to a TCP endpoint (OPEN-R SDK Internet Protocol Version4, chapters 2 and 7). An endpoint listens or
/// connects once, and then owns the connection. It can have one unfinished send and one unfinished receive.
#ifndef OPENR_TCPENDPOINTMSG_H
#define OPENR_TCPENDPOINTMSG_H

#include <IPAddress.h>
#include <ant.h>

enum TCPEndpointError {
  TCP_SUCCESS = 0,
  TCP_FAIL = 1,                ///< the host failed, or the message can only be sent, not called
  TCP_CONNECTION_CLOSED = 2,   ///< closed by the other side or by a TCPEndpointCloseMsg
  TCP_CONNECTION_RESET = 3,    ///< reset by the other side
  TCP_CONNECTION_TIMEOUT = 4,  ///< the other side has vanished, or has not read for 2 s
  TCP_CONNECTION_BUSY = 5,     ///< another send (for a send) or receive (for a receive) has not finished
  TCP_ADDRESSINUSE = 6,        ///< another program has the port
  TCP_ADDRESSERROR = 7,        ///< this address is impossible
  TCP_PORT_UNREACHABLE = 8,    ///< no program listens at the port
  TCP_PROTOCOL_UNREACHABLE = 9,
  TCP_HOST_UNREACHABLE = 10,
  TCP_NETWORK_UNREACHABLE = 11,
  TCP_MESSAGE_TOO_LONG = 12,
  TCP_TTL_EXCEEDED = 13,
  TCP_TIME_EXCEEDED = 14,
  TCP_WOULDBLOCK = 15,
  TCP_BUFFER_INVALID = 16,     ///< the data is not in a shared buffer, or a size is out of range
  TCP_OPERATION_INVALID = 17,  ///< there is no such endpoint, or its state does not allow it
  TCP_OPERATION_UNKNOWN = 18
};

class TCPEndpointBaseMsg : public antEnvMsg {
 public:
  antModuleRef module;
  TCPEndpointError error;

 protected:
  TCPEndpointBaseMsg(antOperation asked, const antModuleRef& endpoint)
      : antEnvMsg(asked), module(endpoint), error(TCP_FAIL) {}
};

/// The base of messages that establish a connection. `l` is the local side, `f` the foreign one.
class TCPEndpointAddressesMsg : public TCPEndpointBaseMsg {
 public:
  IPAddress lAddress;
  Port lPort;
  IPAddress fAddress;
  Port fPort;

 protected:
  TCPEndpointAddressesMsg(antOperation asked, const antModuleRef& endpoint, const IPAddress& local, Port local_port,
                          const IPAddress& foreign, Port foreign_port)
      : TCPEndpointBaseMsg(asked, endpoint),
        lAddress(local),
        lPort(local_port),
        fAddress(foreign),
        fPort(foreign_port) {}
};

/// Waits for a client. The answer has the client's address and port (fAddress, fPort) and the local ones.
class TCPEndpointListenMsg : public TCPEndpointAddressesMsg {
 public:
  /// @param address IP_ADDR_ANY; on Linux the machine's bind address counts
  explicit TCPEndpointListenMsg(const antModuleRef& endpoint, const IPAddress& address = IP_ADDR_ANY, Port port = 0,
                                const IPAddress& foreign = IP_ADDR_ANY, Port foreign_port = 0)
      : TCPEndpointAddressesMsg(antOperation_TCPListen, endpoint, address, port, foreign, foreign_port) {}
};

/// Connects to a server. The answer also has the local address and port.
class TCPEndpointConnectMsg : public TCPEndpointAddressesMsg {
 public:
  /// @param address, port must be IP_ADDR_ANY and IP_PORT_ANY
  /// @param foreign, foreign_port the address and port of the server
  TCPEndpointConnectMsg(const antModuleRef& endpoint, const IPAddress& address, Port port, const IPAddress& foreign,
                        Port foreign_port)
      : TCPEndpointAddressesMsg(antOperation_TCPConnect, endpoint, address, port, foreign, foreign_port) {}
};

/// Sends bytes. The answer comes when all of them are in the stack's memory, or with an error.
class TCPEndpointSendMsg : public TCPEndpointBaseMsg {
 public:
  /// @param data the bytes, in a shared buffer; must not change until the answer
  /// @param bytes at least 1
  TCPEndpointSendMsg(const antModuleRef& endpoint, byte* data, int bytes)
      : TCPEndpointBaseMsg(antOperation_TCPSend, endpoint), buffer(data), size(bytes) {}

  byte* buffer;
  int size;
};

/// Receives bytes. The answer comes when sizeMin of them have arrived, or with an error.
class TCPEndpointReceiveMsg : public TCPEndpointBaseMsg {
 public:
  /// @param data the place for the bytes, in a shared buffer with room for `max` of them
  /// @param min 1..max
  TCPEndpointReceiveMsg(const antModuleRef& endpoint, byte* data, int min, int max)
      : TCPEndpointBaseMsg(antOperation_TCPReceive, endpoint), buffer(data), sizeMin(min), sizeMax(max) {}

  byte* buffer;
  int sizeMin;  ///< in the answer: the bytes received, even before an error
  int sizeMax;  ///< in the answer: the same as sizeMin
};

/// Closes the endpoint, whatever it is doing. An unfinished request is first answered with TCP_CONNECTION_CLOSED. After
/// the answer the endpoint no longer exists.
///
/// The answer comes when the connection is fully closed: at once with `abort` or if the other side has closed already;
/// otherwise when the other side closes, which may be never. An object that cannot wait sends a second
/// TCPEndpointCloseMsg with `abort`, which ends the wait. Both messages are then answered.
class TCPEndpointCloseMsg : public TCPEndpointBaseMsg {
 public:
  explicit TCPEndpointCloseMsg(const antModuleRef& endpoint, bool lingers = false, int linger_time = 0,
                               bool aborts = false)
      : TCPEndpointBaseMsg(antOperation_TCPClose, endpoint), abort(aborts), linger(lingers), lingerTime(linger_time) {}

  bool abort;      ///< true: the other side sees a reset; false: it gets everything that was sent, then the end
  bool linger;     ///< no effect on Linux; the SDK does not document it
  int lingerTime;  ///< also no effect on Linux
};

#endif  // OPENR_TCPENDPOINTMSG_H
