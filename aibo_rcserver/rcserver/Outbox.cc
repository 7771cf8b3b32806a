#include "rcserver/Outbox.h"

const size_t Outbox::MAX_REPLY_SIZE;
const size_t Outbox::MAX_TELEMETRY_SIZE;
const size_t Outbox::MAX_COLORS_SIZE;
const size_t Outbox::CAPACITY;

void Outbox::Clear() {
  reserved_ = 0;
  replies_size_ = 0;
  telemetry_.Drop();
  colors_.Drop();
}

void Outbox::Add(const unsigned char* message, size_t size) {
  memcpy(replies_ + replies_size_, message, size);
  replies_size_ += size;
}

size_t Outbox::Take(unsigned char* out) {
  size_t size = replies_size_;
  memcpy(out, replies_, replies_size_);
  replies_size_ = 0;
  size += telemetry_.Take(out + size);
  size += colors_.Take(out + size);
  return size;
}
