// The requests of version 2 about motions, and the answers to requests that need the memory stick.
#include <stdio.h>
#include <string.h>

#include "protocol/motion_requests.h"
#include "rcserver/Version2.h"

using namespace protocol::version2;

const protocol::MotionName Version2::ALL_MOTIONS = "";

// Only one request may wait for the memory stick. The others can then be handled at once, above all orders to stop.
bool Version2::IsStickFree() {
  const bool is_free = !files_.IsPending() && !client_.owes_file;
  if (!is_free) {
    Refuse(CODE_REFUSED, "the memory stick is busy with an earlier request; try again after its answer");
  }
  return is_free;
}

template <>
void Version2::CarryOut<REQUEST_UPLOAD>() {
  MotionUpload upload;
  if (Decode(&upload) && IsStickFree()) {
    Answer(motions_.Upload(upload.name, upload.content, upload.content_size, LeavesOutMissingJoints()));
  }
}

template <>
void Version2::CarryOut<REQUEST_DELETE>() {
  MotionToDelete motion;
  if (Decode(&motion) && IsStickFree()) {
    Answer(motions_.Delete(motion.name));
  }
}

template <>
void Version2::CarryOut<REQUEST_PLAY>() {
  MotionOrder order;
  if (!Decode(&order)) {
    return;
  }
  if (order.repetitions == 0) {
    motions_.Stop(order.name);
    Answer(FileOrder::DONE);
    motions_.Cancel(order.name, "was stopped before its file had been read");
  } else if (!IsTooOld() && IsStickFree()) {
    Answer(motions_.Play(order.name, order.repetitions, LeavesOutMissingJoints()));
  }
}

template <>
void Version2::CarryOut<REQUEST_LIST>() {
  if (HasNoPayload() && IsStickFree()) {
    Answer(motions_.List());
  }
}

void Version2::FileDone(const FileResult& result) {
  request_ = pending_;
  if (request_.kind == REQUEST_SAVE_PICTURE || request_.kind == REQUEST_PICTURES) {
    PictureJobDone(result);
  } else {
    MotionJobDone(result);
  }
}

void Version2::MotionJobDone(const FileResult& result) {
  const FileOrder::Outcome outcome = motions_.Finish(result);
  if (request_.kind == REQUEST_LIST && outcome == FileOrder::DONE) {
    FinishReply(encodeFileList(result.list, Payload()));
  } else if (request_.kind == REQUEST_PLAY && outcome == FileOrder::DONE) {
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
  Reply(changes);
}

void Version2::Answer(FileOrder::Outcome outcome) {
  switch (outcome) {
    case FileOrder::DONE:
      Reply(NoPayload());
      break;
    case FileOrder::PENDING:
      pending_ = request_;
      break;
    case FileOrder::REFUSED:
      Refuse(CODE_REFUSED, files_.Problem());
      break;
    case FileOrder::FILE_MISSING:
      Refuse(CODE_FILE_MISSING, files_.Problem());
      break;
  }
}
