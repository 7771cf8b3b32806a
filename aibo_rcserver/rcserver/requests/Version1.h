#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_VERSION1_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_VERSION1_H

#include "protocol/request_reader.h"
#include "rcserver/Outbox.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/requests/FileOrder.h"
#include "rcserver/requests/Robot.h"
#include "rcserver/settings/Settings.h"

/// Carries out the requests of version 1 and answers them (docs/protocol.md).
///
/// TCP delivers an upload in pieces of any size. The pieces are collected in memory, and the file is stored when it is
/// complete, so an interrupted upload leaves nothing behind.
class Version1 {
 public:
  /// @param upload_buffer mtn::MAX_FILE_SIZE bytes, used only in version 1
  Version1(const Robot& robot, const Settings& settings, FileOrder& files, ImageObserver& pictures, Outbox& outbox,
           unsigned char* upload_buffer);

  /// Call this for a new client. No upload is under way, and the block that `S` reads holds all joints and sensors.
  void Begin();

  /// Carries out a request and adds at most one message to the outbox. TakeContent() answers an upload, and FileDone()
  /// answers a request that needs the memory stick. A request for a picture is answered by the picture.
  void Handle(const protocol::Request& request);

  /// Takes the received part of an upload. Call this before each request. It adds at most one message to the outbox:
  /// the answer to the upload.
  /// @return false if more of the upload is still to come
  bool TakeContent(protocol::RequestReader& reader);

  /// Answers the request that has been waiting for the memory stick.
  /// @param result the result that the FileOrder awaits
  void FileDone(const FileResult& result) { Answer(files_.Finish(result)); }

 private:
  static const int IDENTIFIERS = 256;

  int Identifier() const { return request_.basic.identifier; }
  bool IsWrite() const { return request_.payload_size > 0; }
  short Value() const { return protocol::decodeValue(request_.payload); }

  void Reply(short value);
  void Refuse(protocol::ErrorCode code);
  void Send(char letter, unsigned char identifier, short value);

  // Requests. They return false if the request has to be refused.
  bool Execute();
  bool MoveOrReadJoints();
  bool LimitJoint();
  bool ReadOrSelectValue();
  void ReadBlock();
  bool SetLeds();
  bool SetEars();
  bool GoOff(PowerOrder order, bool is_allowed);

  bool MayMove() const;
  bool HasFault(int joint);
  bool Measure(int identifier, short* value) const;

  bool IsForMotions() const;
  void HandleMotion();
  void BeginUpload(const protocol::MotionName& name, size_t size);
  void Answer(FileOrder::Outcome outcome);

  const Robot& robot_;
  const Settings& settings_;
  FileOrder& files_;
  ImageObserver& pictures_;
  Outbox& outbox_;
  protocol::Request request_;      ///< the one that is handled, or waits for its content or the memory stick
  bool is_left_out_[IDENTIFIERS];  ///< true: the value is not in the block that `S` reads
  unsigned char* const upload_buffer_;
  bool is_uploading_;
  protocol::MotionName upload_name_;
  size_t uploaded_;  ///< bytes of the upload in the buffer
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_VERSION1_H
