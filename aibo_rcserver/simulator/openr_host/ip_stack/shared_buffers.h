/// @file shared_buffers.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_SHARED_BUFFERS_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_SHARED_BUFFERS_H

#include <cstddef>
#include <map>
#include <memory>

namespace openr_host {

/// Memory shared by objects and the IPStack.
class SharedBuffers {
 public:
  /// @param size the size, which is rounded up to pages of 4096 bytes (OPEN-R SDK Internet Protocol Version4)
  /// @return null if size is 0 or memory is lacking
  void* create(std::size_t size);

  bool contains(const void* address) const { return buffers_.count(address) != 0; }
  /// The size in bytes of the buffer at this address.
  std::size_t sizeOf(const void* address) const { return buffers_.at(address).size; }
  void destroy(const void* address) { buffers_.erase(address); }

  /// True if the range lies in one buffer.
  bool containsRange(const void* begin, std::size_t size) const { return find(begin, size) != buffers_.end(); }

  /// True if the range lies in the buffer at `address`.
  bool containsRange(const void* address, const void* begin, std::size_t size) const;

 private:
  struct Buffer {
    std::unique_ptr<unsigned char[]> memory;
    std::size_t size;
  };
  using Buffers = std::map<const void*, Buffer, std::less<>>;

  Buffers::const_iterator find(const void* begin, std::size_t size) const;

  Buffers buffers_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_SHARED_BUFFERS_H
