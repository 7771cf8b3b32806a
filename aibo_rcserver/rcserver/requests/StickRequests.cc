#include "rcserver/requests/StickRequests.h"

#include <stdio.h>
#include <string.h>

#include "protocol/stick_pictures.h"
#include "rcserver/requests/CameraRequests.h"

using namespace protocol::version2;

namespace {

const protocol::FileName NO_NAME = "";

}  // namespace

StickRequests::StickRequests(MotionPlayer& player, FileOrder& files, ImageObserver& pictures, Exchange& exchange)
    : player_(player),
      files_(files),
      pictures_(pictures),
      exchange_(exchange),
      owes_file_(false),
      pending_(),
      play_not_after_(0) {}

void StickRequests::StoreMotion() {
  MotionUpload upload;
  if (exchange_.Decode(&upload) && IsStickFree()) {
    Answer(files_.StoreMotion(upload.name, upload.content, upload.content_size, LeavesOutMissingJoints()));
  }
}

void StickRequests::DeleteMotion() {
  MotionToDelete motion;
  if (exchange_.Decode(&motion) && IsStickFree()) {
    Answer(files_.Post(FileJob::DELETE, MOTION_FILE, motion.name));
  }
}

void StickRequests::PlayMotion() {
  MotionOrder order;
  if (!exchange_.Decode(&order)) {
    return;
  }
  if (order.repetitions == 0) {
    player_.Stop(order.name);
    if (order.name[0] == '\0' || strcmp(order.name, files_.Name()) == 0) {
      EndWaitingMotion("was stopped before its file had been read");
    }
    Answer(FileOrder::DONE);
  } else if (exchange_.IsInTime(order.not_after) && IsStickFree()) {
    const bool never = order.not_after == NEVER_TOO_OLD;
    play_not_after_ = never ? NEVER_TOO_OLD : notAfter(order.not_after, FILE_READING_FRAMES);
    Answer(
        files_.PlayMotion(order.name, order.repetitions, LeavesOutMissingJoints(), exchange_.Request().request_number));
  }
}

void StickRequests::ListMotions() {
  if (exchange_.HasNoPayload() && IsStickFree()) {
    Answer(files_.Post(FileJob::LIST, MOTION_FILE, NO_NAME));
  }
}

void StickRequests::SavePicture() {
  if (exchange_.HasNoPayload() && IsStickFree()) {
    exchange_.AnswerWithId(CameraRequests::JpegQuality(exchange_.Id()));
    Answer(OrderPicture());
  }
}

void StickRequests::HandlePicture() {
  StickPicture picture;
  switch (exchange_.Id()) {
    case LIST_PICTURES:
      if (exchange_.HasNoPayload() && IsStickFree()) {
        Answer(files_.Post(FileJob::LIST, PICTURE_FILE, NO_NAME));
      }
      break;
    case FETCH_PICTURE:
      if (exchange_.Decode(&picture) && IsStickFree()) {
        Answer(files_.Post(FileJob::READ, PICTURE_FILE, picture.name));
      }
      break;
    case DELETE_PICTURE:
      if (exchange_.Decode(&picture) && exchange_.IsAllowed(DELETE_MOTION.setting) && IsStickFree()) {
        Answer(files_.Post(FileJob::DELETE, PICTURE_FILE, picture.name));
      }
      break;
    default:
      exchange_.Refuse(CODE_REFUSED, "bad request: the id is not one of 1 (list), 2 (fetch) and 3 (delete)");
  }
}

void StickRequests::EndWaitingMotion(const char* why) {
  if (files_.IsPending() && pending_.kind == REQUEST_PLAY) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "%s %s", files_.Name(), why);
    exchange_.RefuseOther(pending_, text);
    pending_.kind = '\0';
  }
}

// A fetched picture is sent later, after EncodeFileHeader().
void StickRequests::FileDone(const FileResult& result, unsigned now) {
  exchange_.Begin(pending_, NULL, now);
  const bool plays = pending_.kind == REQUEST_PLAY;
  if (pending_.kind == '\0' || (plays && !exchange_.IsInTime(play_not_after_))) {
    files_.Drop();
    return;
  }
  const FileOrder::Outcome outcome = files_.Finish(result);
  const bool is_about_pictures = pending_.kind == REQUEST_PICTURES;
  if (outcome != FileOrder::DONE) {
    Answer(outcome);
  } else if (pending_.kind == REQUEST_LIST || (is_about_pictures && pending_.id == LIST_PICTURES)) {
    exchange_.FinishReply(encodeFileList(result.list, exchange_.Payload()));
  } else if (plays) {
    const MotionChanges changes = {player_.Changes(), strlen(player_.Changes())};
    exchange_.Reply(changes);
  } else if (pending_.kind == REQUEST_SAVE_PICTURE) {
    StickPicture picture;
    strcpy(picture.name, result.name);
    exchange_.Reply(picture);
  } else if (is_about_pictures && pending_.id == FETCH_PICTURE && result.size == 0) {
    exchange_.Refuse(CODE_FILE_MISSING, "the file is empty; delete it");
  } else if (is_about_pictures && pending_.id == FETCH_PICTURE) {
    owes_file_ = true;
  } else {
    Answer(FileOrder::DONE);
  }
}

void StickRequests::PictureTaken(const unsigned char* jpeg, size_t size) {
  if (files_.IsPrepared()) {
    exchange_.Begin(pending_, NULL, exchange_.Now());
    Answer(files_.Post(FileJob::STORE, PICTURE_FILE, NO_NAME, jpeg, size));
  }
}

size_t StickRequests::EncodeFileHeader(size_t size, unsigned char* out) {
  owes_file_ = false;
  const FrameHeader header = {replyKind(pending_.kind), pending_.id, pending_.request_number,
                              static_cast<unsigned>(size)};
  return encode(header, out);
}

bool StickRequests::IsStickFree() {
  const bool is_free = !files_.IsPending() && !owes_file_;
  if (!is_free) {
    exchange_.Refuse(CODE_REFUSED, "the memory stick is busy with an earlier request; try again after its answer");
  }
  return is_free;
}

bool StickRequests::LeavesOutMissingJoints() const {
  return (exchange_.Id() & LEAVE_OUT_MISSING_JOINTS) != 0;
}

// Orders a picture, which PictureTaken() stores.
FileOrder::Outcome StickRequests::OrderPicture() {
  const PictureOrder order = {exchange_.Id(), LAYER_HIGH, exchange_.Request().request_number, PictureOrder::FOR_STICK};
  if (files_.Prepare() != FileOrder::PENDING) {
    return FileOrder::REFUSED;
  }
  return pictures_.RequestPicture(order) ? FileOrder::PENDING
                                         : files_.Fail(FileOrder::REFUSED, ImageObserver::TOO_MANY_OWED);
}

void StickRequests::Answer(FileOrder::Outcome outcome) {
  switch (outcome) {
    case FileOrder::DONE:
      exchange_.ReplyWithoutPayload();
      break;
    case FileOrder::PENDING:
      pending_ = exchange_.Request();
      break;
    case FileOrder::REFUSED:
      exchange_.Refuse(CODE_REFUSED, files_.Problem());
      break;
    case FileOrder::FILE_MISSING:
      exchange_.Refuse(CODE_FILE_MISSING, files_.Problem());
      break;
  }
}
