#include "picture_encoder/PictureEncoder.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <string.h>

namespace {

CameraImage ImageIn(const PictureJob& job) {
  const CameraImage image = {job.pixels,
                             job.pixels + job.width,
                             job.pixels + 2 * job.width,
                             job.width,
                             job.height,
                             (job.is_double ? 6 : 3) * job.width};
  return image;
}

DetailBands DetailIn(const PictureJob& job) {
  const DetailBands detail = {job.pixels + 3 * job.width, job.pixels + 4 * job.width, job.pixels + 5 * job.width};
  return detail;
}

}  // namespace

const size_t EncodedPicture::MAX_PROBLEM_SIZE;

OStatus PictureEncoder::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  if (!pictures_.Create(subject[sbjPicture])) {
    OSYSLOG1((osyslogERROR, "PictureEncoder: no shared memory for a picture"));
    return oFAIL;
  }
  return oSUCCESS;
}

// The first job is not asked for here, but in ReadyPicture().
OStatus PictureEncoder::DoStart(const OSystemEvent&) {
  ENABLE_ALL_SUBJECT;
  return oSUCCESS;
}

OStatus PictureEncoder::DoStop(const OSystemEvent&) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus PictureEncoder::DoDestroy(const OSystemEvent&) {
  pictures_.Destroy();
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void PictureEncoder::ReadyPicture(const OReadyEvent& event) {
  if (event.IsAssert()) {
    observer[obsJob]->AssertReady();
  }
}

void PictureEncoder::NotifyJob(const ONotifyEvent& event) {
  Encode(*static_cast<const PictureJob*>(event.Data(0)), pictures_.Memory());
  pictures_.Send();
}

void PictureEncoder::Encode(const PictureJob& job, EncodedPicture* picture) {
  picture->ticket = job.ticket;
  picture->problem[0] = '\0';
  picture->quality = job.quality;
  picture->size = EncodeAt(job.quality, job, picture);
  if (picture->size == 0 && job.is_double && job.quality > CAREFUL_QUALITY) {
    picture->quality = CAREFUL_QUALITY;
    picture->size = EncodeAt(CAREFUL_QUALITY, job, picture);
  }
  if (picture->size == 0) {
    strncat(picture->problem, encoder_.LastError(), sizeof(picture->problem) - 1);
  }
}

size_t PictureEncoder::EncodeAt(int quality, const PictureJob& job, EncodedPicture* picture) {
  return job.is_double
             ? encoder_.EncodeDouble(ImageIn(job), DetailIn(job), quality, picture->jpeg, sizeof(picture->jpeg))
             : encoder_.Encode(ImageIn(job), quality, picture->jpeg, sizeof(picture->jpeg));
}
