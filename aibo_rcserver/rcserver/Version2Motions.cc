// The requests of version 2 that need the memory stick: how they wait, and those about motions.
#include <stdio.h>
#include <string.h>

#include "rcserver/Version2.h"

using namespace protocol::version2;

const protocol::MotionName Version2::ALL_MOTIONS = "";

bool Version2::HandleFileRequest() {
  switch (request_.kind) {
    case REQUEST_UPLOAD:
      return Upload();
    case REQUEST_DELETE:
      return Delete();
    case REQUEST_PLAY:
      return Play();
    case REQUEST_LIST:
      return List();
    case REQUEST_SAVE_PICTURE:
      return SavePicture();
    default:
      return HandlePictures();
  }
}

void Version2::HandleWaiting() {
  if (has_waiting_ && !files_.IsBusy()) {
    has_waiting_ = false;
    request_ = waiting_;
    payload_ = waiting_payload_;
    commands_ = commands_before_waiting_;
    HandleFileRequest();
  }
}

// Requests for the memory stick keep their order.
bool Version2::MustWaitForFiles() const {
  return files_.IsBusy() || has_waiting_;
}

// Only one waits, so that all others can be read and handled, above all those that stop the robot.
void Version2::Wait() {
  if (has_waiting_) {
    Refuse(CODE_REFUSED, "the memory stick is busy and another request waits for it; try again after its answer");
    return;
  }
  has_waiting_ = true;
  waiting_ = request_;
  commands_before_waiting_ = commands_;
  memcpy(waiting_payload_, payload_, request_.payload_size);
}

// The motion will not be played if its file has not been read yet. There is room for this refusal beside a reply
// without a list.
void Version2::CancelPlay(const protocol::MotionName& name, const char* why) {
  motions_.Cancel(name, why);
  MotionOrder order;
  if (has_waiting_ && waiting_.kind == REQUEST_PLAY &&
      decodeMotionOrder(waiting_payload_, waiting_.payload_size, &order) == NULL &&
      (name[0] == '\0' || strcmp(name, order.name) == 0)) {
    has_waiting_ = false;
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "%s %s", order.name, why);
    SendError(waiting_.request_number, CODE_REFUSED, text);
  }
}

bool Version2::Upload() {
  MotionUpload upload;
  if (!IsWellFormed(decodeMotionUpload(payload_, request_.payload_size, &upload))) {
    return true;
  }
  if (MustWaitForFiles()) {
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
  if (MustWaitForFiles()) {
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
    Answer(FileOrder::DONE);
    CancelPlay(order.name, "was stopped before its file had been read");
    return true;
  }
  if (IsTooOld()) {
    return true;
  }
  if (MustWaitForFiles()) {
    return false;
  }
  Answer(motions_.Play(order.name, order.repetitions, LeavesOutMissingJoints(), commands_));
  return true;
}

bool Version2::List() {
  if (!IsWellFormed(checkNoPayload(request_.payload_size))) {
    return true;
  }
  if (MustWaitForFiles()) {
    return false;
  }
  Answer(motions_.List());
  return true;
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
    Reply(encodeMotionList(result.list, Payload()));
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
  Reply(encodeMotionChanges(changes, Payload()));
}

void Version2::Answer(FileOrder::Outcome outcome) {
  switch (outcome) {
    case FileOrder::DONE:
      Reply(0);
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

// An end for which there is no room is pushed the next time.
void Version2::PushMotionEnds() {
  MotionPlayer::End end;
  while (outbox_.HasRoom() && robot_.joints.Motions().TakeEnd(&end)) {
    PushMotionEnd(end);
  }
}

// There is room for both messages.
void Version2::PushMotionEnd(const MotionPlayer::End& end) {
  const char* const joint = end.joint == robot_model::NO_JOINT ? "" : robot_.joints.Name(end.joint);
  char text[MAX_ERROR_TEXT_SIZE];
  switch (end.cause) {
    case MotionPlayer::PLAYED:
      return SendEnd(ENDED_MOTION, END_DONE, end.name, "");
    case MotionPlayer::STOPPED:
      return SendEnd(ENDED_MOTION, END_STOPPED, end.name, "the client stopped it");
    case MotionPlayer::EVERYTHING_HELD:
      return SendEnd(ENDED_MOTION, END_STOPPED, end.name, "everything was told to hold");
    case MotionPlayer::MOTORS_OFF:
      return SendEnd(ENDED_MOTION, END_STOPPED, end.name, "the motors were switched off");
    case MotionPlayer::JOINT_HELD:
      sprintf(text, "%s was told to hold", joint);
      return SendEnd(ENDED_MOTION, END_STOPPED, end.name, text);
    case MotionPlayer::JOINT_COMMANDED:
      sprintf(text, "%s was commanded", joint);
      return SendEnd(ENDED_MOTION, END_REPLACED, end.name, text);
    case MotionPlayer::LEGS_TAKEN:
      return SendEnd(ENDED_MOTION, END_REPLACED, end.name, "the robot was told to walk or to take a posture");
    case MotionPlayer::JOINT_FAILED:
      sprintf(text, "%s is stopped: %s does not follow. Its joints hold where they are", end.name, joint);
      SendError(0, CODE_JOINT_FAULT, text);
      sprintf(text, "%s does not follow", joint);
      return SendEnd(ENDED_MOTION, END_REFUSED, end.name, text);
  }
}
