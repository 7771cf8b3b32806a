#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_COLOR_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_COLOR_REQUESTS_H

#include "protocol/color_requests.h"
#include "rcserver/camera/CameraControl.h"
#include "rcserver/camera/ColorCounter.h"
#include "rcserver/requests/Exchange.h"

/// Loads the tables of colours, and pushes what the camera has detected with them.
class ColorRequests {
 public:
  ColorRequests(CameraControl& camera, Exchange& exchange);

  /// Call this for a new client, which gets no colours at first.
  void Begin() { wish_ = Wish(); }

  /// Carries out `Z`.
  void CarryOut();

  /// True if the client has switched on colour detection and this image is due.
  bool Wants(unsigned image_count) const {
    return wish_.is_on && (!wish_.has_pushed || image_count - wish_.last >= wish_.settings.every_nth_image);
  }

  /// Pushes the colours detected in an image. They replace colours that still wait. Call this only if Wants(). If the
  /// camera has no such plane, an error is pushed instead, once.
  /// @param frame the frame in which the image was taken
  void Detected(const ColorPlane& plane, unsigned image_count, unsigned frame);

 private:
  // What the client wants. Everything is 0 for a new client.
  struct Wish {
    bool is_on;
    protocol::version2::ColorSettings settings;
    bool has_pushed;  ///< colours were pushed with these settings
    unsigned last;    ///< image count of the last image whose colours were pushed
  };

  void Switch(bool on, const protocol::version2::ColorSettings& settings);
  void LoadTable();

  CameraControl& camera_;
  Exchange& exchange_;
  Wish wish_;
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_COLOR_REQUESTS_H
