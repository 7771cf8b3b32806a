#include "rcserver/version2/Version2Camera.h"

using namespace protocol::version2;

namespace {

unsigned char JpegQuality(unsigned char id) {
  return id == SERVER_DEFAULT_QUALITY ? protocol::DEFAULT_JPEG_QUALITY : protocol::limitJpegQuality(id);
}

PictureOrder OrderOf(const FrameHeader& request, Layer layer, unsigned short request_number) {
  const PictureOrder order = {JpegQuality(request.id), static_cast<unsigned char>(layer), request_number, false};
  return order;
}

}  // namespace

void Version2Camera::TakePicture(const Request& request, const unsigned char* payload) {
  Layer layer = LAYER_HIGH;
  if (const char* problem = decodePictureRequest(payload, request.payload_size, &layer)) {
    replies_.RefuseBadRequest(request, problem);
    return;
  }
  if (!TakesLayer(request, layer)) {
    return;
  }
  if (!camera_.RequestPicture(OrderOf(request, layer, request.request_number))) {
    replies_.Refuse(request, CODE_REFUSED, "too many pictures are owed already; wait for some of them");
  }
}

void Version2Camera::Stream(const Request& request, const unsigned char* payload) {
  StreamSettings settings;
  if (const char* problem = decodeStreamSettings(payload, request.payload_size, &settings)) {
    replies_.RefuseBadRequest(request, problem);
    return;
  }
  if (!TakesLayer(request, settings.layer)) {
    return;
  }
  if (settings.on) {
    camera_.StartStream(OrderOf(request, settings.layer, 0), settings.every_nth_image);
  } else {
    camera_.StopStream();
  }
  Request answered = request;
  answered.id = JpegQuality(request.id);
  replies_.Reply(answered, encodeStreamSettings(settings, replies_.Payload()));
}

// Refuses what this server cannot make of the camera's layers.
bool Version2Camera::TakesLayer(const Request& request, Layer layer) {
  if (layer == LAYER_DOUBLE) {
    replies_.Refuse(request, CODE_NOT_SUPPORTED, "not supported: pictures of double resolution");
    return false;
  }
  return true;
}
