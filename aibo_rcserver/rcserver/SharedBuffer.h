#ifndef AIBO_RCSERVER_RCSERVER_SHARED_BUFFER_H
#define AIBO_RCSERVER_RCSERVER_SHARED_BUFFER_H

#include <OPENR/OPENR.h>
#include <ant.h>

/// Memory in which the IPStack can send and receive (Internet Protocol Version4, "Creating shared memory buffers").
class SharedBuffer {
 public:
  SharedBuffer() : bytes_(NULL) {}

  /// Gets the memory. Call this in DoInit.
  /// @return false if the IPStack has no memory for it
  bool Create(const antStackRef& stack, size_t size) {
    antEnvCreateSharedBufferMsg create(static_cast<uint32>(size));
    if (create.Call(stack, sizeof(create)) != ANT_SUCCESS || create.error != ANT_SUCCESS) {
      return false;
    }
    buffer_ = create.buffer;
    if (buffer_.Map() != ANT_SUCCESS) {
      return false;
    }
    bytes_ = static_cast<byte*>(buffer_.GetAddress());
    return true;
  }

  /// Returns the memory, if there is any. While a client is connected, the IPStack refuses. This does no harm, because
  /// the robot is going off.
  void Destroy(const antStackRef& stack) {
    if (bytes_ == NULL) {
      return;
    }
    bytes_ = NULL;
    buffer_.UnMap();
    antEnvDestroySharedBufferMsg destroy(buffer_);
    destroy.Call(stack, sizeof(destroy));
  }

  /// Null before Create() and after Destroy().
  byte* Bytes() const { return bytes_; }

 private:
  SharedBuffer(const SharedBuffer&);
  SharedBuffer& operator=(const SharedBuffer&);

  antSharedBuffer buffer_;
  byte* bytes_;
};

#endif  // AIBO_RCSERVER_RCSERVER_SHARED_BUFFER_H
