/// @file StreamReport.h
/// What the console is told of the stream.
#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_STREAM_REPORT_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_STREAM_REPORT_H

#include "rcserver/camera/ImageObserver.h"

/// Tells the console when the stream begins and stops, and then how many camera images were left out.
class StreamReport {
 public:
  StreamReport();

  /// To be called when requests have been handled.
  void Update(const ImageObserver& camera);

  /// A picture is sent.
  /// @param image_count of the camera's image that it was made of
  void PictureIsSent(unsigned image_count);

  /// The stream ends without a word: that the client is gone is said already.
  void ClientGone() { is_streaming_ = false; }

 private:
  bool is_streaming_;         ///< as far as the console has been told
  unsigned last_image_;       ///< image count of the last picture of the stream
  unsigned long pictures_;    ///< sent in the stream
  unsigned long images_out_;  ///< of the camera, left out in the stream
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_STREAM_REPORT_H
