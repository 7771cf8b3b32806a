/// @file ImageObserver.h
/// What the camera owes the client: the state machine behind `F` and `W`.
#ifndef RCSERVER_IMAGE_OBSERVER_H
#define RCSERVER_IMAGE_OBSERVER_H

#include <stddef.h>

// Names and comments of the states: report, section 3.3.2.
enum ImageObserverState {
  IOS_IDLE,        ///< do nothing
  IOS_PICTURE,     ///< take a picture
  IOS_CONTINUOUS,  ///< send stream
  IOS_STOPSEND     ///< stop sending stream
};

/// Decides which camera image becomes a picture, and of which JPEG quality. Pure logic: no camera, no client.
///
/// Every `F` is answered by exactly one picture, each from a camera image of its own, in the order of the requests.
/// Pictures owed to `F` go before those of the stream, and a stream that stops leaves them owed.
class ImageObserver {
 public:
  /// Most pictures that can be owed at once: eight seconds of them. Only a client that floods gets there.
  static const size_t MAX_OWED = 256;

  ImageObserver();

  ImageObserverState State() const { return state_; }

  /// `F`: one more picture is owed.
  /// @param quality JPEG quality, 0..100
  /// @return false if MAX_OWED pictures are owed already; then this one is not
  bool RequestPicture(unsigned char quality);

  /// `W`: the stream begins, or it stops.
  /// @param quality JPEG quality of the stream, 0..100
  void ToggleStream(unsigned char quality);

  /// A camera image arrived, and it can be sent now. Leaves IOS_STOPSEND, which lasts for one image.
  /// @param[out] quality JPEG quality of the picture to send
  /// @return true if this image is to be sent
  bool ImageArrived(unsigned char* quality);

  /// The client is gone, and with it all that was owed.
  void ClientGone();

 private:
  unsigned char TakeOldestOwed();

  ImageObserverState state_;
  unsigned char stream_quality_;
  unsigned char owed_[MAX_OWED];  ///< qualities, a ring
  size_t oldest_owed_;
  size_t number_of_owed_;
};

#endif  // RCSERVER_IMAGE_OBSERVER_H
