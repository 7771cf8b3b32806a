#include "rcserver/version1/Version1Motions.h"

#include <string.h>

using protocol::FileRequest;
using protocol::MotionName;

Version1Motions::Version1Motions(MotionCommands& motions, Version1Replies& replies, unsigned char* buffer)
    : motions_(motions), replies_(replies), buffer_(buffer), request_() {
  Begin();
}

void Version1Motions::Begin() {
  is_uploading_ = false;
  upload_name_[0] = '\0';
  uploaded_ = 0;
}

bool Version1Motions::Execute(const protocol::Request& request) {
  request_ = request.basic;
  const FileRequest file = protocol::decodeFileRequest(request.payload);
  const bool stops = request_.command == protocol::REQUEST_PLAY_MOTION && file.a == 0;
  MotionName name = "";
  if (!(stops && file.name[0] == '\0') && protocol::readMotionName(file.name, strlen(file.name), name) != NULL) {
    replies_.Refuse(protocol::ERROR_NOT_A_MOTION);
    return true;
  }
  if (!stops && motions_.IsBusy()) {
    return false;
  }
  switch (request_.command) {
    case protocol::REQUEST_UPLOAD_MOTION:
      BeginUpload(name, contentSize(file));
      break;
    case protocol::REQUEST_DELETE_MOTION:
      Answer(motions_.Delete(name));
      break;
    default:
      Play(name, file.a);
      break;
  }
  return true;
}

bool Version1Motions::TakeContent(protocol::RequestReader& reader) {
  if (!is_uploading_) {
    return true;
  }
  uploaded_ += reader.takeContent(buffer_ + uploaded_, mtn::MAX_FILE_SIZE - uploaded_);
  if (reader.contentLeft() > 0) {
    return false;
  }
  is_uploading_ = false;
  Answer(motions_.Upload(upload_name_, buffer_, uploaded_));
  return true;
}

// The content of a refused upload is skipped by the reader.
void Version1Motions::BeginUpload(const MotionName& name, size_t size) {
  const MotionCommands::Outcome outcome = motions_.CheckUpload(size);
  if (outcome != MotionCommands::DONE) {
    Answer(outcome);
    return;
  }
  is_uploading_ = true;
  strcpy(upload_name_, name);
  uploaded_ = 0;
}

void Version1Motions::Play(const MotionName& name, unsigned short repetitions) {
  if (repetitions == 0) {
    motions_.Stop(name);
    Answer(MotionCommands::DONE);
  } else {
    Answer(motions_.Play(name, repetitions));
  }
}

void Version1Motions::Answer(MotionCommands::Outcome outcome) {
  switch (outcome) {
    case MotionCommands::DONE:
      replies_.Answer(request_, 0);
      break;
    case MotionCommands::PENDING:
      break;
    case MotionCommands::REFUSED:
      replies_.Refuse(protocol::ERROR_REFUSED);
      break;
    case MotionCommands::FILE_MISSING:
      replies_.Refuse(protocol::ERROR_FILE_MISSING);
      break;
  }
}
