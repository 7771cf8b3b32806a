/// @file Version2Commands.h
/// What the server does for a client of version 2.
#ifndef RCSERVER_VERSION2_COMMANDS_H
#define RCSERVER_VERSION2_COMMANDS_H

#include "protocol/hello.h"
#include "protocol/version2.h"
#include "rcserver/ImageObserver.h"
#include "rcserver/JointControl.h"
#include "rcserver/Motors.h"
#include "rcserver/Outbox.h"

/// Carries out the requests of version 2, answers them and pushes telemetry (docs/protocol.md). Pure logic: no OPEN-R.
class Version2Commands {
 public:
  /// @param design of the robot, as OPEN-R names it. All must outlive this.
  Version2Commands(const char* design, JointControl& joints, Motors& motors, ImageObserver& camera, Outbox& outbox);

  /// A new client: no telemetry.
  void Begin();

  /// Adds one message to the outbox, unless the request is for a picture, which is the answer.
  /// @param now OPEN-R frame
  void Handle(const protocol::version2::FrameHeader& request, const unsigned char* payload, unsigned now);

  /// Answers a request by an error.
  /// @param text a reason in words
  void Refuse(const protocol::version2::FrameHeader& request, unsigned short code, const char* text);

  /// All joints have been measured.
  /// @param frame in which
  void Measured(unsigned frame);

 private:
  Version2Commands(const Version2Commands&);
  Version2Commands& operator=(const Version2Commands&);

  // Each answers its request. `payload` is as many bytes as the request's header says.
  typedef protocol::version2::FrameHeader Request;
  void Greet(const Request& request, unsigned now);
  void TakePicture(const Request& request, const unsigned char* payload);
  void Stream(const Request& request, const unsigned char* payload);
  void MoveJoints(const Request& request, const unsigned char* payload);
  void LimitSpeeds(const Request& request, const unsigned char* payload);
  void SetTelemetryPeriod(const Request& request, const unsigned char* payload);
  void SwitchMotors(const Request& request, const unsigned char* payload);

  void RefuseBadRequest(const Request& request, const char* problem);
  void RefuseUnknownKind(const Request& request);
  void RefuseUnknownJoint(const Request& request, unsigned char identifier);
  bool TakesLayer(const Request& request, protocol::version2::Layer layer);
  void Reply(const Request& request, size_t payload_size);
  void PushFaults();
  void PushTelemetry(unsigned frame);
  unsigned char* Payload() { return message_ + protocol::version2::FRAME_HEADER_SIZE; }

  const char* const design_;
  JointControl& joints_;
  Motors& motors_;
  ImageObserver& camera_;
  Outbox& outbox_;
  unsigned short telemetry_period_;                  ///< in frames; 0: none
  bool has_pushed_telemetry_;                        ///< since the period was set
  unsigned last_telemetry_;                          ///< frame
  unsigned char message_[Outbox::MAX_MESSAGE_SIZE];  ///< in the making
};

#endif  // RCSERVER_VERSION2_COMMANDS_H
