/// @file PictureEncoder.h
/// The OPEN-R object that makes JPEG files of camera images for RCServer.
#ifndef AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_ENCODER_H
#define AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_ENCODER_H

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <def.h>

#include "objects/RegionSender.h"
#include "picture_encoder/JpegEncoder.h"
#include "picture_encoder/PictureJob.h"

/// Encodes one picture at a time.
///
/// This is a separate object because encoding takes longer than a frame of the joints, and an object handles one
/// message at a time. Its scheduling class is below RCServer's (PictureEncoder.ocf), so RCServer interrupts it.
///
/// It asks for a job only when RCServer is ready for the picture, so there is always room for the picture.
class PictureEncoder : public OObject {
 public:
  PictureEncoder() {}
  virtual ~PictureEncoder() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  /// RCServer is ready for a picture (gate Picture).
  void ReadyPicture(const OReadyEvent& event);

  /// RCServer has sent a job (gate Job).
  void NotifyJob(const ONotifyEvent& event);

 private:
  PictureEncoder(const PictureEncoder&);
  PictureEncoder& operator=(const PictureEncoder&);

  void Encode(const PictureJob& job, EncodedPicture* picture);
  size_t EncodeAt(int quality, const PictureJob& job, EncodedPicture* picture);

  JpegEncoder encoder_;
  RegionSender<EncodedPicture> pictures_;
};

#endif  // AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_ENCODER_H
