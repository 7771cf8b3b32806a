/// @file RCServer.h
/// The OPEN-R object that lets one client at a time see what the robot sees.
#ifndef RCSERVER_RCSERVER_H
#define RCSERVER_RCSERVER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <ant.h>
#include <def.h>

#include "rcserver/Connection.h"
#include "rcserver/Session.h"
#include "rcserver/body/Body.h"
#include "rcserver/camera/CameraImage.h"
#include "rcserver/camera/JpegEncoder.h"
#include "rcserver/commands/Robot.h"
#include "rcserver/memory_stick/HostSettings.h"
#include "rcserver/memory_stick/MotionFiles.h"
#include "rcserver/memory_stick/Settings.h"

/// Serves the protocol (docs/protocol.md), versions 1 and 2, on TCP port 54321.
///
/// Everything happens in one of the entry points below, each of which returns without waiting. The robot's time is the
/// number of the frame, of 8 ms, in which joints were measured or the camera took an image last.
///
/// When the robot starts, all joints hold where they are, and LEDs and ears are left alone.
class RCServer : public OObject {
 public:
  /// A client of version 2 that has sent nothing for so many frames is dropped: 5 s.
  static const longword HEARTBEAT_FRAMES = 625;

  /// What servers started from now on find. For a computer that stands in for the robot.
  static void SetHost(const HostSettings& settings) { host = settings; }

  RCServer();
  virtual ~RCServer() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  /// A camera image is there (gate Image).
  void NotifyImage(const ONotifyEvent& event);

  /// Joints have been measured (gate Sensor).
  void NotifySensor(const ONotifyEvent& event);

  /// The robot takes one more command vector (gate Effector).
  void ReadyEffector(const OReadyEvent& event);

  /// @name Answers of the IPStack
  /// @{
  void ListenCont(ANTENVMSG msg);
  void SendCont(ANTENVMSG msg);
  void ReceiveCont(ANTENVMSG msg);
  void CloseCont(ANTENVMSG msg);
  /// @}

 private:
  // One for the client, one to turn the next one away, or to let it in when the first has gone silent.
  static const int NUMBER_OF_CONNECTIONS = 2;

  RCServer(const RCServer&);
  RCServer& operator=(const RCServer&);

  void PassTime(longword frame);
  void ListenWhereClosed();
  Connection* FindConnection(const void* continuation);
  void Admit(Connection* newcomer);
  void TurnAway(Connection* newcomer, const char* reason);
  void DropClient(const char* reason, bool abort);
  void ServeClient();
  bool SendOutput();
  void CountImage(OFbkImageVectorData* image_vector);
  void SendImage(OFbkImageVectorData* image_vector);
  void SendPicture(const CameraImage& image, const PictureOrder& order, longword frame);
  void CountStreamPicture();
  void ReportStream();

  static HostSettings host;

  Connection connections_[NUMBER_OF_CONNECTIONS];
  size_t endpoints_;    ///< numbers given so far
  Connection* client_;  ///< the connection that is served; NULL if there is none
  Body body_;
  MotionFiles motion_files_;
  Settings settings_;
  Robot* robot_;      ///< there is one from DoInit to DoDestroy, as there is a session
  Session* session_;  ///< with the client
  JpegEncoder encoder_;
  longword now_;
  longword last_bytes_received_;  ///< from the client
  longword last_sign_of_life_;    ///< of the client
  longword last_attempt_;         ///< to listen
  unsigned turned_away_;          ///< clients of whom the console has not been told
  longword last_told_turned_away_;
  bool is_streaming_;              ///< as far as the console has been told
  unsigned image_count_;           ///< the camera's own count, which has 16 bits, carried on to 32
  unsigned last_of_stream_;        ///< image_count_ of the last picture of the stream
  unsigned long stream_pictures_;  ///< sent in the current stream
  unsigned long images_left_out_;  ///< of the camera, in the current stream
};

#endif  // RCSERVER_RCSERVER_H
