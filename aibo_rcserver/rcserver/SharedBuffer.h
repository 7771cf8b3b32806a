/// @file SharedBuffer.h
/// Memory that this object shares with the IPStack.
#ifndef AIBO_RCSERVER_RCSERVER_SHARED_BUFFER_H
#define AIBO_RCSERVER_RCSERVER_SHARED_BUFFER_H

#include <OPENR/OPENR.h>
#include <ant.h>

/// The IPStack sends and receives only in such memory (Internet Protocol Version4, "Creating shared memory buffers").
class SharedBuffer {
 public:
  SharedBuffer() : bytes_(NULL) {}

  /// Gets the memory. Call in DoInit.
  /// @return false if the IPStack has no memory for it
  bool Create(const antStackRef& stack, size_t size);

  /// Returns the memory, if there is any. The IPStack refuses while a client is connected. That does no harm, because
  /// the robot is going off.
  void Destroy(const antStackRef& stack);

  /// Null before Create() and after Destroy().
  byte* Bytes() const { return bytes_; }

 private:
  SharedBuffer(const SharedBuffer&);
  SharedBuffer& operator=(const SharedBuffer&);

  antSharedBuffer buffer_;
  byte* bytes_;
};

#endif  // AIBO_RCSERVER_RCSERVER_SHARED_BUFFER_H
