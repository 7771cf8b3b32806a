/// @file PictureTaker.h
/// RCServer's side of the object PictureEncoder.
#ifndef RCSERVER_CAMERA_PICTURE_TAKER_H
#define RCSERVER_CAMERA_PICTURE_TAKER_H

#include <OPENR/OSubject.h>

#include "jobs/RegionSender.h"
#include "picture_encoder/PictureJob.h"
#include "protocol/version2.h"
#include "rcserver/camera/CameraImage.h"
#include "rcserver/camera/ImageObserver.h"

/// Has pictures made of camera images, one at a time.
class PictureTaker {
 public:
  PictureTaker();

  /// To be called in DoInit.
  /// @param gate to the encoder; must outlive this
  /// @return false if there is no memory
  bool Create(OSubject* gate) { return jobs_.Create(gate); }

  /// To be called in DoDestroy.
  void Destroy() { jobs_.Destroy(); }

  /// True if the encoder takes an image now.
  bool IsFree() const { return jobs_.IsFree(); }

  /// Has a picture made. Only if IsFree().
  /// @param image is copied
  /// @return false if it is larger than MAX_IMAGE_WIDTH x MAX_IMAGE_HEIGHT
  bool Begin(const CameraImage& image, const PictureOrder& order, const protocol::version2::ImageHeader& header);

  /// True from Begin() until the picture has come, or is not wanted any more.
  bool IsMaking() const { return ticket_ != 0; }

  /// The picture that is being made is not wanted any more.
  void Forget() { ticket_ = 0; }

  /// A picture has come.
  /// @return false if it is not wanted any more
  bool Take(const EncodedPicture& picture);

  /// @name The picture that is being made, or that has come last
  /// @{
  const PictureOrder& Order() const { return order_; }
  const protocol::version2::ImageHeader& Header() const { return header_; }
  /// @}

 private:
  PictureTaker(const PictureTaker&);
  PictureTaker& operator=(const PictureTaker&);

  RegionSender<PictureJob> jobs_;
  unsigned ticket_;  ///< of the picture that is being made; 0: none is
  PictureOrder order_;
  protocol::version2::ImageHeader header_;
};

#endif  // RCSERVER_CAMERA_PICTURE_TAKER_H
