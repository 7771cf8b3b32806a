#include "rcserver/Outbox.h"

const size_t Outbox::MAX_REPLY_SIZE;
const size_t Outbox::MAX_ENDS_SIZE;
const size_t Outbox::ROOM;
const size_t Outbox::REPLIES_CAPACITY;
const size_t Outbox::MAX_TELEMETRY_SIZE;
const size_t Outbox::MAX_COLORS_SIZE;
const size_t Outbox::MAX_SOUND_SIZE;
const size_t SoundQueue::CAPACITY;
const size_t SoundQueue::PORTION;
const size_t Outbox::CAPACITY;

void Outbox::Clear() {
  reserved_ = 0;
  replies_size_ = 0;
  telemetry_.Drop();
  colors_.Drop();
  sound_.Drop();
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
  size += sound_.Take(out + size);
  return size;
}

void SoundQueue::Add(const unsigned char* message, size_t size) {
  if (size_ + size <= sizeof(bytes_)) {
    memcpy(bytes_ + size_, message, size);
    size_ += size;
  }
}

size_t SoundQueue::Take(unsigned char* out) {
  size_t taken = 0;
  while (taken < size_) {
    const size_t size =
        protocol::version2::FRAME_HEADER_SIZE + protocol::version2::decodeFrameHeader(bytes_ + taken).payload_size;
    if (taken > 0 && taken + size > PORTION) {
      break;
    }
    taken += size;
  }
  memcpy(out, bytes_, taken);
  size_ -= taken;
  memmove(bytes_, bytes_ + taken, size_);
  return taken;
}
