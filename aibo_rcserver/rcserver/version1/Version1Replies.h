/// @file Version1Replies.h
/// How requests of version 1 are answered.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_REPLIES_H
#define AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_REPLIES_H

#include "protocol/version1.h"
#include "rcserver/Outbox.h"

/// Makes messages of answers and puts them into the outbox. Pure logic.
class Version1Replies {
 public:
  /// @param outbox must outlive this
  explicit Version1Replies(Outbox& outbox) : outbox_(outbox) {}

  /// The small letter of the request, its identifier and a value.
  void Answer(const protocol::BasicGetCommand& request, short value);

  void Value(char letter, int identifier, short value);
  void Refuse(protocol::ErrorCode code) { Value(protocol::REPLY_ERROR, 0, static_cast<short>(code)); }

  /// Values without a header.
  /// @param size up to Outbox::MAX_REPLY_SIZE - protocol::VALUE_REPLY_SIZE bytes, so that an answer can follow
  void Block(const unsigned char* values, size_t size) { outbox_.Add(values, size); }

 private:
  Outbox& outbox_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_REPLIES_H
