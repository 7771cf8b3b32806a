#include "rcserver/camera/ColorTables.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>

using namespace protocol::version2;

namespace {

// The bit of a channel, in tables and in pixels.
unsigned char BitOf(int channel) {
  return static_cast<unsigned char>(1 << channel);
}

}  // namespace

ColorTables::ColorTables(CameraControl& camera, int channels)
    : camera_(camera), channels_(channels), loaded_(0), memory_(), vector_(NULL) {}

ColorTables::~ColorTables() {
  if (vector_ != NULL) {
    OPENR::DeleteCdtVectorData(memory_);
  }
}

bool ColorTables::Load(const ColorTable& table) {
  if (!camera_.Open() || !CreateVector()) {
    return false;
  }
  OCdtInfo* const info = vector_->GetInfo(0);
  info->Init(camera_.Id(), BitOf(table.channel));
  bool is_empty = true;
  for (int i = 0; i < COLOR_SEGMENTS; ++i) {
    const ColorSegment& segment = table.segments[i];
    info->Set(i, segment.cr_max, segment.cr_min, segment.cb_max, segment.cb_min);
    is_empty = is_empty && isEmpty(segment);
  }
  if (!Set(1)) {
    return false;
  }
  const int others = loaded_ & ~BitOf(table.channel);
  loaded_ = static_cast<unsigned char>(is_empty ? others : others | BitOf(table.channel));
  return true;
}

void ColorTables::ClientGone() {
  int count = 0;
  for (int channel = 0; channel < channels_; ++channel) {
    if ((loaded_ & BitOf(channel)) != 0) {
      vector_->GetInfo(count)->Init(camera_.Id(), BitOf(channel));
      ++count;
    }
  }
  if (count > 0 && Set(count)) {
    loaded_ = 0;
  }
}

bool ColorTables::CreateVector() {
  if (vector_ == NULL && OPENR::NewCdtVectorData(&memory_, &vector_) != oSUCCESS) {
    vector_ = NULL;
    OSYSLOG1((osyslogERROR, "RCServer: no memory for tables of the colour detection"));
  }
  return vector_ != NULL;
}

// Passes the first tables of the vector to the camera, which copies them.
bool ColorTables::Set(int number_of_tables) {
  vector_->SetNumData(static_cast<size_t>(number_of_tables));
  const OStatus status = OPENR::SetCdtVectorData(memory_);
  if (status != oSUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: the camera does not take a table of its colour detection (status %u)",
              static_cast<unsigned>(status)));
  }
  return status == oSUCCESS;
}
