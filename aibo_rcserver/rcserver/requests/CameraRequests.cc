#include "rcserver/requests/CameraRequests.h"

#include "protocol/picture_datagram.h"

using namespace protocol::version2;

namespace {

PictureOrder OrderOf(unsigned char quality, Layer layer, unsigned short request_number) {
  const PictureOrder order = {quality, static_cast<unsigned char>(layer), request_number, false, false};
  return order;
}

}  // namespace

void CameraRequests::TakePicture() {
  PictureRequest wanted;
  if (exchange_.Decode(&wanted) && MakesLayer(wanted.layer) &&
      !camera_.RequestPicture(OrderOf(JpegQuality(exchange_.Id()), wanted.layer, exchange_.Request().request_number))) {
    exchange_.Refuse(CODE_REFUSED, ImageObserver::TOO_MANY_OWED);
  }
}

void CameraRequests::Stream() {
  StreamSettings stream;
  if (!exchange_.Decode(&stream) || !MakesLayer(stream.layer)) {
    return;
  }
  const unsigned char quality = JpegQuality(exchange_.Id());
  if (stream.on) {
    camera_.StartStream(OrderOf(quality, stream.layer, 0), stream.every_nth_image);
  } else {
    camera_.StopStream();
  }
  exchange_.AnswerWithId(quality);
  exchange_.Reply(stream);
}

void CameraRequests::SetCamera() {
  CameraValue wanted = {exchange_.Id(), 0};
  if (!exchange_.IsWellFormed(problemOfCameraValue(exchange_.Id(), 1)) ||
      (exchange_.HasPayload() && !exchange_.Decode(&wanted))) {
    return;
  }
  const CameraSetting setting = static_cast<CameraSetting>(exchange_.Id());
  if (exchange_.HasPayload() && !robot_.camera.Set(setting, wanted.value)) {
    exchange_.Refuse(CODE_REFUSED, "the robot's camera does not take this setting; the robot's console says why");
    return;
  }
  wanted.value = robot_.camera.Settings().of(setting);
  exchange_.Reply(wanted);
}

void CameraRequests::SendDatagrams() {
  DatagramOrder order;
  if (!exchange_.Decode(&order)) {
    return;
  }
  if (order.port == 0) {
    robot_.datagrams.HandOver();
  } else if (!robot_.datagrams.SendTo(order)) {
    exchange_.Refuse(CODE_REFUSED, "the IPStack has no endpoint for datagrams; pictures go over this connection");
    return;
  }
  exchange_.Reply(order);
}

unsigned char CameraRequests::JpegQuality(unsigned char id) {
  return id == SERVER_DEFAULT_QUALITY ? protocol::DEFAULT_JPEG_QUALITY : protocol::limitJpegQuality(id);
}

bool CameraRequests::MakesLayer(Layer layer) {
  const bool makes = layer != LAYER_DOUBLE || camera_.HasDetail();
  if (!makes) {
    exchange_.Refuse(CODE_NOT_SUPPORTED, "not supported: this robot's camera has no bands for double resolution");
  }
  return makes;
}
