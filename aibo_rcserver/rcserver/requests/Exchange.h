#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_EXCHANGE_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_EXCHANGE_H

#include "protocol/version2.h"
#include "rcserver/Outbox.h"
#include "rcserver/joints/OrderBook.h"
#include "rcserver/settings/Settings.h"

/// Decodes the request that is being handled, and writes the answer and pushed messages into the outbox.
class Exchange {
 public:
  Exchange(const Settings& settings, OrderBook& orders, Outbox& outbox);

  /// Begins to handle a request, or to answer one that has waited. Ends that wait are pushed.
  /// @param payload as many bytes as the header says; NULL for a request that has waited
  /// @param now the present OPEN-R frame
  void Begin(const protocol::version2::FrameHeader& request, const unsigned char* payload, unsigned now);

  /// The request that is being handled, or the last one.
  const protocol::version2::FrameHeader& Request() const { return request_; }
  unsigned char Id() const { return request_.id; }
  bool HasPayload() const { return request_.payload_size > 0; }

  /// The OPEN-R frame of the last Begin().
  unsigned Now() const { return now_; }

  /// Gives the answer an id of its own, in place of the request's.
  void AnswerWithId(unsigned char id) { request_.id = id; }

  // Checks. If they return false, they have refused the request.
  template <typename Content>
  bool Decode(Content* content) {
    return IsWellFormed(protocol::version2::decode(payload_, request_.payload_size, content));
  }
  bool HasNoPayload();
  bool IsWellFormed(const char* problem);

  /// @param setting a line of RCSERVER.CFG, or NULL, as in protocol::version2::Request
  bool IsAllowed(const char* setting);

  /// Returns false for an order that has expired.
  bool IsInTime(unsigned not_after);

  // The answer. Each request gets one, after the ends of orders that it has caused.
  template <typename Content>
  void Reply(const Content& content) {
    PushEnds();
    FinishReply(encode(content, Payload()));
  }
  void ReplyWithoutPayload() { Reply(protocol::version2::NoPayload()); }

  /// Answers a request that has caused no ends, with the payload that has been written to Payload().
  void FinishReply(size_t payload_size);

  void Refuse(unsigned short code, const char* text);
  void RefuseMissing(const char* part, int identifier);

  /// Refuses a request that has waited, while another one is being handled.
  void RefuseOther(const protocol::version2::FrameHeader& other, const char* text);

  // Pushed messages. Push them only if there is room; messages that replace older ones always have room.
  bool HasRoom() const { return outbox_.HasRoom(); }

  template <typename Content>
  void Push(char kind, const Content& content, unsigned char id = 0) {
    Send(kind, id, 0, encode(content, Payload()));
  }

  void PushError(unsigned short code, const char* text) { SendError(0, code, text); }
  void PushEnd(unsigned char what, unsigned char how, unsigned short order, const char* name, const char* reason);
  void PushEnds();

  /// The place for the payload of a large message, with room for the largest one in the outbox.
  unsigned char* Payload() { return message_ + protocol::version2::FRAME_HEADER_SIZE; }

  /// Completes the message whose payload has been written to Payload().
  /// @return the size of Message()
  size_t Complete(char kind, unsigned char id, unsigned short request_number, size_t payload_size);
  const unsigned char* Message() const { return message_; }

  Outbox& Out() { return outbox_; }

 private:
  void Send(char kind, unsigned char id, unsigned short request_number, size_t payload_size);
  void SendError(unsigned short request_number, unsigned short code, const char* text);

  const Settings& settings_;
  OrderBook& orders_;
  Outbox& outbox_;
  protocol::version2::FrameHeader request_;
  const unsigned char* payload_;  ///< payload of the request
  unsigned now_;
  unsigned char message_[Outbox::MAX_COLORS_SIZE];  ///< the message that is being written
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_EXCHANGE_H
