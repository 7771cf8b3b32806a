#include "rcserver/requests/Exchange.h"

#include <stdio.h>
#include <string.h>

using namespace protocol::version2;

Exchange::Exchange(const Settings& settings, OrderBook& orders, Outbox& outbox)
    : settings_(settings), orders_(orders), outbox_(outbox), request_(), payload_(NULL), now_(0) {}

void Exchange::Begin(const FrameHeader& request, const unsigned char* payload, unsigned now) {
  request_ = request;
  payload_ = payload;
  now_ = now;
  PushEnds();
}

bool Exchange::HasNoPayload() {
  NoPayload none;
  return Decode(&none);
}

bool Exchange::IsWellFormed(const char* problem) {
  if (problem != NULL) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "bad request: %.200s", problem);
    Refuse(CODE_REFUSED, text);
  }
  return problem == NULL;
}

bool Exchange::IsAllowed(const char* setting) {
  const bool is_allowed = settings_.Allows(setting);
  if (!is_allowed) {
    char text[MAX_ERROR_TEXT_SIZE];
    if (settings_.fault[0] != '\0') {
      sprintf(text, "this is not allowed, because RCSERVER.CFG on the memory stick is ignored: %s", settings_.fault);
    } else {
      sprintf(text, "this is not allowed; %s=yes in RCSERVER.CFG on the memory stick allows it", setting);
    }
    Refuse(CODE_REFUSED, text);
  }
  return is_allowed;
}

bool Exchange::IsInTime(unsigned not_after) {
  const bool is_too_old = isTooOld(not_after, now_);
  if (is_too_old) {
    Refuse(CODE_TOO_OLD, "too old: the order came after its time; send it again");
  }
  return !is_too_old;
}

void Exchange::FinishReply(size_t payload_size) {
  Send(replyKind(request_.kind), request_.id, request_.request_number, payload_size);
}

void Exchange::Refuse(unsigned short code, const char* text) {
  PushEnds();
  SendError(request_.request_number, code, text);
}

void Exchange::RefuseMissing(const char* part, int identifier) {
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "this robot has no %s %d, so the whole request was refused", part, identifier);
  Refuse(CODE_REFUSED, text);
}

void Exchange::RefuseOther(const FrameHeader& other, const char* text) {
  SendError(other.request_number, CODE_REFUSED, text);
}

void Exchange::PushEnd(unsigned char what, unsigned char how, unsigned short order, const char* name,
                       const char* reason) {
  const EndMessage end = {what, how, order, name, strlen(name), reason, strlen(reason)};
  Push(END_PUSH, end);
}

void Exchange::PushEnds() {
  OrderBook::OrderEnd end;
  while (orders_.Take(&end)) {
    PushEnd(end.what, end.how, end.number, end.name, end.reason);
  }
}

size_t Exchange::Complete(char kind, unsigned char id, unsigned short request_number, size_t payload_size) {
  const FrameHeader header = {kind, id, request_number, static_cast<unsigned>(payload_size)};
  return encode(header, message_) + payload_size;
}

void Exchange::Send(char kind, unsigned char id, unsigned short request_number, size_t payload_size) {
  outbox_.Add(message_, Complete(kind, id, request_number, payload_size));
}

void Exchange::SendError(unsigned short request_number, unsigned short code, const char* text) {
  const ErrorMessage error = {code, text, strlen(text)};
  Send(ERROR_MESSAGE, 0, request_number, encode(error, Payload()));
}
