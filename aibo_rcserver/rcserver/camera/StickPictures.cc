#include "rcserver/camera/StickPictures.h"

#include "protocol/version2.h"

namespace {

const protocol::PictureName NO_NAME = "";

}  // namespace

FileOrder::Outcome StickPictures::Take(unsigned char quality, unsigned short request_number) {
  if (!AreAllowed() || order_.Prepare() != FileOrder::PENDING) {
    return FileOrder::REFUSED;
  }
  const PictureOrder picture = {quality, protocol::version2::LAYER_HIGH, request_number, false, true};
  if (!camera_.RequestPicture(picture)) {
    return order_.Fail(FileOrder::REFUSED, "too many pictures are owed already; wait until some have come");
  }
  return FileOrder::PENDING;
}

FileOrder::Outcome StickPictures::Taken(const unsigned char* jpeg, size_t size) {
  return order_.Post(FileJob::STORE, PICTURE_FILE, NO_NAME, jpeg, size);
}

FileOrder::Outcome StickPictures::List() {
  return AreAllowed() ? order_.Post(FileJob::LIST, PICTURE_FILE, NO_NAME, NULL, 0) : FileOrder::REFUSED;
}

FileOrder::Outcome StickPictures::Read(const protocol::PictureName& name) {
  return AreAllowed() ? order_.Post(FileJob::READ, PICTURE_FILE, name, NULL, 0) : FileOrder::REFUSED;
}

FileOrder::Outcome StickPictures::Delete(const protocol::PictureName& name) {
  if (!AreAllowed()) {
    return FileOrder::REFUSED;
  }
  if (!settings_.allow_delete) {
    return order_.Fail(FileOrder::REFUSED,
                       "deleting is not allowed; ALLOW_DELETE=yes in RCSERVER.CFG on the memory stick allows it");
  }
  return order_.Post(FileJob::DELETE, PICTURE_FILE, name, NULL, 0);
}

bool StickPictures::AreAllowed() {
  if (!settings_.allow_pictures) {
    order_.Fail(FileOrder::REFUSED,
                "pictures on the memory stick are not allowed; ALLOW_PICTURES=yes in RCSERVER.CFG on it allows them");
  }
  return settings_.allow_pictures;
}
