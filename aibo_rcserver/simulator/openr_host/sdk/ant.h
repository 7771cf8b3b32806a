/// @file ant.h
/// Communication with the IPStack: messages, shared buffers and endpoints.
///
/// An object fills in a message, and then calls the stack or sends the message. When Call() returns, the message has
/// the answer. After Send(), a copy with the answer comes to an `Extra` entry of stub.cfg. Messages are copied byte by
/// byte.
#ifndef OPENR_ANT_H
#define OPENR_ANT_H

#include <antTypes.h>

typedef void* ANTENVMSG;  ///< the argument of an `Extra` entry

class antModuleRef {
 public:
  antModuleRef() : id_(0) {}
  explicit antModuleRef(longword id) : id_(id) {}
  longword Id() const { return id_; }
  bool operator==(const antModuleRef& other) const { return id_ == other.id_; }

 private:
  longword id_;  ///< 0 means no endpoint
};

/// "IPStack" is the only network stack.
class antStackRef {
 public:
  antStackRef() : is_ip_stack_(false) {}
  explicit antStackRef(const char* name);
  bool IsIPStack() const { return is_ip_stack_; }

 private:
  bool is_ip_stack_;
};

/// Memory shared by an object and the IPStack. All data that is sent or received must be in it.
class antSharedBuffer {
 public:
  antSharedBuffer() : address_(0), size_(0) {}
  antSharedBuffer(void* address, uint32 size) : address_(address), size_(size) {}

  /// On the robot this must precede GetAddress(). On Linux the memory is always mapped.
  antError Map() const { return address_ != 0 ? ANT_SUCCESS : ANT_FAIL; }
  void* GetAddress() const { return address_; }
  /// The size in bytes, a multiple of the page size.
  uint32 GetSize() const { return size_; }
  antError UnMap() const { return Map(); }

 private:
  void* address_;
  uint32 size_;
};

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
  antOperation_UDPSend,
  antOperation_UDPReceive,
  antOperation_UDPClose
};

class antEnvMsg {
 public:
  /// Asks and waits for the answer. This is only for requests that are answered at once: shared buffers, creating
  /// endpoints, binding UDP endpoints, and closing without waiting for the other side.
  /// @param size the size of the message, or more
  antError Call(const antStackRef& stack, size_t size);

  /// Sends a request and returns. Later the object's entry gets a copy with the answer.
  /// @param object, entry the receiver of the answer, usually myOID_ and Extra_Entry[entryNAME]
  /// @param size the size of the message, or more
  antError Send(const antStackRef& stack, const OID& object, Selector entry, size_t size);

  /// Returns the message with the answer. It is valid until the `Extra` entry returns.
  static antEnvMsg* Receive(ANTENVMSG msg) { return static_cast<antEnvMsg*>(msg); }

  const antOperation operation;
  void* continuation;  ///< for the caller's use; returned unchanged

 protected:
  explicit antEnvMsg(antOperation op) : operation(op), continuation(0) {}
};

class antEnvCreateSharedBufferMsg : public antEnvMsg {
 public:
  /// @param bytes the size, which is rounded up to pages of 4096, as on a robot with memory protection
  explicit antEnvCreateSharedBufferMsg(uint32 bytes)
      : antEnvMsg(antOperation_CreateSharedBuffer), size(bytes), error(ANT_FAIL) {}

  uint32 size;
  antError error;
  antSharedBuffer buffer;  ///< in the answer
};

/// Frees a shared buffer. The IPStack refuses this while a send or receive uses the buffer.
class antEnvDestroySharedBufferMsg : public antEnvMsg {
 public:
  explicit antEnvDestroySharedBufferMsg(const antSharedBuffer& shared_buffer)
      : antEnvMsg(antOperation_DestroySharedBuffer), buffer(shared_buffer), error(ANT_FAIL) {}

  antSharedBuffer buffer;
  antError error;
};

/// Creates an endpoint, which serves a single connection.
class antEnvCreateEndpointMsg : public antEnvMsg {
 public:
  /// @param endpoint_type see EndpointTypes.h
  /// @param pool_size bytes that the stack may hold for this endpoint: slightly more than the largest packet sent, 10
  ///   KB for 8 KB (OPEN-R SDK Internet Protocol Version4, page 50). On Linux it is the size of the socket's send
  ///   buffer, and larger packets are sent in parts. What it does on the robot is undocumented
  explicit antEnvCreateEndpointMsg(int32 endpoint_type, int32 pool_size = 0)
      : antEnvMsg(antOperation_CreateEndpoint), protocol(endpoint_type), poolSize(pool_size), error(ANT_FAIL) {}

  int32 protocol;
  int32 poolSize;
  antError error;
  antModuleRef moduleRef;  ///< in the answer
};

#endif  // OPENR_ANT_H
