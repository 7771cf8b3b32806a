// The requests of version 2 about motions, and the answers to requests that need the memory stick.
#include <stdio.h>
#include <string.h>

#include "protocol/motion_requests.h"
#include "rcserver/requests/Version2.h"

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
    EndWaitingMotion(order.name, "was stopped before its file had been read");
    Answer(FileOrder::DONE);
  } else if (!IsTooOld(order.not_after) && IsStickFree()) {
    const bool never = order.not_after == NEVER_TOO_OLD;
    play_not_after_ = never ? NEVER_TOO_OLD : notAfter(order.not_after, FILE_READING_FRAMES);
    Answer(motions_.Play(order.name, order.repetitions, LeavesOutMissingJoints(), request_.request_number));
  }
}

template <>
void Version2::CarryOut<REQUEST_LIST>() {
  if (HasNoPayload() && IsStickFree()) {
    Answer(motions_.List());
  }
}

// Ends a `P` whose file is being read. The memory stick stays busy.
// @param name empty for any motion
// @param why follows the name of the motion, as in "NOD.MTN ..."
void Version2::EndWaitingMotion(const protocol::MotionName& name, const char* why) {
  const bool waits = files_.IsPending() && pending_.kind == REQUEST_PLAY;
  if (waits && (name[0] == '\0' || strcmp(name, files_.Name()) == 0)) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "%s %s", files_.Name(), why);
    SendError(pending_.request_number, CODE_REFUSED, text);
    pending_.kind = '\0';
  }
}

void Version2::FileDone(const FileResult& result, unsigned now) {
  now_ = now;
  request_ = pending_;
  if (request_.kind == '\0' || (request_.kind == REQUEST_PLAY && IsTooOld(play_not_after_))) {
    files_.Finish(result);
  } else if (request_.kind == REQUEST_SAVE_PICTURE || request_.kind == REQUEST_PICTURES) {
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
    const MotionChanges changes = {motions_.Changes(), strlen(motions_.Changes())};
    Reply(changes);
  } else {
    Answer(outcome);
  }
}

bool Version2::LeavesOutMissingJoints() const {
  return (request_.id & LEAVE_OUT_MISSING_JOINTS) != 0;
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
