#include "rcserver/camera/CameraControl.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/OSyslog.h>

using namespace protocol::version2;

namespace {

// The locator of the camera is the same on an ERS-7 and an ERS-210 (Model Information).
const char LOCATOR[] = "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1";
const int CAMERA = 0;

// The requests for each setting. Each automatic mode has one for off and one for on; others take the value.
const OPrimitiveRequest REQUESTS[NUMBER_OF_CAMERA_SETTINGS][2] = {
    {oprmreqCAM_SET_WHITE_BALANCE, oprmreqCAM_SET_WHITE_BALANCE},
    {oprmreqCAM_SET_GAIN, oprmreqCAM_SET_GAIN},
    {oprmreqCAM_SET_SHUTTER_SPEED, oprmreqCAM_SET_SHUTTER_SPEED},
    {oprmreqCAM_AE_OFF, oprmreqCAM_AE_ON},
    {oprmreqCAM_AWB_OFF, oprmreqCAM_AWB_ON}};

// The bit of a channel, in tables and in pixels.
unsigned char BitOf(int channel) {
  return static_cast<unsigned char>(1 << channel);
}

}  // namespace

CameraControl::CameraControl(int channels)
    : settings_(defaultCameraSettings()), channels_(channels), loaded_(0), memory_(), vector_(NULL) {}

CameraControl::~CameraControl() {
  if (vector_ != NULL) {
    OPENR::DeleteCdtVectorData(memory_);
  }
}

bool CameraControl::Open() {
  return camera_.IsOpen(CAMERA) || camera_.Open(CAMERA, "camera", LOCATOR);
}

OPrimitiveID CameraControl::Id() const {
  return camera_.Id(CAMERA);
}

bool CameraControl::Set(CameraSetting setting, unsigned char value) {
  if (!Open() || !Command(setting, value)) {
    return false;
  }
  settings_.values[setting - 1] = value;
  return true;
}

bool CameraControl::Load(const ColorTable& table) {
  if (!Open() || !CreateVector()) {
    return false;
  }
  OCdtInfo* const info = vector_->GetInfo(0);
  info->Init(Id(), BitOf(table.channel));
  bool is_empty = true;
  for (int i = 0; i < COLOR_SEGMENTS; ++i) {
    const ColorSegment& segment = table.segments[i];
    info->Set(i, segment.cr_max, segment.cr_min, segment.cb_max, segment.cb_min);
    is_empty = is_empty && isEmpty(segment);
  }
  if (!SetTables(1)) {
    return false;
  }
  const int others = loaded_ & ~BitOf(table.channel);
  loaded_ = static_cast<unsigned char>(is_empty ? others : others | BitOf(table.channel));
  return true;
}

void CameraControl::ClientGone() {
  const CameraSettings at_start = defaultCameraSettings();
  for (int i = NUMBER_OF_CAMERA_SETTINGS; i > 0; --i) {
    if (settings_.values[i - 1] != at_start.values[i - 1]) {
      Set(static_cast<CameraSetting>(i), at_start.values[i - 1]);
    }
  }
  int count = 0;
  for (int channel = 0; channel < channels_; ++channel) {
    if ((loaded_ & BitOf(channel)) != 0) {
      vector_->GetInfo(count)->Init(Id(), BitOf(channel));
      ++count;
    }
  }
  if (count > 0 && SetTables(count)) {
    loaded_ = 0;
  }
}

bool CameraControl::Command(CameraSetting setting, unsigned char value) {
  OPrimitiveControl_CameraParam param(value);
  const bool is_automatic = setting >= SETTING_AUTO_EXPOSURE;
  const OPrimitiveRequest request = REQUESTS[setting - 1][value != 0 ? 1 : 0];
  const OStatus status = is_automatic ? OPENR::ControlPrimitive(Id(), request, NULL, 0, NULL, 0)
                                      : OPENR::ControlPrimitive(Id(), request, &param, sizeof(param), NULL, 0);
  if (status != oSUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: the camera does not take the value %d of its setting %d (status %u)",
              static_cast<int>(value), static_cast<int>(setting), static_cast<unsigned>(status)));
  }
  return status == oSUCCESS;
}

bool CameraControl::CreateVector() {
  if (vector_ == NULL && OPENR::NewCdtVectorData(&memory_, &vector_) != oSUCCESS) {
    vector_ = NULL;
    OSYSLOG1((osyslogERROR, "RCServer: no memory for tables of the colour detection"));
  }
  return vector_ != NULL;
}

// Passes the first tables of the vector to the camera, which copies them.
bool CameraControl::SetTables(int number_of_tables) {
  vector_->SetNumData(static_cast<size_t>(number_of_tables));
  const OStatus status = OPENR::SetCdtVectorData(memory_);
  if (status != oSUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: the camera does not take a table of its colour detection (status %u)",
              static_cast<unsigned>(status)));
  }
  return status == oSUCCESS;
}
