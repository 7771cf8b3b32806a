#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_TAKER_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_TAKER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OSubject.h>

#include "objects/RegionSender.h"
#include "picture_encoder/PictureJob.h"
#include "protocol/version2.h"
#include "rcserver/camera/ColorCounter.h"
#include "rcserver/camera/ImageObserver.h"

/// Counts camera images, and passes them to PictureEncoder one at a time. While a picture is being made, the newest
/// image waits for its turn, so that a slow encoder is never idle.
class PictureTaker {
 public:
  PictureTaker();

  /// Call this in DoInit.
  /// @param gate to the encoder
  /// @return false if the memory could not be allocated
  bool Create(OSubject* gate) { return jobs_.Create(gate); }

  /// Call this in DoDestroy.
  void Destroy() {
    picture_.Destroy();
    jobs_.Destroy();
  }

  /// Call this for each image of the camera.
  void CountImage(OFbkImageVectorData* image);

  /// The camera's 16-bit image count, extended to 32 bits.
  unsigned ImageCount() const { return image_count_; }

  static bool HasDetail(OFbkImageVectorData* image);

  /// The plane of detected colours. Its pixels are NULL if the image has none.
  static ColorPlane FindColorPlane(OFbkImageVectorData* image);

  bool HasRoom() const { return jobs_.Memory() != NULL; }

  /// Keeps the last counted image for the next picture, if one is due. It replaces an image that waits, or a picture
  /// that has been made but not sent. Call this only if HasRoom().
  /// @param image the image, which is copied
  /// @param may_begin true: the image may be for a further picture; false: only in place of another one
  /// @param settings the settings of the camera
  /// @return NULL, or why no picture can be made
  const char* Offer(OFbkImageVectorData* image, ImageObserver& wanted, bool may_begin,
                    const protocol::version2::CameraSettings& settings);

  /// True if an image waits and the encoder is ready for it.
  bool MayBegin() const { return is_waiting_ && jobs_.IsFree(); }

  /// Passes the waiting image to the encoder. Call it only if MayBegin().
  void Begin();

  /// Call this when the client is gone. It drops the image and the picture.
  void Forget();

  /// Call this when PictureEncoder has finished a picture (gate Picture). The picture is kept until it is dropped.
  /// @return false if the picture was dropped meanwhile
  bool Take(const ONotifyEvent& event, OObserver* observer);

  // The picture that has been made.
  bool HasPicture() const { return picture_.IsThere(); }
  const EncodedPicture& Picture() const { return picture_.Get(); }
  void DropPicture() { picture_.Release(); }
  const PictureOrder& Order() const { return made_.order; }
  const protocol::version2::ImageHeader& Header() const { return made_.header; }

 private:
  struct Ordered {
    PictureOrder order;
    protocol::version2::ImageHeader header;
  };

  bool FindOrder(ImageObserver& wanted, bool may_begin, PictureOrder* order);

  RegionSender<PictureJob, 2> jobs_;
  unsigned image_count_;
  bool is_waiting_;
  Ordered waiting_;  ///< the image that waits
  unsigned ticket_;  ///< ticket of the picture that is being made; 0 if there is none
  HeldRegion<EncodedPicture> picture_;
  Ordered made_;  ///< the picture that is being made or has been made
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_TAKER_H
