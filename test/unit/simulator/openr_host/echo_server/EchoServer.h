/// @file EchoServer.h
/// An object written for the robot, in C++98 with only the SDK's names. It prints a line for every camera image, and
/// sends back everything that a client sends to its port.
#ifndef TEST_UNIT_SIMULATOR_OPENR_HOST_ECHO_SERVER_ECHO_SERVER_H
#define TEST_UNIT_SIMULATOR_OPENR_HOST_ECHO_SERVER_ECHO_SERVER_H

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <TCPEndpointMsg.h>
#include <ant.h>

#include "def.h"

const Port ECHO_PORT = 7000;

class EchoServer : public OObject {
 public:
  EchoServer();

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Notify(const ONotifyEvent& event);
  void ListenCont(ANTENVMSG msg);
  void ReceiveCont(ANTENVMSG msg);
  void SendCont(ANTENVMSG msg);
  void CloseCont(ANTENVMSG msg);

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

 private:
  void Listen();
  void Receive();
  void Close();

  antStackRef ipstackRef;
  antModuleRef endpoint;
  antSharedBuffer buffer;
  byte* data;
};

#endif  // TEST_UNIT_SIMULATOR_OPENR_HOST_ECHO_SERVER_ECHO_SERVER_H
