#ifndef AIBO_RCSERVER_RCSERVER_RCSERVER_H
#define AIBO_RCSERVER_RCSERVER_RCSERVER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <ant.h>
#include <def.h>

#include "rcserver/Connection.h"
#include "rcserver/FrameClock.h"
#include "rcserver/Interval.h"
#include "rcserver/PowerDown.h"
#include "rcserver/ReportLimit.h"
#include "rcserver/Session.h"
#include "rcserver/body/Body.h"
#include "rcserver/camera/PictureDatagrams.h"
#include "rcserver/camera/PictureTaker.h"
#include "rcserver/requests/FileJobs.h"
#include "rcserver/settings/Settings.h"

/// Serves the protocol (docs/protocol.md), versions 1 and 2, on TCP port 54321.
///
/// All work happens in the entry points below. They return without waiting, because no joint is commanded while one of
/// them runs. Two objects of a lower scheduling class do the work that takes longer than a frame: PictureEncoder
/// encodes pictures, and FileKeeper reads and writes files.
///
/// This object also processes sound, because a sound vector takes at most 0.2 ms. PictureEncoder could not deliver the
/// speaker's next vector within 32 ms while it encodes a picture.
///
/// Time is counted in OPEN-R frames of 8 ms: the frame of the latest camera image or joint measurement.
///
/// When the robot starts, all joints hold their positions, unless RCSERVER.CFG keeps the motors off. LEDs and ears are
/// not commanded.
///
/// The pause button cuts the motors and shuts the robot down. A low battery makes the robot lie down first
/// (PowerDown.h). While the robot walks or takes a posture, the pause button, too, makes it lie down first, because
/// it would fall without its motors. A second press cuts the motors.
class RCServer : public OObject {
 public:
  /// A client of version 2 that has sent nothing for this many frames is dropped: 5 s.
  static const longword HEARTBEAT_FRAMES = 625;

  /// A client that has not sent a whole request within this many frames loses its place if another one connects: 2 s.
  static const longword FIRST_REQUEST_FRAMES = 250;

  /// A client of version 2 is asked for a sign when a newcomer from its address has sent a request. If it sends nothing
  /// for this many frames, it loses its place: 0.3 s, our choice. In this case, a radio outage has usually ended the
  /// client's connection. Over a slow link, the question may arrive late. So the time begins again whenever the client
  /// has taken bytes that waited in the IPStack.
  static const longword SIGN_FRAMES = 38;

  /// Pictures wait for sound no longer than this many frames after the last picture: 0.25 s. Clients give up a robot
  /// that streams and sends no picture for 0.5 s.
  static const longword LONGEST_PICTURE_WAIT = 31;

  /// A newcomer that may take the client's place gets this many frames for its first request: 0.5 s. Clients send the
  /// request at once, so this only has to cover network delay.
  static const longword INTRODUCTION_FRAMES = 63;

  RCServer();
  virtual ~RCServer() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  /// The camera has taken an image (gate Image).
  void NotifyImage(const ONotifyEvent& event);

  /// PictureEncoder has made a picture, or failed to (gate Picture).
  void NotifyPicture(const ONotifyEvent& event);

  /// PictureEncoder is ready for an image (gate EncodeJob).
  void ReadyEncodeJob(const OReadyEvent& event);

  /// FileKeeper has done a job (gate FileResult).
  void NotifyFileResult(const ONotifyEvent& event);

  /// FileKeeper is ready for a job (gate FileJob).
  void ReadyFileJob(const OReadyEvent& event);

  /// Joints have been measured (gate Sensor).
  void NotifySensor(const ONotifyEvent& event);

  /// The robot is ready for one more command vector (gate Effector).
  void ReadyEffector(const OReadyEvent& event);

  /// The microphone has heard something (gate Microphone).
  void NotifyMicrophone(const ONotifyEvent& event);

  /// The robot is ready for one more sound vector (gate Speaker).
  void ReadySpeaker(const OReadyEvent& event);

  /// The power status has changed (OPENR::ObservePowerStatus()).
  void PowerChanged(ANTENVMSG msg);

  // Answers of the IPStack.
  void ListenCont(ANTENVMSG msg);
  void SendCont(ANTENVMSG msg);
  void ReceiveCont(ANTENVMSG msg);
  void CloseCont(ANTENVMSG msg);
  void DatagramCont(ANTENVMSG msg);
  void StatusCont(ANTENVMSG msg);

 private:
  // One connection serves the client. The other accepts a newcomer, to turn it away or to let it replace a silent
  // client.
  static const int NUMBER_OF_CONNECTIONS = 2;

  bool CreateRegions();
  void ObservePower();
  void GoOff(const char* reason);
  void PassTime(longword frame);
  void CheckClient();
  bool IsClientSilent() const;
  longword Now() const { return clock_.Last(); }  ///< the last frame in which something was taken or measured
  unsigned PresentFrame() { return clock_.Present(SystemMilliseconds()); }
  void ListenWhereClosed();
  Connection* FindConnection(const void* continuation);
  void Admit(Connection* newcomer);
  void NewcomerReceived(const TCPEndpointReceiveMsg& answer);
  void CheckNewcomer();
  void TurnAwayByAddress(Connection* newcomer);
  void TurnAwayWhileBusy(Connection* newcomer);
  void CloseNewcomer(Connection* newcomer, bool abort);
  void TurnAway(Connection* newcomer, const char* reason);
  void AbortStranger(Connection* stranger);
  void DropClient(const char* reason, bool abort);
  void ForgetClient();
  void ServeClient();
  bool SendOutput();
  bool SendPicture(const PictureOrder& order, const protocol::version2::ImageHeader& image, const byte* jpeg,
                   size_t size);
  bool SendContent(size_t header_size, const byte* content, size_t size);
  void DropWithoutPicture(const char* problem);
  bool IsSendingPicture() const;
  bool SoundGoesFirst() const;
  void BeginPicture();

  Connection connections_[NUMBER_OF_CONNECTIONS];
  size_t endpoints_;         ///< number of endpoints created so far
  Connection* client_;       ///< the client's connection; NULL without a client
  Connection* newcomer_;     ///< the newcomer that waits beside a client; NULL if none waits
  longword newcomer_since_;  ///< frame in which the newcomer came, or the client was asked
  bool has_asked_;           ///< the newcomer has sent a request, and the client was asked for a sign
  Body* body_;               ///< exists from DoInit to DoDestroy
  FrameClock clock_;
  FileDesk file_desk_;
  PowerDown power_down_;
  HeldRegion<FileResult> file_;  ///< the file that is sent to the client
  PictureTaker pictures_;
  PictureDatagrams datagrams_;
  ReportLimit reports_;  ///< limits reports on clients that connect and leave
  Settings settings_;
  Session* session_;          ///< exists from DoInit to DoDestroy
  longword last_picture_;     ///< when the last picture was sent
  longword last_not_over_;    ///< last frame in which the session was not over
  Interval listen_interval_;  ///< attempts to listen
};

#endif  // AIBO_RCSERVER_RCSERVER_RCSERVER_H
