// The requests of version 2 that need motion files on the memory stick.
#include <stdio.h>
#include <string.h>

#include "rcserver/Version2.h"

using namespace protocol::version2;

bool Version2::Upload() {
  MotionUpload upload;
  if (!IsWellFormed(decodeMotionUpload(payload_, request_.payload_size, &upload))) {
    return true;
  }
  if (motions_.IsBusy()) {
    return false;
  }
  Answer(motions_.Upload(upload.name, upload.content, upload.content_size, LeavesOutMissingJoints()));
  return true;
}

bool Version2::Delete() {
  protocol::MotionName name;
  if (!IsWellFormed(decodeMotionName(payload_, request_.payload_size, name))) {
    return true;
  }
  if (motions_.IsBusy()) {
    return false;
  }
  Answer(motions_.Delete(name));
  return true;
}

bool Version2::Play() {
  MotionOrder order;
  if (!IsWellFormed(decodeMotionOrder(payload_, request_.payload_size, &order))) {
    return true;
  }
  if (order.repetitions == 0) {
    motions_.Stop(order.name);
    Answer(MotionCommands::DONE);
    return true;
  }
  if (motions_.IsBusy()) {
    return false;
  }
  Answer(motions_.Play(order.name, order.repetitions, LeavesOutMissingJoints()));
  return true;
}

bool Version2::List() {
  if (!IsWellFormed(checkNoPayload(request_.payload_size))) {
    return true;
  }
  if (motions_.IsBusy()) {
    return false;
  }
  Answer(motions_.List());
  return true;
}

void Version2::FileDone(const FileResult& result) {
  request_ = pending_;
  const MotionCommands::Outcome outcome = motions_.Finish(result);
  if (request_.kind == REQUEST_LIST && outcome == MotionCommands::DONE) {
    Reply(encodeMotionList(result.list, Payload()));
  } else if (request_.kind == REQUEST_PLAY && outcome == MotionCommands::DONE) {
    ConfirmPlay();
  } else {
    Answer(outcome);
  }
}

bool Version2::LeavesOutMissingJoints() const {
  return (request_.id & LEAVE_OUT_MISSING_JOINTS) != 0;
}

void Version2::ConfirmPlay() {
  const bool tells = (request_.id & TELL_CHANGES) != 0;
  const MotionChanges changes = {motions_.Changes(), tells ? strlen(motions_.Changes()) : 0};
  Reply(encodeMotionChanges(changes, Payload()));
}

void Version2::Answer(MotionCommands::Outcome outcome) {
  switch (outcome) {
    case MotionCommands::DONE:
      Reply(0);
      break;
    case MotionCommands::PENDING:
      pending_ = request_;
      break;
    case MotionCommands::REFUSED:
      Refuse(CODE_REFUSED, motions_.Problem());
      break;
    case MotionCommands::FILE_MISSING:
      Refuse(CODE_FILE_MISSING, motions_.Problem());
      break;
  }
}

// A failure for which there is no room is pushed the next time.
void Version2::PushMotionFailures() {
  MotionPlayer::Failure failure;
  while (outbox_.HasRoom() && robot_.joints.Motions().TakeFailure(&failure)) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "%s is stopped: %s does not follow. Its joints hold where they are", failure.name,
            robot_.joints.Name(failure.joint));
    SendError(0, CODE_JOINT_FAULT, text);
  }
}
