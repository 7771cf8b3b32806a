#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_CAMERA_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_CAMERA_REQUESTS_H

#include "protocol/color_requests.h"
#include "rcserver/camera/ColorCounter.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/requests/Exchange.h"
#include "rcserver/requests/Robot.h"

/// Handles requests about the camera, and pushes the colours that it has detected. The answer to a request for a
/// picture is the picture.
class CameraRequests {
 public:
  CameraRequests(const Robot& robot, ImageObserver& pictures, Exchange& exchange)
      : robot_(robot), pictures_(pictures), exchange_(exchange), wish_() {}

  /// Call this for a new client, which gets no colours at first.
  void Begin() { wish_ = Wish(); }

  void TakePicture();    ///< `F`
  void Stream();         ///< `W`
  void SetCamera();      ///< `G`
  void DetectColors();   ///< `Z`
  void SendDatagrams();  ///< `B`

  /// True if the client has switched on colour detection and this image is due.
  bool WantsColors(unsigned image_count) const {
    return wish_.is_on && (!wish_.has_pushed || image_count - wish_.last >= wish_.settings.every_nth_image);
  }

  /// Pushes the colours detected in an image. They replace colours that still wait. Call this only if WantsColors(). If
  /// the camera has no such plane, an error is pushed instead, once.
  /// @param frame the frame in which the image was taken
  void ColorsDetected(const ColorPlane& plane, unsigned image_count, unsigned frame);

  static unsigned char JpegQuality(unsigned char id);

 private:
  // The colours that the client wants. Everything is 0 for a new client.
  struct Wish {
    bool is_on;
    protocol::version2::ColorSettings settings;
    bool has_pushed;  ///< colours were pushed with these settings
    unsigned last;    ///< image count of the last image whose colours were pushed
  };

  bool MakesLayer(protocol::version2::Layer layer);
  void SwitchColors(bool on, const protocol::version2::ColorSettings& settings);
  void LoadColorTable();

  const Robot& robot_;
  ImageObserver& pictures_;
  Exchange& exchange_;
  Wish wish_;
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_CAMERA_REQUESTS_H
