// The requests of version 2 about pictures on the memory stick.
#include <string.h>

#include "protocol/motion_requests.h"
#include "protocol/stick_pictures.h"
#include "rcserver/requests/Version2.h"

using namespace protocol::version2;

namespace {

const protocol::PictureName NO_NAME = "";

}  // namespace

template <>
void Version2::CarryOut<REQUEST_SAVE_PICTURE>() {
  if (HasNoPayload() && IsStickFree()) {
    request_.id = JpegQuality(request_.id);  // the reply contains the quality in use
    Answer(OrderPicture());
  }
}

// PictureTaken() stores it.
FileOrder::Outcome Version2::OrderPicture() {
  const PictureOrder order = {request_.id, LAYER_HIGH, request_.request_number, false, true};
  if (files_.Prepare() != FileOrder::PENDING) {
    return FileOrder::REFUSED;
  }
  return camera_.RequestPicture(order) ? FileOrder::PENDING : files_.Fail(FileOrder::REFUSED, TOO_MANY_OWED);
}

template <>
void Version2::CarryOut<REQUEST_PICTURES>() {
  StickPicture picture;
  switch (request_.id) {
    case LIST_PICTURES:
      if (HasNoPayload() && IsStickFree()) {
        Answer(files_.Post(FileJob::LIST, PICTURE_FILE, NO_NAME));
      }
      break;
    case FETCH_PICTURE:
      if (Decode(&picture) && IsStickFree()) {
        Answer(files_.Post(FileJob::READ, PICTURE_FILE, picture.name));
      }
      break;
    case DELETE_PICTURE:
      if (Decode(&picture) && IsAllowed(&Settings::allow_delete, DELETE_MOTION.setting) && IsStickFree()) {
        Answer(files_.Post(FileJob::DELETE, PICTURE_FILE, picture.name));
      }
      break;
    default:
      Refuse(CODE_REFUSED, "bad request: the id is not one of 1 (list), 2 (fetch) and 3 (delete)");
  }
}

void Version2::PictureTaken(const unsigned char* jpeg, size_t size) {
  if (files_.IsPrepared()) {
    request_ = pending_;
    Answer(files_.Post(FileJob::STORE, PICTURE_FILE, NO_NAME, jpeg, size));
  }
}

// A fetched file is sent later, after EncodeFileHeader().
void Version2::PictureJobDone(const FileResult& result) {
  const FileOrder::Outcome outcome = files_.Finish(result);
  const bool is_done = outcome == FileOrder::DONE;
  if (is_done && request_.kind == REQUEST_SAVE_PICTURE) {
    StickPicture picture;
    strcpy(picture.name, result.name);
    Reply(picture);
  } else if (is_done && request_.id == LIST_PICTURES) {
    FinishReply(encodeFileList(result.list, Payload()));
  } else if (is_done && request_.id == FETCH_PICTURE && result.size == 0) {
    Refuse(CODE_FILE_MISSING, "the file is empty; delete it");
  } else if (is_done && request_.id == FETCH_PICTURE) {
    client_.owes_file = true;
  } else {
    Answer(outcome);
  }
}

size_t Version2::EncodeFileHeader(size_t size, unsigned char* out) {
  client_.owes_file = false;
  const FrameHeader header = {replyKind(pending_.kind), pending_.id, pending_.request_number,
                              static_cast<unsigned>(size)};
  return encode(header, out);
}
