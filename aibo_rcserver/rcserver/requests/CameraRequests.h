#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_CAMERA_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_CAMERA_REQUESTS_H

#include "protocol/color_requests.h"
#include "rcserver/Interval.h"
#include "rcserver/camera/ColorCounter.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/requests/Exchange.h"
#include "rcserver/requests/Robot.h"

/// Handles requests about the camera, and pushes the colours that it has detected. The answer to a request for a
/// picture is the picture.
class CameraRequests {
 public:
  CameraRequests(const Robot& robot, ImageObserver& pictures, Exchange& exchange)
      : robot_(robot), pictures_(pictures), exchange_(exchange), with_plane_(false) {}

  /// Call this for a new client, which gets no colours at first.
  void Begin() { colors_ = Interval(); }

  void TakePicture();    ///< `F`
  void Stream();         ///< `W`
  void SetCamera();      ///< `G`
  void DetectColors();   ///< `Z`
  void SendDatagrams();  ///< `B`

  /// True if the client wants the colours of this image. If so, call ColorsDetected().
  bool WantsColors(unsigned image_count) { return colors_.Chooses(image_count); }

  /// Pushes the colours detected in an image. They replace colours that still wait. If the camera has no such plane, an
  /// error is pushed instead, once.
  /// @param frame the frame in which the image was taken
  void ColorsDetected(const ColorPlane& plane, unsigned image_count, unsigned frame);

  static unsigned char JpegQuality(unsigned char id);

 private:
  bool MakesLayer(protocol::version2::Layer layer);
  void SwitchColors(const Interval& colors);
  void LoadColorTable();

  const Robot& robot_;
  ImageObserver& pictures_;
  Exchange& exchange_;
  Interval colors_;  ///< the images whose colours the client wants
  bool with_plane_;
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_CAMERA_REQUESTS_H
