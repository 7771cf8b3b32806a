#include "rcserver/requests/ColorRequests.h"

#include <stdio.h>

using namespace protocol::version2;

ColorRequests::ColorRequests(CameraControl& camera, Exchange& exchange)
    : camera_(camera), exchange_(exchange), wish_() {}

void ColorRequests::CarryOut() {
  ColorSettings settings = {1, false};
  switch (exchange_.Id()) {
    case COLORS_OFF:
      if (exchange_.HasNoPayload()) {
        Switch(false, settings);
        exchange_.ReplyWithoutPayload();
      }
      break;
    case COLORS_ON:
      if (exchange_.Decode(&settings)) {
        Switch(true, settings);
        exchange_.Reply(settings);
      }
      break;
    case COLORS_TABLE:
      LoadTable();
      break;
    default:
      exchange_.Refuse(CODE_REFUSED, "bad request: the id is not 0 (off), 1 (on) or 2 (table)");
  }
}

// Switches the detection. Detections that wait were made with the earlier settings, and are dropped.
void ColorRequests::Switch(bool on, const ColorSettings& settings) {
  const Wish wish = {on, settings, false, 0};
  wish_ = wish;
  exchange_.Out().Colors().Drop();
}

void ColorRequests::LoadTable() {
  ColorTable table;
  if (!exchange_.Decode(&table)) {
    return;
  }
  const int channels = camera_.NumberOfChannels();
  if (table.channel >= channels) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "the camera of this robot has no channel %d to detect colours; it has %d, from 0 on",
            static_cast<int>(table.channel), channels);
    exchange_.Refuse(CODE_REFUSED, text);
  } else if (camera_.Load(table)) {
    exchange_.Out().Colors().Drop();  // the colours that wait were detected with the earlier table
    exchange_.ReplyWithoutPayload();
  } else {
    exchange_.Refuse(CODE_REFUSED, "the robot's camera does not take this table; the robot's console says why");
  }
}

void ColorRequests::Detected(const ColorPlane& plane, unsigned image_count, unsigned frame) {
  if (plane.pixels == NULL) {
    if (exchange_.HasRoom()) {
      Switch(false, wish_.settings);
      exchange_.PushError(CODE_NOT_SUPPORTED,
                          "the images of this robot's camera have no plane with the colours detected");
    }
    return;
  }
  wish_.has_pushed = true;
  wish_.last = image_count;
  ColorRegions regions;
  regions.image_count = image_count;
  regions.frame_number = frame;
  regions.width = static_cast<unsigned short>(plane.width);
  regions.height = static_cast<unsigned short>(plane.height);
  regions.has_plane = wish_.settings.with_plane && canPackPlane(plane);
  countColors(plane, camera_.LoadedTables(), &regions);
  regions.plane = NULL;
  regions.plane_size = 0;
  size_t size = encode(regions, exchange_.Payload());
  if (regions.has_plane) {
    size += packPlane(plane, exchange_.Payload() + size);
  }
  exchange_.Out().Colors().Set(exchange_.Message(), exchange_.Complete(COLORS_PUSH, 0, 0, size));
}
