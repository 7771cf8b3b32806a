// The request and the push of version 2 about the camera's colour detection.
#include <stdio.h>

#include "rcserver/requests/Version2.h"

using namespace protocol::version2;

template <>
void Version2::CarryOut<REQUEST_COLORS>() {
  ColorSettings settings = {1, false};
  switch (request_.id) {
    case COLORS_OFF:
      if (HasNoPayload()) {
        SwitchColors(false, settings);
        Reply(NoPayload());
      }
      break;
    case COLORS_ON:
      if (Decode(&settings)) {
        SwitchColors(true, settings);
        Reply(settings);
      }
      break;
    case COLORS_TABLE:
      LoadColorTable();
      break;
    default:
      Refuse(CODE_REFUSED, "bad request: the id is not 0 (off), 1 (on) or 2 (table)");
  }
}

// Drops detections that were made with the earlier settings.
void Version2::SwitchColors(bool on, const ColorSettings& settings) {
  client_.detects_colors = on;
  client_.colors = settings;
  client_.has_pushed_colors = false;
  outbox_.Colors().Drop();
}

void Version2::LoadColorTable() {
  ColorTable table;
  if (!Decode(&table)) {
    return;
  }
  const int channels = robot_.colors.NumberOfChannels();
  if (table.channel >= channels) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "the camera of this robot has no channel %d to detect colours; it has %d, from 0 on",
            static_cast<int>(table.channel), channels);
    Refuse(CODE_REFUSED, text);
  } else if (robot_.colors.Load(table)) {
    outbox_.Colors().Drop();  // those that wait were detected with the earlier table
    Reply(NoPayload());
  } else {
    Refuse(CODE_REFUSED, "the robot's camera does not take this table; the robot's console says why");
  }
}

// Replaces colours that still wait.
void Version2::ColorsDetected(const ColorPlane& plane, unsigned image_count, unsigned frame) {
  if (plane.pixels == NULL) {
    if (outbox_.HasRoom()) {
      SwitchColors(false, client_.colors);
      SendError(0, CODE_NOT_SUPPORTED, "the images of this robot's camera have no plane with the colours detected");
    }
    return;
  }
  client_.has_pushed_colors = true;
  client_.last_colors = image_count;
  ColorRegions regions;
  regions.image_count = image_count;
  regions.frame_number = frame;
  regions.width = static_cast<unsigned short>(plane.width);
  regions.height = static_cast<unsigned short>(plane.height);
  regions.has_plane = client_.colors.with_plane && canPackPlane(plane);
  countColors(plane, robot_.colors.Loaded(), &regions);
  regions.plane = NULL;
  regions.plane_size = 0;
  size_t size = encode(regions, Payload());
  if (regions.has_plane) {
    size += packPlane(plane, Payload() + size);
  }
  outbox_.Colors().Set(message_, Frame(COLORS_PUSH, 0, 0, size));
}
