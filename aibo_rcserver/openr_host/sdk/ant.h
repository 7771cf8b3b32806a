/// @file ant.h
/// Talking to the IPStack: messages, shared buffers and the making of endpoints.
///
/// A message is made, filled and either called (the answer stands in it when Call() returns) or sent (a copy of it
/// comes back to an `Extra` entry of stub.cfg, with the answer in it). Messages are copied byte by byte.
#ifndef OPENR_ANT_H
#define OPENR_ANT_H

#include <EndpointTypes.h>
#include <OPENR/OPENR.h>

typedef void* ANTENVMSG;  ///< what an `Extra` entry is called with

enum antError {
  ANT_SUCCESS = 0,
  ANT_FAIL = 1  ///< no such stack, object, entry or buffer, a buffer in use, or a message that is of no such use
};

/// Names an endpoint of the IPStack.
class antModuleRef {
 public:
  antModuleRef() : id_(0) {}
  explicit antModuleRef(longword id) : id_(id) {}
  longword Id() const { return id_; }

 private:
  longword id_;  ///< 0 is no endpoint
};

/// Names a network stack; there is only "IPStack".
class antStackRef {
 public:
  antStackRef() : is_ip_stack_(false) {}
  explicit antStackRef(const char* name);
  bool IsIPStack() const { return is_ip_stack_; }

 private:
  bool is_ip_stack_;
};

/// Memory that the object and the IPStack both reach. Whatever is sent or received lies in one.
class antSharedBuffer {
 public:
  antSharedBuffer() : address_(0) {}
  explicit antSharedBuffer(void* address) : address_(address) {}

  /// Must be called before GetAddress() on the robot; on Linux the memory is always there.
  antError Map() const { return address_ != 0 ? ANT_SUCCESS : ANT_FAIL; }
  void* GetAddress() const { return address_; }
  antError UnMap() const { return Map(); }

 private:
  void* address_;
};

/// What a message asks for.
enum antOperation {
  antOperation_CreateSharedBuffer,
  antOperation_DestroySharedBuffer,
  antOperation_CreateEndpoint,
  antOperation_TCPListen,
  antOperation_TCPSend,
  antOperation_TCPReceive,
  antOperation_TCPClose
};

/// Base of all messages.
class antEnvMsg {
 public:
  /// Asks and waits for the answer. For what is answered at once: shared buffers, the making of endpoints, closing.
  /// @param size sizeof the message
  antError Call(const antStackRef& stack, size_t size);

  /// Asks and goes on. Later the object's entry is called with an answered copy of this message.
  /// @param object, entry usually myOID_ and Extra_Entry[entryNAME]
  /// @param size sizeof the message
  antError Send(const antStackRef& stack, OID object, Selector entry, size_t size);

  /// The message in what an `Extra` entry was called with. It is valid until the entry returns.
  static antEnvMsg* Receive(ANTENVMSG msg) { return static_cast<antEnvMsg*>(msg); }

  const antOperation operation;
  void* continuation;  ///< the caller's own; comes back as it was

 protected:
  explicit antEnvMsg(antOperation op) : operation(op), continuation(0) {}
};

/// Asks for a shared buffer.
class antEnvCreateSharedBufferMsg : public antEnvMsg {
 public:
  /// @param bytes rounded up to whole pages of 4096, as on a robot with memory protection
  explicit antEnvCreateSharedBufferMsg(size_t bytes)
      : antEnvMsg(antOperation_CreateSharedBuffer), size(bytes), error(ANT_FAIL) {}

  size_t size;
  antError error;
  antSharedBuffer buffer;  ///< answer
};

/// Gives a shared buffer back. Refused while a send or receive uses it.
class antEnvDestroySharedBufferMsg : public antEnvMsg {
 public:
  explicit antEnvDestroySharedBufferMsg(const antSharedBuffer& shared_buffer)
      : antEnvMsg(antOperation_DestroySharedBuffer), buffer(shared_buffer), error(ANT_FAIL) {}

  antSharedBuffer buffer;
  antError error;
};

/// Asks for an endpoint. One endpoint serves one connection: after it is closed, the next one needs a new endpoint.
class antEnvCreateEndpointMsg : public antEnvMsg {
 public:
  /// @param pool_size bytes the stack may hold for this endpoint; on Linux the size of the socket's send buffer. A
  /// send is complete when all its bytes fit in there, so the smaller it is, the fresher is what a slow reader gets.
  antEnvCreateEndpointMsg(EndpointType endpoint_type, size_t pool_size)
      : antEnvMsg(antOperation_CreateEndpoint), type(endpoint_type), size(pool_size), error(ANT_FAIL) {}

  EndpointType type;
  size_t size;
  antError error;
  antModuleRef moduleRef;  ///< answer
};

#endif  // OPENR_ANT_H
