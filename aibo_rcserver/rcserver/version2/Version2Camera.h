/// @file Version2Camera.h
/// The camera, for a client of version 2.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_CAMERA_H
#define AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_CAMERA_H

#include "rcserver/camera/ImageObserver.h"
#include "rcserver/version2/Version2Replies.h"

/// Carries out `F` and `W`. Pure logic: no OPEN-R. Each function answers its request, a picture apart, which is the
/// answer itself; `payload` is as many bytes as the request's header says.
class Version2Camera {
 public:
  typedef Version2Replies::Request Request;

  /// All must outlive this.
  Version2Camera(ImageObserver& camera, Version2Replies& replies) : camera_(camera), replies_(replies) {}

  void TakePicture(const Request& request, const unsigned char* payload);
  void Stream(const Request& request, const unsigned char* payload);

 private:
  bool TakesLayer(const Request& request, protocol::version2::Layer layer);

  ImageObserver& camera_;
  Version2Replies& replies_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_CAMERA_H
