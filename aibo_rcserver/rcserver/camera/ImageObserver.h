/// @file ImageObserver.h
/// What the camera owes the client: the state machine behind `F` and `W`.
#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_IMAGE_OBSERVER_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_IMAGE_OBSERVER_H

#include <stddef.h>

// Names and comments of the states: report, section 3.3.2.
enum ImageObserverState {
  IOS_IDLE,        ///< do nothing
  IOS_PICTURE,     ///< take a picture
  IOS_CONTINUOUS,  ///< send stream
  IOS_STOPSEND     ///< stop sending stream
};

/// What a picture is to be.
struct PictureOrder {
  unsigned char quality;          ///< JPEG quality, 0..100
  unsigned char layer;            ///< of the camera, as OPEN-R numbers them; version 1 knows but the first, 0
  unsigned short request_number;  ///< of the `F` that asked for it, in version 2; 0 in a stream and in version 1
  bool is_of_stream;              ///< else it is owed to an `F`
};

/// Decides which camera image becomes a picture, and what kind of. Pure logic: no camera, no client.
///
/// Every `F` is answered by exactly one picture, each from a camera image of its own, in the order of the requests.
/// Pictures owed to `F` go before those of the stream, and a stream that stops leaves them owed.
class ImageObserver {
 public:
  /// Most pictures that can be owed at once: eight seconds of them. Only a client that floods gets there.
  static const size_t MAX_OWED = 256;

  ImageObserver();

  ImageObserverState State() const { return state_; }

  /// Of the stream, or of the last one.
  unsigned char StreamQuality() const { return stream_order_.quality; }

  /// `F`: one more picture is owed.
  /// @param order whose is_of_stream does not matter here, nor in the functions below
  /// @return false if MAX_OWED pictures are owed already; then this one is not
  bool RequestPicture(const PictureOrder& order);

  /// `W` of version 1: the stream of every image begins, or it stops.
  void ToggleStream(const PictureOrder& order);

  /// `W` of version 2: the stream begins or goes on, from now on like this.
  /// @param every_nth_image of the camera; not 0
  void StartStream(const PictureOrder& order, unsigned short every_nth_image);

  /// `W` of version 2: the stream stops, if there is one.
  void StopStream();

  /// A camera image arrived, and it can be sent now. Leaves IOS_STOPSEND, which lasts for one image.
  /// @param image_count the camera's count of its images, of which some may be left out
  /// @param[out] order what the picture to send is to be
  /// @return true if this image is to be sent
  bool ImageArrived(unsigned image_count, PictureOrder* order);

  /// A picture that was not sent yet is made again of an image that arrived later.
  /// @param order that ImageArrived() has given
  void TakeAgain(const PictureOrder& order, unsigned image_count);

  /// True if a picture is still wanted: it is owed, or it is as the stream's pictures are now.
  /// @param order that ImageArrived() has given
  bool Wants(const PictureOrder& order) const;

  /// The client is gone, and with it all that was owed.
  void ClientGone();

 private:
  void TakeOldestOwed(PictureOrder* order);
  bool TakeStreamPicture(unsigned image_count, PictureOrder* order);

  ImageObserverState state_;
  PictureOrder stream_order_;
  unsigned short every_nth_image_;
  bool stream_has_begun_;        ///< a picture of this stream has been sent
  unsigned last_of_stream_;      ///< count of the image that it was made of
  PictureOrder owed_[MAX_OWED];  ///< a ring
  size_t oldest_owed_;
  size_t number_of_owed_;
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_IMAGE_OBSERVER_H
