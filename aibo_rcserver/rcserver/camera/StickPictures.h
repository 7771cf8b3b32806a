/// @file StickPictures.h
/// The requests about pictures on the memory stick: `M` and `Y` of version 2.
#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_STICK_PICTURES_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_STICK_PICTURES_H

#include <stddef.h>

#include "protocol/text.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/files/FileOrder.h"
#include "rcserver/settings/Settings.h"

/// Takes pictures onto the memory stick, lists, reads and deletes them, if RCSERVER.CFG allows it. A request that fails
/// changes nothing, and the FileOrder has the reason. Otherwise it is PENDING until FileOrder::Finish(). None of these
/// may be called while the FileOrder is busy.
class StickPictures {
 public:
  /// All must outlive this.
  StickPictures(ImageObserver& camera, FileOrder& order, const Settings& settings)
      : camera_(camera), order_(order), settings_(settings) {}

  /// Orders a picture of the camera's next image; Taken() stores it.
  /// @param quality JPEG quality, 0..100
  FileOrder::Outcome Take(unsigned char quality, unsigned short request_number);

  /// The picture that Take() has ordered has been made: stores it under a name that FileResult::name has.
  FileOrder::Outcome Taken(const unsigned char* jpeg, size_t size);

  /// In FileResult::list when it is DONE.
  FileOrder::Outcome List();

  /// In FileResult::content when it is DONE.
  FileOrder::Outcome Read(const protocol::PictureName& name);

  FileOrder::Outcome Delete(const protocol::PictureName& name);

 private:
  StickPictures(const StickPictures&);
  StickPictures& operator=(const StickPictures&);

  bool AreAllowed();

  ImageObserver& camera_;
  FileOrder& order_;
  const Settings& settings_;
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_STICK_PICTURES_H
