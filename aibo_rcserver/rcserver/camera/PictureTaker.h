/// @file PictureTaker.h
/// RCServer's side of the object PictureEncoder.
#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_TAKER_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_TAKER_H

#include <OPENR/OSubject.h>

#include "objects/RegionSender.h"
#include "picture_encoder/PictureJob.h"
#include "protocol/version2.h"
#include "rcserver/camera/CameraImage.h"
#include "rcserver/camera/ImageObserver.h"

/// Has pictures made of camera images, one at a time. While one is being made, the newest image waits to be the next:
/// so an encoder that takes longer than the camera is never idle.
class PictureTaker {
 public:
  PictureTaker();

  /// To be called in DoInit.
  /// @param gate to the encoder; must outlive this
  /// @return false if the memory could not be allocated
  bool Create(OSubject* gate) { return jobs_.Create(gate); }

  /// To be called in DoDestroy.
  void Destroy() { jobs_.Destroy(); }

  /// False if there is no encoder: no picture will ever be made.
  bool HasEncoder() const { return jobs_.HasReceiver(); }

  /// True if there is room for an image that waits.
  bool HasRoom() const { return jobs_.Memory() != NULL; }

  /// An image is to become the next picture, in the place of one that waits. Only if HasRoom().
  /// @param image is copied
  /// @return false if it is larger than MAX_IMAGE_WIDTH x MAX_IMAGE_HEIGHT
  bool Offer(const CameraImage& image, const PictureOrder& order, const protocol::version2::ImageHeader& header);

  /// True from Offer() to Begin().
  bool IsWaiting() const { return is_waiting_; }
  const PictureOrder& WaitingOrder() const { return waiting_order_; }

  /// The image that waits is not wanted any more.
  void DropWaiting() { is_waiting_ = false; }

  /// True if there is an image that waits, and the encoder takes it now.
  bool MayBegin() const { return is_waiting_ && jobs_.IsFree(); }

  /// Has the picture made. Only if MayBegin().
  void Begin();

  /// Neither the picture that is being made nor the image that waits is wanted any more.
  void Forget() {
    ticket_ = 0;
    is_waiting_ = false;
  }

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

  RegionSender<PictureJob, 2> jobs_;
  bool is_waiting_;
  PictureOrder waiting_order_;
  protocol::version2::ImageHeader waiting_header_;
  unsigned ticket_;  ///< of the picture that is being made; 0: none is
  PictureOrder order_;
  protocol::version2::ImageHeader header_;
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_TAKER_H
