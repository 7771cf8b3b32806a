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

#include "rcserver/CameraImage.h"
#include "rcserver/Connection.h"
#include "rcserver/ImageObserver.h"
#include "rcserver/JpegEncoder.h"

/// Serves version 1 of the protocol (docs/protocol.md) on TCP port 54321.
///
/// Everything happens in one of the entry points below, each of which returns without waiting. The robot's time is the
/// frame number of the camera image that came last, in frames of 8 ms.
class RCServer : public OObject {
 public:
  /// A client that has sent nothing for so many frames, and to whom no send was completed, is taken for dead as soon
  /// as another one wants its place: 10 s.
  static const longword SILENT_CLIENT_FRAMES = 1250;

  RCServer();
  virtual ~RCServer() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  /// A camera image is there (gate Image).
  void Notify(const ONotifyEvent& event);

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

  void ListenWhereClosed();
  Connection* FindConnection(const void* continuation);
  void Admit(Connection* newcomer);
  void TurnAway(Connection* newcomer);
  void DropClient(const char* reason, bool abort);
  void HandleRequest(const protocol::Request& request);
  void ToggleStream(unsigned char quality);
  void EndStoppedStream();
  void SendImage(OFbkImageVectorData* image_vector);
  void CountStreamPicture(const CameraImage& image);
  void ContinueClient();

  Connection connections_[NUMBER_OF_CONNECTIONS];
  Connection* client_;  ///< the connection that is served; NULL if there is none
  ImageObserver image_observer_;
  JpegEncoder encoder_;
  longword now_;                   ///< frame number of the latest camera image
  longword last_sign_of_life_;     ///< of the client
  longword last_attempt_;          ///< to listen
  unsigned long stream_pictures_;  ///< sent in the current stream
  unsigned long images_left_out_;  ///< of the camera, in the current stream
  unsigned short field_counter_;   ///< of the last picture sent
};

#endif  // RCSERVER_RCSERVER_H
