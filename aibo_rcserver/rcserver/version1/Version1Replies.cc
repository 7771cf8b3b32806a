#include "rcserver/version1/Version1Replies.h"

#include <ctype.h>

void Version1Replies::Answer(const protocol::BasicGetCommand& request, short value) {
  Value(static_cast<char>(tolower(request.command)), request.identifier, value);
}

void Version1Replies::Value(char letter, int identifier, short value) {
  const protocol::ValueReply reply = {letter, static_cast<unsigned char>(identifier), value};
  unsigned char message[protocol::VALUE_REPLY_SIZE];
  protocol::encodeValueReply(reply, message);
  outbox_.Add(message, sizeof(message));
}
