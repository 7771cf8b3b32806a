/// @file Version1Motions.h
/// Motions, for a client of version 1.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_MOTIONS_H
#define AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_MOTIONS_H

#include "protocol/request_reader.h"
#include "rcserver/motions/MotionCommands.h"
#include "rcserver/version1/Version1Replies.h"

/// Carries out `U`, `D` and `P`. Pure logic: no OPEN-R.
///
/// The content of an upload comes in as many pieces as TCP makes of it. It is collected in memory and stored when it is
/// whole, so that nothing is left of one that is cut off.
class Version1Motions {
 public:
  /// @param buffer for an upload, mtn::MAX_FILE_SIZE bytes, while version 1 is spoken. All must outlive this.
  Version1Motions(MotionCommands& motions, Version1Replies& replies, unsigned char* buffer);

  /// A new client: there is no upload.
  void Begin();

  /// Answers the request, unless it needs the memory stick, or begins an upload: these are answered when that is done.
  /// @return false if nothing was done because the request has to wait for the memory stick
  bool Execute(const protocol::Request& request);

  /// Answers the request that has been waiting for the memory stick.
  /// @param result that MotionCommands awaits
  void FileDone(const FileResult& result) { Answer(motions_.Finish(result)); }

  /// Takes what has come of the upload, if there is one.
  /// @return false if more of it is still to come
  bool TakeContent(protocol::RequestReader& reader);

 private:
  Version1Motions(const Version1Motions&);
  Version1Motions& operator=(const Version1Motions&);

  void BeginUpload(const protocol::MotionName& name, size_t size);
  void Play(const protocol::MotionName& name, unsigned short repetitions);
  void Answer(MotionCommands::Outcome outcome);

  MotionCommands& motions_;
  Version1Replies& replies_;
  unsigned char* const buffer_;
  bool is_uploading_;
  protocol::BasicGetCommand request_;  ///< that is being answered
  protocol::MotionName upload_name_;
  size_t uploaded_;  ///< bytes in the buffer
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_MOTIONS_H
