#include "rcserver/Outbox.h"

const size_t Outbox::MAX_REPLY_SIZE;
const size_t Outbox::MAX_ENDS_SIZE;
const size_t Outbox::ROOM;
const size_t Outbox::REPLIES_CAPACITY;
const size_t Outbox::MAX_TELEMETRY_SIZE;
const size_t Outbox::MAX_COLORS_SIZE;
const size_t Outbox::MAX_SOUND_SIZE;
const size_t Outbox::SOUND_CAPACITY;
const size_t Outbox::SOUND_PORTION;
const size_t Outbox::CAPACITY;

void Outbox::Clear() {
  replies_.Drop();
  telemetry_.Drop();
  colors_.Drop();
  sound_.Drop();
}

size_t Outbox::Take(unsigned char* out) {
  size_t size = replies_.Take(replies_.Size(), out);
  size += telemetry_.Take(telemetry_.Size(), out + size);
  size += colors_.Take(colors_.Size(), out + size);
  size += sound_.Take(SizeOfSoundPortion(), out + size);
  return size;
}

// The size of the first messages that make up a portion.
size_t Outbox::SizeOfSoundPortion() const {
  size_t portion = 0;
  while (portion < sound_.Size()) {
    const size_t size = protocol::version2::FRAME_HEADER_SIZE +
                        protocol::version2::decodeFrameHeader(sound_.Bytes() + portion).payload_size;
    if (portion > 0 && portion + size > SOUND_PORTION) {
      break;
    }
    portion += size;
  }
  return portion;
}
