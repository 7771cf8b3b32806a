#include "rcserver/Outbox.h"

#include <string.h>

const size_t Outbox::MAX_REPLY_SIZE;
const size_t Outbox::MAX_TELEMETRY_SIZE;
const size_t Outbox::CAPACITY;

void Outbox::Clear() {
  reserved_ = 0;
  replies_size_ = 0;
  telemetry_size_ = 0;
}

void Outbox::Add(const unsigned char* message, size_t size) {
  memcpy(replies_ + replies_size_, message, size);
  replies_size_ += size;
}

void Outbox::SetTelemetry(const unsigned char* message, size_t size) {
  memcpy(telemetry_, message, size);
  telemetry_size_ = size;
}

size_t Outbox::Take(unsigned char* out) {
  const size_t size = replies_size_ + telemetry_size_;
  memcpy(out, replies_, replies_size_);
  memcpy(out + replies_size_, telemetry_, telemetry_size_);
  replies_size_ = 0;
  telemetry_size_ = 0;
  return size;
}
