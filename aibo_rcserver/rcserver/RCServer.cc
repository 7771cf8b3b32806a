#include "rcserver/RCServer.h"

#include <OPENR/OFbkImage.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

#include "protocol/version1.h"

namespace {

const longword FRAMES_PER_SECOND = 125;  // of 8 ms

// Puts the bands of the high-resolution layer together.
bool FindPlanes(OFbkImageVectorData* image_vector, CameraImage* image) {
  OFbkImageInfo* info = image_vector->GetInfo(ofbkimageLAYER_H);
  byte* data = image_vector->GetData(ofbkimageLAYER_H);
  OFbkImage y(info, data, ofbkimageBAND_Y);
  OFbkImage cr(info, data, ofbkimageBAND_Cr);
  OFbkImage cb(info, data, ofbkimageBAND_Cb);
  if (!y.IsValid() || !cr.IsValid() || !cb.IsValid()) {
    return false;
  }
  image->y = y.Pointer();
  image->cr = cr.Pointer();
  image->cb = cb.Pointer();
  image->width = static_cast<size_t>(y.Width());
  image->height = static_cast<size_t>(y.Height());
  image->stride = static_cast<size_t>(y.Width() + y.Skip());
  return true;
}

const char* ReasonOf(TCPEndpointError error) {
  switch (error) {
    case TCP_CONNECTION_CLOSED:
      return "it closed the connection";
    case TCP_CONNECTION_RESET:
      return "it broke the connection off";
    case TCP_CONNECTION_TIMEOUT:
      return "it cannot be reached";
    default:
      return "the IPStack failed";
  }
}

}  // namespace

const longword RCServer::SILENT_CLIENT_FRAMES;

RCServer::RCServer()
    : client_(NULL),
      now_(0),
      last_sign_of_life_(0),
      last_attempt_(0),
      stream_pictures_(0),
      images_left_out_(0),
      field_counter_(0) {}

OStatus RCServer::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  for (int i = 0; i < NUMBER_OF_CONNECTIONS; ++i) {
    if (!connections_[i].Create(myOID_)) {
      OSYSLOG1((osyslogERROR, "RCServer: no shared buffer for a connection"));
      return oFAIL;
    }
  }
  return oSUCCESS;
}

OStatus RCServer::DoStart(const OSystemEvent&) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  ListenWhereClosed();
  OSYSPRINT(("RCServer: waiting for a client on port %d\n", protocol::RCSERVER_PORT));
  return oSUCCESS;
}

OStatus RCServer::DoStop(const OSystemEvent&) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus RCServer::DoDestroy(const OSystemEvent&) {
  for (int i = 0; i < NUMBER_OF_CONNECTIONS; ++i) {
    connections_[i].Destroy();
  }
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void RCServer::Notify(const ONotifyEvent& event) {
  // OPEN-R gives the data as constant, and its own classes take it as not. Nothing is written here.
  OFbkImageVectorData* image_vector = static_cast<OFbkImageVectorData*>(const_cast<void*>(event.Data(0)));
  now_ = image_vector->GetInfo(ofbkimageLAYER_H)->frameNumber;
  if (now_ - last_attempt_ >= FRAMES_PER_SECOND) {
    ListenWhereClosed();
  }
  // What cannot be sent now is left out, never kept: the next picture shows what is then.
  if (client_ != NULL && !client_->IsSending()) {
    SendImage(image_vector);
  }
  observer[event.ObsIndex()]->AssertReady();
}

void RCServer::ListenCont(ANTENVMSG msg) {
  const TCPEndpointListenMsg* answer = static_cast<const TCPEndpointListenMsg*>(antEnvMsg::Receive(msg));
  Connection* connection = FindConnection(answer->continuation);
  if (connection == NULL || connection->GetState() != Connection::LISTENING) {
    return;
  }
  if (answer->error != TCP_SUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: cannot listen on port %d (error %d)", protocol::RCSERVER_PORT,
              static_cast<int>(answer->error)));
    connection->Close(true);
    return;
  }
  connection->Accepted(*answer);
  if (client_ == NULL) {
    Admit(connection);
  } else if (now_ - last_sign_of_life_ >= SILENT_CLIENT_FRAMES) {
    DropClient("it was silent and another one came", true);
    Admit(connection);
  } else {
    TurnAway(connection);
  }
}

void RCServer::SendCont(ANTENVMSG msg) {
  const TCPEndpointSendMsg* answer = static_cast<const TCPEndpointSendMsg*>(antEnvMsg::Receive(msg));
  if (client_ == NULL || FindConnection(answer->continuation) != client_) {
    return;
  }
  if (answer->error != TCP_SUCCESS) {
    DropClient(ReasonOf(answer->error), true);
    return;
  }
  client_->Sent();
  last_sign_of_life_ = now_;
  ContinueClient();
}

void RCServer::ReceiveCont(ANTENVMSG msg) {
  const TCPEndpointReceiveMsg* answer = static_cast<const TCPEndpointReceiveMsg*>(antEnvMsg::Receive(msg));
  if (client_ == NULL || FindConnection(answer->continuation) != client_) {
    return;
  }
  if (answer->error != TCP_SUCCESS) {
    DropClient(ReasonOf(answer->error), false);
    return;
  }
  last_sign_of_life_ = now_;
  client_->Received(*answer);
  protocol::Request request;
  while (client_->NextRequest(&request)) {
    HandleRequest(request);
  }
  ContinueClient();
}

void RCServer::CloseCont(ANTENVMSG msg) {
  const TCPEndpointCloseMsg* answer = static_cast<const TCPEndpointCloseMsg*>(antEnvMsg::Receive(msg));
  Connection* connection = FindConnection(answer->continuation);
  if (connection == NULL) {
    return;
  }
  connection->Closed();
  // Where nobody has come because listening failed, trying at once would fail again: Notify() tries later.
  if (connection->HadClient()) {
    ListenWhereClosed();
  }
}

void RCServer::ListenWhereClosed() {
  last_attempt_ = now_;
  for (int i = 0; i < NUMBER_OF_CONNECTIONS; ++i) {
    if (connections_[i].GetState() == Connection::CLOSED && !connections_[i].Listen(protocol::RCSERVER_PORT)) {
      OSYSLOG1((osyslogERROR, "RCServer: the IPStack has no endpoint to listen on port %d", protocol::RCSERVER_PORT));
    }
  }
}

Connection* RCServer::FindConnection(const void* continuation) {
  for (int i = 0; i < NUMBER_OF_CONNECTIONS; ++i) {
    if (connections_[i].Owns(continuation)) {
      return &connections_[i];
    }
  }
  return NULL;
}

void RCServer::Admit(Connection* newcomer) {
  client_ = newcomer;
  last_sign_of_life_ = now_;
  OSYSPRINT(("RCServer: client %s is connected\n", client_->ClientName()));
  ContinueClient();
}

void RCServer::TurnAway(Connection* newcomer) {
  OSYSPRINT(
      ("RCServer: %s is turned away: client %s is being served\n", newcomer->ClientName(), client_->ClientName()));
  newcomer->Close(false);
}

// Forgets the client with all that it left behind.
void RCServer::DropClient(const char* reason, bool abort) {
  OSYSPRINT(("RCServer: client %s is gone: %s\n", client_->ClientName(), reason));
  client_->Close(abort);
  client_ = NULL;
  image_observer_.ClientGone();
}

void RCServer::HandleRequest(const protocol::Request& request) {
  const unsigned char quality = protocol::limitJpegQuality(request.basic.identifier);
  if (request.valid && request.basic.command == protocol::REQUEST_PICTURE) {
    EndStoppedStream();
    if (image_observer_.RequestPicture(quality)) {
      return;
    }
  } else if (request.valid && request.basic.command == protocol::REQUEST_STREAM_TOGGLE) {
    ToggleStream(quality);
    return;
  }
  const protocol::ValueReply refusal = {protocol::REPLY_ERROR, 0, protocol::ERROR_REFUSED};
  client_->AddReply(refusal);
}

void RCServer::ToggleStream(unsigned char quality) {
  EndStoppedStream();
  image_observer_.ToggleStream(quality);
  if (image_observer_.State() == IOS_CONTINUOUS) {
    stream_pictures_ = 0;
    images_left_out_ = 0;
    OSYSPRINT(("RCServer: stream on, quality %d\n", static_cast<int>(quality)));
  }
}

// The stop code: runs once, when IOS_STOPSEND is about to be left.
void RCServer::EndStoppedStream() {
  if (image_observer_.State() == IOS_STOPSEND) {
    OSYSPRINT(
        ("RCServer: stream off after %lu pictures, %lu camera images left out\n", stream_pictures_, images_left_out_));
  }
}

void RCServer::SendImage(OFbkImageVectorData* image_vector) {
  EndStoppedStream();
  unsigned char quality = 0;
  if (!image_observer_.ImageArrived(&quality)) {
    return;
  }
  CameraImage image;
  if (!FindPlanes(image_vector, &image)) {
    OSYSLOG1((osyslogERROR, "RCServer: the camera image has no Y, Cr and Cb bands"));
    DropClient("there is no picture for it", true);
    return;
  }
  const size_t size = encoder_.Encode(image, quality, client_->PictureBuffer(), Connection::PICTURE_CAPACITY);
  if (size == 0) {
    OSYSLOG1((osyslogERROR, "RCServer: no picture: %s", encoder_.LastError()));
    DropClient("there is no picture for it", true);
    return;
  }
  CountStreamPicture(image);
  if (!client_->SendPicture(size)) {
    DropClient("the IPStack does not send", true);
  }
}

void RCServer::CountStreamPicture(const CameraImage& image) {
  if (image_observer_.State() != IOS_CONTINUOUS) {
    return;
  }
  const unsigned short field_counter = image.FieldCounter();
  if (stream_pictures_ > 0) {
    images_left_out_ += static_cast<unsigned short>(field_counter - field_counter_ - 1);
  }
  field_counter_ = field_counter;
  ++stream_pictures_;
}

void RCServer::ContinueClient() {
  if (!client_->Continue()) {
    DropClient("the IPStack does not go on", true);
  }
}
