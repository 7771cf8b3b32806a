// The requests of version 2 about pictures on the memory stick.
#include <string.h>

#include "protocol/stick_pictures.h"
#include "rcserver/Version2.h"

using namespace protocol::version2;

bool Version2::SavePicture() {
  if (!IsWellFormed(checkNoPayload(request_.payload_size))) {
    return true;
  }
  if (MustWaitForFiles()) {
    return false;
  }
  request_.id = JpegQuality(request_.id);  // the reply has the quality in use
  Answer(pictures_.Take(request_.id, request_.request_number));
  return true;
}

bool Version2::HandlePictures() {
  protocol::PictureName name = "";
  const bool has_name = request_.id == FETCH_PICTURE || request_.id == DELETE_PICTURE;
  if (!has_name && request_.id != LIST_PICTURES) {
    Refuse(CODE_REFUSED, "bad request: the id is not one of 1 (list), 2 (fetch) and 3 (delete)");
    return true;
  }
  if (!IsWellFormed(has_name ? decodePictureName(payload_, request_.payload_size, name)
                             : checkNoPayload(request_.payload_size))) {
    return true;
  }
  if (MustWaitForFiles()) {
    return false;
  }
  switch (request_.id) {
    case LIST_PICTURES:
      Answer(pictures_.List());
      break;
    case FETCH_PICTURE:
      Answer(pictures_.Read(name));
      break;
    default:
      Answer(pictures_.Delete(name));
  }
  return true;
}

void Version2::PictureTaken(const unsigned char* jpeg, size_t size) {
  if (files_.IsPrepared()) {
    request_ = pending_;
    Answer(pictures_.Taken(jpeg, size));
  }
}

// A file goes to the client by EncodeFileHeader().
void Version2::PictureJobDone(const FileResult& result) {
  const FileOrder::Outcome outcome = files_.Finish(result);
  const bool is_done = outcome == FileOrder::DONE;
  if (is_done && request_.kind == REQUEST_SAVE_PICTURE) {
    Reply(encodePictureName(result.name, Payload()));
  } else if (is_done && request_.id == LIST_PICTURES) {
    Reply(encodePictureList(result.list, Payload()));
  } else if (is_done && request_.id == FETCH_PICTURE && result.size == 0) {
    Refuse(CODE_FILE_MISSING, "the file is empty; delete it");
  } else if (is_done && request_.id == FETCH_PICTURE) {
    owes_file_ = true;
  } else {
    Answer(outcome);
  }
}

size_t Version2::EncodeFileHeader(size_t size, unsigned char* out) {
  owes_file_ = false;
  const FrameHeader header = {replyKind(pending_.kind), pending_.id, pending_.request_number,
                              static_cast<unsigned>(size)};
  return encodeFrameHeader(header, out);
}
