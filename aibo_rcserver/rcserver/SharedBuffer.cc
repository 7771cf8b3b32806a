#include "rcserver/SharedBuffer.h"

bool SharedBuffer::Create(const antStackRef& stack, size_t size) {
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

void SharedBuffer::Destroy(const antStackRef& stack) {
  if (bytes_ == NULL) {
    return;
  }
  bytes_ = NULL;
  buffer_.UnMap();
  antEnvDestroySharedBufferMsg destroy(buffer_);
  destroy.Call(stack, sizeof(destroy));
}
