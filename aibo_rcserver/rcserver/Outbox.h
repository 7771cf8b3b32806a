/// @file Outbox.h
/// What waits to be sent to the client, pictures apart.
#ifndef AIBO_RCSERVER_RCSERVER_OUTBOX_H
#define AIBO_RCSERVER_RCSERVER_OUTBOX_H

#include <stddef.h>

#include "protocol/hello.h"
#include "protocol/motion_requests.h"
#include "protocol/version2.h"

/// Keeps replies in order, and of the telemetry only the latest. Memory of a fixed size; pure logic.
class Outbox {
 public:
  /// Bytes of the largest message: a list of motions in version 2. (MAX_MESSAGE_SIZE is a macro of the SDK.)
  static const size_t MAX_REPLY_SIZE = protocol::version2::FRAME_HEADER_SIZE + protocol::version2::MAX_MOTION_LIST_SIZE;

  /// Bytes of the largest telemetry message.
  static const size_t MAX_TELEMETRY_SIZE =
      protocol::version2::FRAME_HEADER_SIZE + protocol::version2::MAX_TELEMETRY_SIZE;

  /// Most bytes that can wait in all.
  static const size_t CAPACITY = 4 * MAX_REPLY_SIZE + MAX_TELEMETRY_SIZE;

  Outbox() : replies_size_(0), reserved_(0), telemetry_size_(0) {}

  void Clear();

  /// True if one more message of MAX_REPLY_SIZE can wait. To be asked before a request is handled.
  bool HasRoom() const { return replies_size_ + reserved_ + MAX_REPLY_SIZE <= sizeof(replies_); }

  /// Keeps room for one message that comes later, or gives it up.
  /// @param reserved true only if there is room that has been kept already, or HasRoom()
  void Reserve(bool reserved) { reserved_ = reserved ? MAX_REPLY_SIZE : 0; }

  /// Adds a message; only if HasRoom(), or if it is the one that room was kept for.
  void Add(const unsigned char* message, size_t size);

  /// Takes the place of telemetry that still waits.
  void SetTelemetry(const unsigned char* message, size_t size);

  /// Telemetry that still waits is not wanted any more.
  void DropTelemetry() { telemetry_size_ = 0; }

  bool IsEmpty() const { return replies_size_ == 0 && telemetry_size_ == 0; }

  /// Takes out all that waits. Room that is kept stays so.
  /// @param[out] out room for CAPACITY bytes
  /// @return how many bytes there were
  size_t Take(unsigned char* out);

 private:
  unsigned char replies_[CAPACITY - MAX_TELEMETRY_SIZE];
  size_t replies_size_;
  size_t reserved_;
  unsigned char telemetry_[MAX_TELEMETRY_SIZE];
  size_t telemetry_size_;
};

#endif  // AIBO_RCSERVER_RCSERVER_OUTBOX_H
