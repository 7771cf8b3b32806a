#include "rcserver/version2/Version2Motions.h"

#include <stdio.h>

using namespace protocol::version2;
using protocol::MotionName;

bool Version2Motions::Upload(const Request& request, const unsigned char* payload) {
  MotionUpload upload;
  if (const char* problem = decodeMotionUpload(payload, request.payload_size, &upload)) {
    replies_.RefuseBadRequest(request, problem);
    return true;
  }
  if (motions_.IsBusy()) {
    return false;
  }
  Answer(request, motions_.Upload(upload.name, upload.content, upload.content_size));
  return true;
}

bool Version2Motions::Delete(const Request& request, const unsigned char* payload) {
  MotionName name;
  if (const char* problem = decodeMotionName(payload, request.payload_size, name)) {
    replies_.RefuseBadRequest(request, problem);
    return true;
  }
  if (motions_.IsBusy()) {
    return false;
  }
  Answer(request, motions_.Delete(name));
  return true;
}

bool Version2Motions::Play(const Request& request, const unsigned char* payload) {
  MotionOrder order;
  if (const char* problem = decodeMotionOrder(payload, request.payload_size, &order)) {
    replies_.RefuseBadRequest(request, problem);
    return true;
  }
  if (order.repetitions == 0) {
    motions_.Stop(order.name);
    Answer(request, MotionCommands::DONE);
    return true;
  }
  if (motions_.IsBusy()) {
    return false;
  }
  Answer(request, motions_.Play(order.name, order.repetitions));
  return true;
}

bool Version2Motions::List(const Request& request) {
  if (const char* problem = checkNoPayload(request.payload_size)) {
    replies_.RefuseBadRequest(request, problem);
    return true;
  }
  if (motions_.IsBusy()) {
    return false;
  }
  Answer(request, motions_.List());
  return true;
}

void Version2Motions::FileDone(const FileResult& result) {
  const MotionCommands::Outcome outcome = motions_.Finish(result);
  if (pending_.kind == REQUEST_LIST && outcome == MotionCommands::DONE) {
    replies_.Reply(pending_, encodeMotionList(result.list, replies_.Payload()));
  } else {
    Answer(pending_, outcome);
  }
}

// A failure that finds no room is pushed the next time.
void Version2Motions::PushFailures() {
  MotionPlayer::Failure failure;
  while (replies_.HasRoom() && joints_.Motions().TakeFailure(&failure)) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "%s is stopped: %s does not follow. Its joints hold where they are", failure.name,
            joints_.Name(failure.joint));
    replies_.PushError(CODE_JOINT_FAULT, text);
  }
}

void Version2Motions::Answer(const Request& request, MotionCommands::Outcome outcome) {
  switch (outcome) {
    case MotionCommands::DONE:
      replies_.Reply(request, 0);
      break;
    case MotionCommands::PENDING:
      pending_ = request;
      break;
    case MotionCommands::REFUSED:
      replies_.Refuse(request, CODE_REFUSED, motions_.Problem());
      break;
    case MotionCommands::FILE_MISSING:
      replies_.Refuse(request, CODE_FILE_MISSING, motions_.Problem());
      break;
  }
}
