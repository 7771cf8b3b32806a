/// @file PictureEncoder.h
#ifndef AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_ENCODER_H
#define AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_ENCODER_H

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <def.h>

#include "objects/RegionSender.h"
#include "picture_encoder/JpegEncoder.h"
#include "picture_encoder/PictureJob.h"

/// The OPEN-R object that makes JPEG files for RCServer, one at a time.
///
/// PictureEncoder is a separate object because encoding takes longer than a frame of the joints, and an object handles
/// one message at a time. RCServer has a higher scheduling class and interrupts it (PictureEncoder.ocf).
///
/// PictureEncoder asks for a job only when RCServer can take the picture.
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

  /// Called when RCServer can take a picture (gate Picture).
  void ReadyPicture(const OReadyEvent& event);

  /// Called when RCServer has sent a job (gate Job).
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
