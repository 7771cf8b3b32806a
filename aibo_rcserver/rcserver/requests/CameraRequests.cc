#include "rcserver/requests/CameraRequests.h"

#include <stdio.h>

#include "protocol/picture_datagram.h"

using namespace protocol::version2;

namespace {

PictureOrder OrderOf(unsigned char quality, Layer layer, unsigned short request_number, PictureOrder::Purpose purpose) {
  const PictureOrder order = {quality, static_cast<unsigned char>(layer), request_number, purpose};
  return order;
}

}  // namespace

void CameraRequests::TakePicture() {
  PictureRequest wanted;
  if (exchange_.Decode(&wanted) && MakesLayer(wanted.layer) &&
      !pictures_.RequestPicture(OrderOf(JpegQuality(exchange_.Id()), wanted.layer, exchange_.Request().request_number,
                                        PictureOrder::FOR_REQUEST))) {
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
    pictures_.StartStream(OrderOf(quality, stream.layer, 0, PictureOrder::FOR_STREAM), stream.every_nth_image);
  } else {
    pictures_.StopStream();
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

void CameraRequests::DetectColors() {
  ColorSettings settings;
  switch (exchange_.Id()) {
    case COLORS_OFF:
      if (exchange_.HasNoPayload()) {
        SwitchColors(Interval());
        exchange_.ReplyWithoutPayload();
      }
      break;
    case COLORS_ON:
      if (exchange_.Decode(&settings)) {
        SwitchColors(Interval(settings.every_nth_image));
        with_plane_ = settings.with_plane;
        exchange_.Reply(settings);
      }
      break;
    case COLORS_TABLE:
      LoadColorTable();
      break;
    default:
      exchange_.Refuse(CODE_REFUSED, "bad request: the id is not 0 (off), 1 (on) or 2 (table)");
  }
}

void CameraRequests::ColorsDetected(const ColorPlane& plane, unsigned image_count, unsigned frame) {
  if (plane.pixels == NULL) {
    if (exchange_.HasRoom()) {
      SwitchColors(Interval());
      exchange_.PushError(CODE_NOT_SUPPORTED,
                          "the images of this robot's camera have no plane with the colours detected");
    }
    return;
  }
  ColorRegions regions;
  regions.image_count = image_count;
  regions.frame_number = frame;
  regions.width = static_cast<unsigned short>(plane.width);
  regions.height = static_cast<unsigned short>(plane.height);
  regions.has_plane = with_plane_ && canPackPlane(plane);
  countColors(plane, robot_.camera.LoadedTables(), &regions);
  regions.plane = NULL;
  regions.plane_size = 0;
  size_t size = encode(regions, exchange_.Payload());
  if (regions.has_plane) {
    size += packPlane(plane, exchange_.Payload() + size);
  }
  exchange_.Out().Colors().Set(exchange_.Message(), exchange_.Complete(COLORS_PUSH, 0, 0, size));
}

unsigned char CameraRequests::JpegQuality(unsigned char id) {
  return id == SERVER_DEFAULT_QUALITY ? protocol::DEFAULT_JPEG_QUALITY : protocol::limitJpegQuality(id);
}

bool CameraRequests::MakesLayer(Layer layer) {
  const bool makes = layer != LAYER_DOUBLE || pictures_.HasDetail();
  if (!makes) {
    exchange_.Refuse(CODE_NOT_SUPPORTED, "not supported: this robot's camera has no bands for double resolution");
  }
  return makes;
}

// Switches the detection. Detections that wait were made with the earlier settings, and are dropped.
void CameraRequests::SwitchColors(const Interval& colors) {
  colors_ = colors;
  exchange_.Out().Colors().Drop();
}

void CameraRequests::LoadColorTable() {
  ColorTable table;
  if (!exchange_.Decode(&table)) {
    return;
  }
  const int channels = robot_.camera.NumberOfChannels();
  if (table.channel >= channels) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "the camera of this robot has no channel %d to detect colours; it has %d, from 0 on",
            static_cast<int>(table.channel), channels);
    exchange_.Refuse(CODE_REFUSED, text);
  } else if (robot_.camera.Load(table)) {
    exchange_.Out().Colors().Drop();  // the colours that wait were detected with the earlier table
    exchange_.ReplyWithoutPayload();
  } else {
    exchange_.Refuse(CODE_REFUSED, "the robot's camera does not take this table; the robot's console says why");
  }
}
