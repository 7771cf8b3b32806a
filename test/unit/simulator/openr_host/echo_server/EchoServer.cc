#include "EchoServer.h"

#include <EndpointTypes.h>
#include <OPENR/OFbkImage.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

#include "entry.h"

static const int BUFFER_SIZE = 4096;

EchoServer::EchoServer() : ipstackRef("IPStack"), data(0) {}

OStatus EchoServer::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;

  antEnvCreateSharedBufferMsg bufferMsg(BUFFER_SIZE);
  bufferMsg.Call(ipstackRef, sizeof(bufferMsg));
  if (bufferMsg.error != ANT_SUCCESS) {
    return oFAIL;
  }
  buffer = bufferMsg.buffer;
  buffer.Map();
  data = static_cast<byte*>(buffer.GetAddress());

  char design[orobotdesignNAME_MAX + 1];
  OPENR::GetRobotDesign(design);
  OSYSPRINT(("EchoServer on %s\n", design));
  return oSUCCESS;
}

OStatus EchoServer::DoStart(const OSystemEvent&) {
  Listen();
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus EchoServer::DoStop(const OSystemEvent&) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus EchoServer::DoDestroy(const OSystemEvent&) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  OSYSPRINT(("EchoServer has gone\n"));
  return oSUCCESS;
}

void EchoServer::Notify(const ONotifyEvent& event) {
  const void* received = event.Data(0);
  OFbkImageVectorData* image = static_cast<OFbkImageVectorData*>(const_cast<void*>(received));
  OFbkImage luminance(image->GetInfo(ofbkimageLAYER_H), image->GetData(ofbkimageLAYER_H), ofbkimageBAND_Y);
  OSYSPRINT(("image %u\n", static_cast<unsigned>(luminance.FieldCounter())));
  observer[event.ObsIndex()]->AssertReady();
}

void EchoServer::Listen() {
  antEnvCreateEndpointMsg createMsg(EndpointType_TCP, BUFFER_SIZE);
  createMsg.Call(ipstackRef, sizeof(createMsg));
  endpoint = createMsg.moduleRef;

  TCPEndpointListenMsg listenMsg(endpoint, IP_ADDR_ANY, ECHO_PORT);
  listenMsg.Send(ipstackRef, myOID_, Extra_Entry[entryListenCont], sizeof(listenMsg));
}

void EchoServer::ListenCont(ANTENVMSG msg) {
  TCPEndpointListenMsg* listenMsg = static_cast<TCPEndpointListenMsg*>(antEnvMsg::Receive(msg));
  if (listenMsg->error != TCP_SUCCESS) {
    OSYSLOG1((osyslogERROR, "listen: %d", listenMsg->error));
    return;
  }
  Receive();
}

void EchoServer::Receive() {
  TCPEndpointReceiveMsg receiveMsg(endpoint, data, 1, BUFFER_SIZE);
  receiveMsg.Send(ipstackRef, myOID_, Extra_Entry[entryReceiveCont], sizeof(receiveMsg));
}

void EchoServer::ReceiveCont(ANTENVMSG msg) {
  TCPEndpointReceiveMsg* receiveMsg = static_cast<TCPEndpointReceiveMsg*>(antEnvMsg::Receive(msg));
  if (receiveMsg->error != TCP_SUCCESS) {
    Close();
    return;
  }
  TCPEndpointSendMsg sendMsg(endpoint, data, receiveMsg->sizeMin);
  sendMsg.Send(ipstackRef, myOID_, Extra_Entry[entrySendCont], sizeof(sendMsg));
}

void EchoServer::SendCont(ANTENVMSG msg) {
  TCPEndpointSendMsg* sendMsg = static_cast<TCPEndpointSendMsg*>(antEnvMsg::Receive(msg));
  if (sendMsg->error != TCP_SUCCESS) {
    Close();
    return;
  }
  Receive();
}

void EchoServer::Close() {
  TCPEndpointCloseMsg closeMsg(endpoint);
  closeMsg.Send(ipstackRef, myOID_, Extra_Entry[entryCloseCont], sizeof(closeMsg));
}

void EchoServer::CloseCont(ANTENVMSG) {
  Listen();
}
