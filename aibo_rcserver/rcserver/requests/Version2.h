#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_VERSION2_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_VERSION2_H

#include "protocol/hello.h"
#include "rcserver/requests/CameraRequests.h"
#include "rcserver/requests/Exchange.h"
#include "rcserver/requests/MoveRequests.h"
#include "rcserver/requests/Robot.h"
#include "rcserver/requests/SoundRequests.h"
#include "rcserver/requests/StickRequests.h"
#include "rcserver/requests/TelemetryRequests.h"

/// Passes each request of version 2 to the class that carries it out, and lets each push its messages
/// (docs/protocol.md).
class Version2 {
 public:
  Version2(const Robot& robot, const Settings& settings, FileOrder& files, ImageObserver& pictures, Outbox& outbox);

  /// Call this for a new client, which gets no messages that it has not asked for.
  void Begin();

  /// Carries out a request and adds at most one reply to the outbox, after the ends that the request has caused.
  /// StickRequests::FileDone() answers a request that needs the memory stick, and the picture one for a picture.
  /// @param payload as many bytes as the header says
  /// @param now the present OPEN-R frame
  void Handle(const protocol::version2::FrameHeader& request, const unsigned char* payload, unsigned now);

  void RefuseTooLarge(const protocol::version2::FrameHeader& request);

  /// Tells the client why the robot goes off, if there is room in the outbox.
  void PushPowerOff(const char* reason);

  /// Pushes an empty `h`, if there is room in the outbox. The client answers at once.
  /// @return false if there is no room
  bool AskForSign();

  /// Pushes the reports of joints, motions, the walk and sounds, as far as the outbox has room.
  void PushReports();

  /// Call this when all joints have been measured. It pushes reports, and telemetry if it is due.
  /// @param frame the frame in which they were measured
  void Measured(unsigned frame);

  StickRequests& Stick() { return stick_; }
  CameraRequests& Camera() { return camera_; }
  SoundRequests& Sound() { return sound_; }

 private:
  Version2(const Version2&);
  Version2& operator=(const Version2&);

  struct Row {
    const protocol::version2::Request* request;
    void (Version2::*carry_out)();
  };
  static const Row ROWS[];

  bool Serves(const protocol::version2::Request& request) const;
  void TakePicture() { camera_.TakePicture(); }
  void StreamPictures() { camera_.Stream(); }
  void MoveJoints() { moves_.MoveJoints(); }
  void LimitSpeeds() { moves_.LimitSpeeds(); }
  void SetTelemetry() { telemetry_.SetPeriod(); }
  void SwitchMotors() { moves_.SwitchMotors(); }
  void Hold() { moves_.Hold(); }
  void SetCamera() { camera_.SetCamera(); }
  void DetectColors() { camera_.DetectColors(); }
  void SendDatagrams() { camera_.SendDatagrams(); }
  void PlayMotion() { stick_.PlayMotion(); }
  void ListMotions() { stick_.ListMotions(); }
  void HandleSound() { sound_.CarryOut(); }
  void Steer() { moves_.Steer(); }
  void TakePosture() { moves_.TakePosture(); }
  void StoreMotion() { stick_.StoreMotion(); }
  void DeleteMotion() { stick_.DeleteMotion(); }
  void SavePicture() { stick_.SavePicture(); }
  void HandlePicture() { stick_.HandlePicture(); }
  void SayHello();
  void SetLeds();
  void MoveEars();
  bool SetEar(int identifier, bool draw);
  void GoOff();

  const Robot& robot_;
  Exchange exchange_;
  StickRequests stick_;
  MoveRequests moves_;
  TelemetryRequests telemetry_;
  CameraRequests camera_;
  SoundRequests sound_;
  char capabilities_[protocol::version2::MAX_HELLO_TEXT_SIZE + 1];
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_VERSION2_H
