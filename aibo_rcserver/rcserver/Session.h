#ifndef AIBO_RCSERVER_RCSERVER_SESSION_H
#define AIBO_RCSERVER_RCSERVER_SESSION_H

#include <stddef.h>

#include "protocol/frame_reader.h"
#include "protocol/opening.h"
#include "protocol/request_reader.h"
#include "protocol/version2.h"
#include "rcserver/Outbox.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/requests/FileOrder.h"
#include "rcserver/requests/Robot.h"
#include "rcserver/requests/Version1.h"
#include "rcserver/requests/Version2.h"
#include "rcserver/settings/Settings.h"

/// Splits received bytes into requests, carries them out in the client's protocol version, and keeps the answers until
/// they can be sent. Its memory has a fixed size: while there is no room for an answer, requests wait and nothing more
/// is received.
///
/// FileDone() answers a request that needs the memory stick. Until then, other requests of version 2 are handled, but
/// requests of version 1 wait, so that their replies keep their order.
class Session {
 public:
  static const size_t INPUT_CAPACITY = protocol::RequestReader::MAX_APPENDED;

  /// Largest header of a picture or file, in either version.
  static const size_t MAX_PICTURE_HEADER_SIZE =
      protocol::version2::FRAME_HEADER_SIZE + protocol::version2::IMAGE_HEADER_SIZE;

  /// @param settings what clients may do
  /// @param newest_version newest version of the protocol that a client may ask for, 1 or 2
  Session(const Robot& robot, const Settings& settings, int newest_version);

  /// Begins a session with a new client, which speaks version 1 until it asks for version 2.
  void Begin();

  /// Ends the session of a client that is gone, and everything it has started: the camera idles, the joints hold, and
  /// LEDs are off.
  void End();

  /// True if bytes may be added: all requests have been handled.
  bool WantsInput() const { return !IsEnding() && !talk_.has_input; }

  /// Adds received bytes. Call it only if WantsInput().
  void AddInput(const unsigned char* bytes, size_t size);

  /// True if no client begins with the bytes that came first (Opening). No more requests are handled, and the
  /// connection must be dropped.
  bool IsWithStranger() const { return talk_.is_stranger || talk_.opening.verdict() == protocol::Opening::STRANGER; }

  bool HasRequested() const { return talk_.has_requested; }

  /// Handles requests while there is room for the answers. Call it after bytes were added or taken, and after a request
  /// has been answered.
  /// @param now the present OPEN-R frame
  void HandleRequests(unsigned now);

  /// Call this when FileKeeper has done a job. A result that no request waits for is ignored.
  /// @param now the present OPEN-R frame
  void FileDone(const FileResult& result, unsigned now);

  /// Ends the session because the robot goes off. A client of version 2 gets the reason.
  /// @param reason the reason in words
  void RobotGoesOff(const char* reason);

  /// Asks a client of version 2 for a sign of life: it answers an empty `h` at once.
  /// @return false if there is no room for the question
  bool AskForSign() { return version2_.AskForSign(); }

  /// Call this when all joints have been measured.
  /// @param frame the frame in which they were measured
  void Measured(unsigned frame);

  // What a client of version 2 has asked for: colours, sound, and a file that must be sent.
  CameraRequests& Camera() { return version2_.Camera(); }
  SoundRequests& Sound() { return version2_.Sound(); }
  StickRequests& Stick() { return version2_.Stick(); }

  bool HasOutput() const { return !outbox_.IsEmpty(); }

  /// Takes out all data to be sent, except pictures.
  /// @param[out] out room for Outbox::CAPACITY bytes
  size_t TakeOutput(unsigned char* out) { return outbox_.Take(out); }

  /// True if no more requests are handled: the client broke the protocol, or the robot is going off.
  bool IsEnding() const { return talk_.is_over || robot_.power_order != POWER_STAYS_ON; }

  /// True if the connection must be closed after the output has been sent: the session IsEnding(), and no answer
  /// depends on the memory stick.
  bool IsOver() const { return talk_.is_over || (IsEnding() && !files_.IsPending()); }

  const char* EndReason() const { return talk_.is_over ? "it broke the protocol" : talk_.power_reason; }

  /// True if a client that is silent has to be dropped, as in version 2.
  bool ExpectsHeartbeat() const { return talk_.version == protocol::version2::VERSION; }

  ImageObserver& Pictures() { return pictures_; }

  /// Writes the bytes that precede a picture, in the client's version.
  /// @param[out] out room for MAX_PICTURE_HEADER_SIZE bytes
  /// @return the number of bytes
  size_t EncodePictureHeader(const PictureOrder& order, const protocol::version2::ImageHeader& image, size_t jpeg_size,
                             unsigned char* out) const;

 private:
  bool MayHandle();
  bool HandleRequest();
  bool MayBeHttp();
  bool AsksForVersion2() const;
  void ChangeToVersion2();
  bool HandleFrame(unsigned now);

  // What belongs to the session with one client.
  struct Talk {
    Talk()
        : version(1),
          is_over(false),
          power_reason("it switched the robot off"),
          is_stranger(false),
          has_requested(false),
          request(),
          has_request(false),
          has_input(false) {}

    int version;
    bool is_over;
    const char* power_reason;  ///< why the robot goes off
    protocol::Opening opening;
    bool is_stranger;
    bool has_requested;
    protocol::RequestReader input;  ///< used in both versions
    protocol::Request request;
    bool has_request;  ///< the request waits until it is clear that it is not HTTP
    bool has_input;    ///< there are unhandled bytes, possibly complete requests
  };

  const Robot robot_;
  const int newest_version_;
  ImageObserver pictures_;
  FileOrder files_;
  Outbox outbox_;
  Version1 version1_;
  Version2 version2_;
  Talk talk_;
  unsigned char payload_[protocol::version2::MAX_PAYLOAD_TOWARDS_ROBOT];  ///< in version 1: the content of an upload
  protocol::version2::FrameReader frame_reader_;
};

#endif  // AIBO_RCSERVER_RCSERVER_SESSION_H
