#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_STICK_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_STICK_REQUESTS_H

#include "protocol/motion_requests.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/requests/Exchange.h"
#include "rcserver/requests/FileOrder.h"

/// Carries out the requests that need the memory stick: for motions, and for pictures on it.
///
/// Only one of them may wait for the memory stick. So all others can be handled at once, above all orders to stop.
/// FileDone() answers the request that waits.
class StickRequests {
 public:
  StickRequests(MotionPlayer& player, FileOrder& files, ImageObserver& pictures, Exchange& exchange);

  /// Call this for a new client, none of whose requests waits.
  void Begin() { owes_file_ = false; }

  void StoreMotion();    ///< `U`
  void DeleteMotion();   ///< `D`
  void PlayMotion();     ///< `P`
  void ListMotions();    ///< `N`
  void SavePicture();    ///< `M`
  void HandlePicture();  ///< `Y`

  /// Ends a `P` whose file is being read. The memory stick stays busy.
  /// @param why the words after the name of the motion, as in "NOD.MTN ..."
  void EndWaitingMotion(const char* why);

  /// Answers the request that has been waiting for the memory stick.
  /// @param result the result that the FileOrder awaits
  /// @param now the present OPEN-R frame
  void FileDone(const FileResult& result, unsigned now);

  /// Call this when the picture of an order for the memory stick has been made.
  void PictureTaken(const unsigned char* jpeg, size_t size);

  /// True if the file of the last FileDone() must be sent, after EncodeFileHeader().
  bool OwesFile() const { return owes_file_; }

  /// Writes the header of the frame that carries the file. After this call, the file is not owed any more.
  /// @param[out] out room for FRAME_HEADER_SIZE bytes
  size_t EncodeFileHeader(size_t size, unsigned char* out);

 private:
  bool IsStickFree();
  bool LeavesOutMissingJoints() const;
  FileOrder::Outcome OrderPicture();
  void Answer(FileOrder::Outcome outcome);

  MotionPlayer& player_;
  FileOrder& files_;
  ImageObserver& pictures_;
  Exchange& exchange_;
  bool owes_file_;                           ///< pending_ must be answered with a file
  protocol::version2::FrameHeader pending_;  ///< the request that waits for the memory stick; kind 0: it has ended
  unsigned play_not_after_;                  ///< the last frame in which the `P` that waits may be carried out
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_STICK_REQUESTS_H
