#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_CAMERA_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_CAMERA_REQUESTS_H

#include "rcserver/camera/ImageObserver.h"
#include "rcserver/requests/Exchange.h"
#include "rcserver/requests/Robot.h"

/// Handles requests about the camera. The answer to a request for a picture is the picture.
class CameraRequests {
 public:
  CameraRequests(const Robot& robot, ImageObserver& camera, Exchange& exchange)
      : robot_(robot), camera_(camera), exchange_(exchange) {}

  void TakePicture();    ///< `F`
  void Stream();         ///< `W`
  void SetCamera();      ///< `G`
  void SendDatagrams();  ///< `B`

  static unsigned char JpegQuality(unsigned char id);

 private:
  bool MakesLayer(protocol::version2::Layer layer);

  const Robot& robot_;
  ImageObserver& camera_;
  Exchange& exchange_;
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_CAMERA_REQUESTS_H
