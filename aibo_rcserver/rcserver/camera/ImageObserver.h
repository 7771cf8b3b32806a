/// What the camera owes the client: the state machine behind `F` and `W`.
#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_IMAGE_OBSERVER_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_IMAGE_OBSERVER_H

#include <stddef.h>

#include "rcserver/Interval.h"
#include "rcserver/Queue.h"

// The names and comments of the states are those of the report, section 3.3.2.
enum ImageObserverState {
  IOS_IDLE,        ///< do nothing
  IOS_PICTURE,     ///< take a picture
  IOS_CONTINUOUS,  ///< send stream
  IOS_STOPSEND     ///< stop sending stream
};

struct PictureOrder {
  enum Purpose {
    FOR_REQUEST,  ///< owed to an `F`
    FOR_STICK,    ///< owed to an `M`: the picture is stored on the memory stick and not sent
    FOR_STREAM
  };

  unsigned char quality;          ///< JPEG quality, 0..100
  unsigned char layer;            ///< protocol::version2::Layer; always 0 in version 1
  unsigned short request_number;  ///< of the `F` that asked for the picture, in version 2; otherwise 0
  Purpose purpose;
};

/// Decides which images of the camera become pictures, and of which kind.
///
/// Every `F` is answered with exactly one picture, each from a different camera image, in the order of the requests.
/// Pictures owed to `F` are sent before those of the stream, and stay owed when the stream stops.
class ImageObserver {
 public:
  /// Most pictures that can be owed at once: those of eight seconds. Only a client that floods the server reaches this
  /// limit.
  static const int MAX_OWED = 256;

  /// The error for a client whose picture RequestPicture() refuses.
  static const char TOO_MANY_OWED[];

  ImageObserver();

  /// True unless the camera's images are known to lack the bands for double resolution.
  bool HasDetail() const { return has_detail_; }
  void SetHasDetail(bool has_detail) { has_detail_ = has_detail; }

  /// `F`: one more picture is owed.
  /// @return false if MAX_OWED pictures are owed already, so that this one is not added
  bool RequestPicture(const PictureOrder& order);

  bool IsStreaming() const { return state_ == IOS_CONTINUOUS; }

  /// `W`: starts a stream, or changes the running one.
  /// @param every_nth_image 1 for every image of the camera; not 0
  void StartStream(const PictureOrder& order, unsigned short every_nth_image);

  /// `W`: stops the stream, if there is one.
  void StopStream();

  /// Call this when a camera image has come and could be sent. It leaves IOS_STOPSEND, which lasts for one image.
  /// @param image_count the camera's count of its images, with gaps if images were lost
  /// @param[out] order the picture to make of the image
  /// @return true if a picture is to be made of this image
  bool ImageArrived(unsigned image_count, PictureOrder* order);

  /// Call this when a picture that has not been sent can be made again from a later image.
  /// @param order from ImageArrived()
  /// @return see Wants()
  bool TakeAgain(const PictureOrder& order, unsigned image_count);

  /// True if a picture is still wanted: it is owed, or the stream's quality and layer have not changed.
  /// @param order from ImageArrived()
  bool Wants(const PictureOrder& order) const;

  /// Call this when the client is gone: no picture is owed any more, and the stream is off.
  void ClientGone();

 private:
  ImageObserverState state_;
  bool has_detail_;
  PictureOrder stream_order_;
  Interval stream_interval_;
  Queue<PictureOrder, MAX_OWED> owed_;
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_IMAGE_OBSERVER_H
