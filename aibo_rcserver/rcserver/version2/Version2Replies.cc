#include "rcserver/version2/Version2Replies.h"

#include <stdio.h>
#include <string.h>

using namespace protocol::version2;

const size_t Version2Replies::MAX_PAYLOAD_SIZE;

void Version2Replies::Reply(const Request& request, size_t payload_size) {
  const FrameHeader header = {replyKind(request.kind), request.id, request.request_number,
                              static_cast<unsigned>(payload_size)};
  encodeFrameHeader(header, message_);
  outbox_.Add(message_, FRAME_HEADER_SIZE + payload_size);
}

void Version2Replies::Refuse(const Request& request, unsigned short code, const char* text) {
  AddError(request.request_number, code, text);
}

void Version2Replies::RefuseBadRequest(const Request& request, const char* problem) {
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "bad request: %.200s", problem);
  Refuse(request, CODE_REFUSED, text);
}

void Version2Replies::PushError(unsigned short code, const char* text) {
  AddError(0, code, text);
}

void Version2Replies::PushTelemetry(size_t payload_size) {
  const FrameHeader header = {TELEMETRY_PUSH, 0, 0, static_cast<unsigned>(payload_size)};
  encodeFrameHeader(header, message_);
  outbox_.SetTelemetry(message_, FRAME_HEADER_SIZE + payload_size);
}

void Version2Replies::AddError(unsigned short request_number, unsigned short code, const char* text) {
  const ErrorMessage error = {code, text, strlen(text)};
  const size_t size = encodeErrorMessage(error, Payload());
  const FrameHeader header = {ERROR_MESSAGE, 0, request_number, static_cast<unsigned>(size)};
  encodeFrameHeader(header, message_);
  outbox_.Add(message_, FRAME_HEADER_SIZE + size);
}
