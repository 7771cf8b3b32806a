/// @file ant.h
/// Communication with the IPStack: messages, shared buffers and the creation of endpoints.
///
/// An object creates and fills a message, and then either calls the stack with it (when Call() returns, the message
/// contains the answer) or sends it (a copy with the answer comes back to an `Extra` entry of stub.cfg). Messages are
/// copied byte by byte.
#ifndef OPENR_ANT_H
#define OPENR_ANT_H

#include <antTypes.h>

typedef void* ANTENVMSG;  ///< argument of an `Extra` entry

/// Identifies an endpoint of the IPStack.
class antModuleRef {
 public:
  antModuleRef() : id_(0) {}
  explicit antModuleRef(longword id) : id_(id) {}
  longword Id() const { return id_; }
  bool operator==(const antModuleRef& other) const { return id_ == other.id_; }

 private:
  longword id_;  ///< 0 means no endpoint
};

/// Identifies a network stack; "IPStack" is the only one.
class antStackRef {
 public:
  antStackRef() : is_ip_stack_(false) {}
  explicit antStackRef(const char* name);
  bool IsIPStack() const { return is_ip_stack_; }

 private:
  bool is_ip_stack_;
};

/// Memory shared by an object and the IPStack. All data that is sent or received must be in such a buffer.
class antSharedBuffer {
 public:
  antSharedBuffer() : address_(0), size_(0) {}
  antSharedBuffer(void* address, uint32 size) : address_(address), size_(size) {}

  /// On the robot, must be called before GetAddress(); on Linux, the memory is always mapped.
  antError Map() const { return address_ != 0 ? ANT_SUCCESS : ANT_FAIL; }
  void* GetAddress() const { return address_; }
  /// In bytes; a multiple of the page size.
  uint32 GetSize() const { return size_; }
  antError UnMap() const { return Map(); }

 private:
  void* address_;
  uint32 size_;
};

/// The request of a message.
enum antOperation {
  antOperation_CreateSharedBuffer,
  antOperation_DestroySharedBuffer,
  antOperation_CreateEndpoint,
  antOperation_TCPListen,
  antOperation_TCPConnect,
  antOperation_TCPSend,
  antOperation_TCPReceive,
  antOperation_TCPClose,
  antOperation_UDPBind,
  antOperation_UDPConnect,
  antOperation_UDPSend,
  antOperation_UDPReceive,
  antOperation_UDPClose
};

/// Base of all messages.
class antEnvMsg {
 public:
  /// Asks and waits for the answer. Only for requests that are answered at once: those for shared buffers, for creating
  /// endpoints, for binding and connecting UDP endpoints, and to close without waiting for the other side.
  /// @param size sizeof the message, or more
  antError Call(const antStackRef& stack, size_t size);

  /// Asks and returns. Later the object's entry is called with an answered copy of this message.
  /// @param object, entry usually myOID_ and Extra_Entry[entryNAME]
  /// @param size sizeof the message, or more
  antError Send(const antStackRef& stack, const OID& object, Selector entry, size_t size);

  /// The message in the argument of an `Extra` entry; valid until the entry returns.
  static antEnvMsg* Receive(ANTENVMSG msg) { return static_cast<antEnvMsg*>(msg); }

  const antOperation operation;
  void* continuation;  ///< for the caller's use; comes back unchanged

 protected:
  explicit antEnvMsg(antOperation op) : operation(op), continuation(0) {}
};

/// Asks for a shared buffer.
class antEnvCreateSharedBufferMsg : public antEnvMsg {
 public:
  /// @param bytes rounded up to whole pages of 4096, as on a robot with memory protection
  explicit antEnvCreateSharedBufferMsg(uint32 bytes)
      : antEnvMsg(antOperation_CreateSharedBuffer), size(bytes), error(ANT_FAIL) {}

  uint32 size;
  antError error;
  antSharedBuffer buffer;  ///< answer
};

/// Frees a shared buffer. Refused while a send or receive uses it.
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
  /// @param endpoint_type one of EndpointTypes.h
  /// @param pool_size bytes that the stack may hold for this endpoint. It should be slightly larger than the largest
  /// packet that is sent: 10 KB for packets of 8 KB (OPEN-R SDK Internet Protocol Version4, page 50). On Linux it is
  /// the size of the socket's send buffer, and larger packets are sent in parts. Its effect on the robot is not
  /// documented.
  explicit antEnvCreateEndpointMsg(int32 endpoint_type, int32 pool_size = 0)
      : antEnvMsg(antOperation_CreateEndpoint), protocol(endpoint_type), poolSize(pool_size), error(ANT_FAIL) {}

  int32 protocol;
  int32 poolSize;
  antError error;
  antModuleRef moduleRef;  ///< answer
};

#endif  // OPENR_ANT_H
