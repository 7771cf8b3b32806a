#include "simulator/openr_host/ip_stack/shared_buffers.h"

#include <new>

namespace openr_host {
namespace {

constexpr std::size_t kPage = 4096;

/// The largest size. It is far more than the robot's 64 MB, so a larger size must be a mistake.
constexpr std::size_t kLargest = std::size_t{1} << 30;

}  // namespace

void* SharedBuffers::create(std::size_t size) {
  if (size == 0 || size > kLargest) {
    return nullptr;
  }
  const std::size_t rounded = (size + kPage - 1) / kPage * kPage;
  std::unique_ptr<unsigned char[]> memory(new (std::nothrow) unsigned char[rounded]());
  void* address = memory.get();
  if (address != nullptr) {
    buffers_[address] = {std::move(memory), rounded};
  }
  return address;
}

bool SharedBuffers::containsRange(const void* address, const void* begin, std::size_t size) const {
  const auto found = find(begin, size);
  return found != buffers_.end() && found->first == address;
}

SharedBuffers::Buffers::const_iterator SharedBuffers::find(const void* begin, std::size_t size) const {
  auto after = buffers_.upper_bound(begin);
  if (after == buffers_.begin()) {
    return buffers_.end();
  }
  const auto buffer = std::prev(after);
  const auto offset = static_cast<std::size_t>(static_cast<const unsigned char*>(begin) - buffer->second.memory.get());
  const bool inside = offset <= buffer->second.size && size <= buffer->second.size - offset;
  return inside ? buffer : buffers_.end();
}

}  // namespace openr_host
