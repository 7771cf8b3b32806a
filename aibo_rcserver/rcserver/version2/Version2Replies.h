/// @file Version2Replies.h
/// How requests of version 2 are answered, and how the server speaks of its own accord.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_REPLIES_H
#define AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_REPLIES_H

#include "protocol/version2.h"
#include "rcserver/Outbox.h"

/// Makes frames of payloads and puts them into the outbox. Pure logic.
class Version2Replies {
 public:
  typedef protocol::version2::FrameHeader Request;

  /// @param outbox must outlive this
  explicit Version2Replies(Outbox& outbox) : outbox_(outbox) {}

  /// Where to put the payload of the next message: room for MAX_PAYLOAD_SIZE bytes.
  unsigned char* Payload() { return message_ + protocol::version2::FRAME_HEADER_SIZE; }

  static const size_t MAX_PAYLOAD_SIZE = Outbox::MAX_REPLY_SIZE - protocol::version2::FRAME_HEADER_SIZE;

  /// Answers a request by the payload in Payload().
  void Reply(const Request& request, size_t payload_size);

  /// Answers a request by an error.
  /// @param text a reason in words
  void Refuse(const Request& request, unsigned short code, const char* text);

  /// Answers a request whose payload is not as it has to be.
  /// @param problem what a decoder of version2.h has said
  void RefuseBadRequest(const Request& request, const char* problem);

  /// @name What nobody has asked for
  /// @{
  /// True if PushError() would find room.
  bool HasRoom() const { return outbox_.HasRoom(); }
  void PushError(unsigned short code, const char* text);

  /// Pushes the payload in Payload(), in the place of telemetry that still waits.
  void PushTelemetry(size_t payload_size);

  /// Telemetry that still waits is not wanted any more.
  void DropTelemetry() { outbox_.DropTelemetry(); }
  /// @}

 private:
  Version2Replies(const Version2Replies&);
  Version2Replies& operator=(const Version2Replies&);

  void AddError(unsigned short request_number, unsigned short code, const char* text);

  Outbox& outbox_;
  unsigned char message_[Outbox::MAX_REPLY_SIZE];  ///< in the making
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_REPLIES_H
