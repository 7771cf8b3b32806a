#ifndef AIBO_RCSERVER_RCSERVER_OUTBOX_H
#define AIBO_RCSERVER_RCSERVER_OUTBOX_H

#include <stddef.h>
#include <string.h>

#include "protocol/color_requests.h"
#include "protocol/hello.h"
#include "protocol/motion_requests.h"
#include "protocol/version2.h"
#include "rcserver/body/Microphone.h"
#include "rcserver/camera/ColorCounter.h"
#include "rcserver/joints/OrderBook.h"
#include "rcserver/requests/FileOrder.h"

/// Messages in order, in a fixed memory. A message that does not fit is dropped.
template <size_t CAPACITY>
class MessageQueue {
 public:
  MessageQueue() : size_(0) {}

  void Add(const unsigned char* message, size_t size) {
    if (size_ + size <= CAPACITY) {
      memcpy(bytes_ + size_, message, size);
      size_ += size;
    }
  }

  /// Adds a message in place of all that wait.
  void Set(const unsigned char* message, size_t size) {
    Drop();
    Add(message, size);
  }

  void Drop() { size_ = 0; }
  const unsigned char* Bytes() const { return bytes_; }
  size_t Size() const { return size_; }

  /// Takes out the first bytes.
  /// @return their number
  size_t Take(size_t size, unsigned char* out) {
    memcpy(out, bytes_, size);
    size_ -= size;
    memmove(bytes_, bytes_ + size, size_);
    return size;
  }

 private:
  unsigned char bytes_[CAPACITY];
  size_t size_;
};

/// The messages that wait to be sent to the client, without pictures and files. It keeps all replies in order, sound
/// while there is room, and only the latest telemetry and colours. Its memory has a fixed size.
class Outbox {
 public:
  /// Bytes of the largest message: a list of motions in version 2. (MAX_MESSAGE_SIZE is a macro of the SDK.)
  static const size_t MAX_REPLY_SIZE = protocol::version2::FRAME_HEADER_SIZE + protocol::version2::MAX_FILE_LIST_SIZE;

  /// Bytes of the messages that may precede a reply: the ends of all orders, and the refusal of a motion whose file is
  /// being read.
  static const size_t MAX_ENDS_SIZE =
      OrderBook::MAX_ENDS *
          (protocol::version2::FRAME_HEADER_SIZE + 4 + protocol::MAX_FILE_NAME_SIZE + 1 + OrderBook::MAX_TEXT_SIZE) +
      protocol::version2::FRAME_HEADER_SIZE + protocol::version2::MAX_ERROR_MESSAGE_SIZE;

  /// Room for a reply and the messages before it.
  static const size_t ROOM = MAX_ENDS_SIZE + MAX_REPLY_SIZE;

  /// Room for messages in order: two such replies, of which one may be reserved, and others.
  static const size_t REPLIES_CAPACITY = 2 * ROOM + MAX_REPLY_SIZE;

  static const size_t MAX_TELEMETRY_SIZE =
      protocol::version2::FRAME_HEADER_SIZE + protocol::version2::MAX_TELEMETRY_SIZE;

  static const size_t MAX_COLORS_SIZE =
      protocol::version2::FRAME_HEADER_SIZE + protocol::version2::MAX_COLOR_REGIONS_SIZE + MAX_PACKED_PLANE_SIZE;

  static const size_t MAX_SOUND_SIZE =
      protocol::version2::FRAME_HEADER_SIZE + protocol::version2::HEARD_SOUND_HEADER_SIZE + 4 * Microphone::MAX_SAMPLES;

  /// Room for sound: half a second of two channels at 16 kHz.
  static const size_t SOUND_CAPACITY = 36 * 1024;

  /// Bytes of sound that are sent at once, unless a single message is larger. Other messages are sent between the
  /// portions.
  static const size_t SOUND_PORTION = 4 * 1024;

  static const size_t CAPACITY =
      REPLIES_CAPACITY + MAX_TELEMETRY_SIZE + MAX_COLORS_SIZE + MAX_SOUND_SIZE + SOUND_PORTION;

  /// @param files room for a reply is reserved while its request is pending
  explicit Outbox(const FileOrder& files) : files_(files) {}

  void Clear();

  /// True if there is ROOM. Ask this before a request is handled, and before anything is pushed: the largest push fits.
  bool HasRoom() const { return replies_.Size() + (files_.IsPending() ? 2 : 1) * ROOM <= REPLIES_CAPACITY; }

  /// Adds a message. Call it only if HasRoom(), or for the reply that room is reserved for.
  void Add(const unsigned char* message, size_t size) { replies_.Add(message, size); }

  MessageQueue<MAX_TELEMETRY_SIZE>& Telemetry() { return telemetry_; }
  MessageQueue<MAX_COLORS_SIZE>& Colors() { return colors_; }
  MessageQueue<SOUND_CAPACITY>& Sound() { return sound_; }
  bool HasSound() const { return sound_.Size() > 0; }
  bool IsEmpty() const { return replies_.Size() + telemetry_.Size() + colors_.Size() + sound_.Size() == 0; }

  /// Takes out all waiting messages, but only one portion of the sound.
  /// @param[out] out room for CAPACITY bytes
  /// @return the number of bytes
  size_t Take(unsigned char* out);

 private:
  size_t SizeOfSoundPortion() const;

  const FileOrder& files_;
  MessageQueue<REPLIES_CAPACITY> replies_;
  MessageQueue<MAX_TELEMETRY_SIZE> telemetry_;
  MessageQueue<MAX_COLORS_SIZE> colors_;
  MessageQueue<SOUND_CAPACITY> sound_;
};

#endif  // AIBO_RCSERVER_RCSERVER_OUTBOX_H
