#include "rcserver/RCServer.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

#include <entry.h>
#include <stdio.h>
#include <string.h>

#include <algorithm>

#include "objects/HostSettings.h"
#include "protocol/opening.h"
#include "protocol/version1.h"

namespace {

const longword FRAMES_PER_SECOND = 125;  // of 8 ms

// OPEN-R passes event data as const, but its own classes need a non-const pointer. The data is not modified.
template <typename Vector>
Vector* VectorOf(const ONotifyEvent& event, int number = 0) {
  return static_cast<Vector*>(const_cast<void*>(event.Data(number)));
}

}  // namespace

const longword RCServer::HEARTBEAT_FRAMES;
const longword RCServer::FIRST_REQUEST_FRAMES;
const longword RCServer::SIGN_FRAMES;
const longword RCServer::LONGEST_PICTURE_WAIT;
const longword RCServer::INTRODUCTION_FRAMES;

RCServer::RCServer()
    : endpoints_(0),
      client_(NULL),
      newcomer_(NULL),
      newcomer_since_(0),
      has_asked_(false),
      body_(NULL),
      power_down_(file_desk_),
      session_(NULL),
      last_picture_(0),
      last_not_over_(0),
      listen_interval_(FRAMES_PER_SECOND) {}

OStatus RCServer::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  if (!CreateRegions()) {
    return oFAIL;
  }
  body_ = new Body();
  power_down_.Begin(body_);
  body_->Start(subject[sbjEffector], subject[sbjSpeaker]);  // the gates may be ready before DoStart()
  settings_ = readSettingsFile(hostSettings());
  const Robot robot = {body_->Design(), body_->Joints(),     body_->Motors(),  body_->Sensors(),
                       body_->Lights(), body_->Camera(),     body_->Hearing(), body_->Voice(),
                       datagrams_,      power_down_.Order(), file_desk_,       clock_};
  session_ = new Session(robot, settings_, hostSettings().newest_version);
  return oSUCCESS;
}

OStatus RCServer::DoStart(const OSystemEvent&) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  body_->Hearing().Start(observer[obsMicrophone]);
  if (settings_.motors_at_boot) {
    body_->Motors().Switch(true);
  } else {
    OSYSPRINT(("RCServer: the motors stay off until a client switches them on (MOTORS_AT_BOOT in RCSERVER.CFG)\n"));
  }
  body_->SendCommands();
  ListenWhereClosed();
  OSYSPRINT(("RCServer: waiting for a client on port %d\n", protocol::RCSERVER_PORT));
  ObservePower();
  return oSUCCESS;
}

OStatus RCServer::DoStop(const OSystemEvent&) {
  power_down_.Unobserve();
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus RCServer::DoDestroy(const OSystemEvent&) {
  for (int i = 0; i < NUMBER_OF_CONNECTIONS; ++i) {
    connections_[i].Destroy();
  }
  delete session_;
  session_ = NULL;
  file_.Destroy();
  file_desk_.Destroy();
  datagrams_.Destroy();
  pictures_.Destroy();
  delete body_;
  body_ = NULL;
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void RCServer::NotifyImage(const ONotifyEvent& event) {
  OFbkImageVectorData* image_vector = VectorOf<OFbkImageVectorData>(event);
  PassTime(image_vector->GetInfo(ofbkimageLAYER_H)->frameNumber);
  pictures_.CountImage(image_vector);
  session_->Pictures().SetHasDetail(PictureTaker::HasDetail(image_vector));
  if (client_ != NULL && pictures_.HasRoom()) {
    const char* const problem =
        pictures_.Offer(image_vector, session_->Pictures(), !IsSendingPicture(), body_->Camera().Settings());
    if (problem != NULL) {
      DropWithoutPicture(problem);
    }
    BeginPicture();
  }
  if (client_ != NULL && session_->Camera().WantsColors(pictures_.ImageCount())) {
    session_->Camera().ColorsDetected(PictureTaker::FindColorPlane(image_vector), pictures_.ImageCount(),
                                      image_vector->GetInfo(ofbkimageLAYER_H)->frameNumber);
    ServeClient();
  }
  observer[event.ObsIndex()]->AssertReady();
}

void RCServer::NotifyPicture(const ONotifyEvent& event) {
  if (!pictures_.Take(event, observer[event.ObsIndex()])) {
    return;
  }
  const EncodedPicture& picture = pictures_.Picture();
  if (picture.size == 0) {
    DropWithoutPicture(picture.problem);
    return;
  }
  if (pictures_.Order().purpose == PictureOrder::FOR_STICK) {
    session_->Stick().PictureTaken(picture.jpeg, picture.size);
    pictures_.DropPicture();
  } else if (datagrams_.IsOn() && pictures_.Order().purpose == PictureOrder::FOR_STREAM &&
             session_->Pictures().Wants(pictures_.Order())) {
    last_picture_ = Now();
    datagrams_.Send(pictures_.Header(), picture.jpeg, picture.size, Now());
    pictures_.DropPicture();
  }
  ServeClient();
}

void RCServer::ReadyEncodeJob(const OReadyEvent&) {
  BeginPicture();
}

void RCServer::NotifyFileResult(const ONotifyEvent& event) {
  file_.Hold(event, observer[event.ObsIndex()]);
  session_->FileDone(file_.Get(), PresentFrame());
  if (!session_->Stick().OwesFile()) {
    file_.Release();
  }
  ServeClient();
}

void RCServer::ReadyFileJob(const OReadyEvent&) {
  file_desk_.SendJob();
}

void RCServer::NotifySensor(const ONotifyEvent& event) {
  longword frame = 0;
  if (body_->ReadSensors(VectorOf<OSensorFrameVectorData>(event), &frame)) {
    PassTime(frame);
    session_->Measured(frame);
  }
  ServeClient();
  body_->SendCommands();
  observer[event.ObsIndex()]->AssertReady();
}

void RCServer::ReadyEffector(const OReadyEvent& event) {
  if (event.IsAssert()) {
    body_->EffectorIsReady();
  }
}

void RCServer::NotifyMicrophone(const ONotifyEvent& event) {
  for (int i = 0; i < event.NumOfData() && client_ != NULL; ++i) {
    session_->Sound().Heard(VectorOf<OSoundVectorData>(event, i));
  }
  ServeClient();
  body_->Hearing().AskForMore();
}

void RCServer::ReadySpeaker(const OReadyEvent& event) {
  if (!event.IsAssert()) {
    return;
  }
  body_->Voice().IsReady();
  ServeClient();
}

void RCServer::PowerChanged(ANTENVMSG msg) {
  const OPowerStatusMessage* message = static_cast<const OPowerStatusMessage*>(msg);
  GoOff(power_down_.Look(message->powerStatus));
}

void RCServer::ListenCont(ANTENVMSG msg) {
  const TCPEndpointListenMsg* answer = static_cast<const TCPEndpointListenMsg*>(antEnvMsg::Receive(msg));
  Connection* connection = FindConnection(answer->continuation);
  if (connection == NULL || !connection->IsListening()) {
    return;
  }
  if (answer->error != TCP_SUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: cannot listen on port %d (error %d)", protocol::RCSERVER_PORT,
              static_cast<int>(answer->error)));
    connection->Close(true);
    return;
  }
  connection->Accepted(*answer);
  if (!settings_.allowed_addresses.Allow(connection->ClientAddress())) {
    TurnAwayByAddress(connection);
  } else if (client_ == NULL || power_down_.IsOrdered()) {
    Admit(connection);
  } else if (connection->Receive()) {
    newcomer_ = connection;
    newcomer_since_ = Now();
    has_asked_ = false;
  } else {
    TurnAwayWhileBusy(connection);
  }
}

void RCServer::SendCont(ANTENVMSG msg) {
  const TCPEndpointSendMsg* answer = static_cast<const TCPEndpointSendMsg*>(antEnvMsg::Receive(msg));
  if (client_ == NULL || FindConnection(answer->continuation) != client_) {
    return;
  }
  if (answer->error != TCP_SUCCESS) {
    DropClient(Connection::ReasonOf(answer->error), true);
    return;
  }
  if (!client_->Sent()) {
    DropClient("the IPStack does not send", true);
    return;
  }
  ServeClient();
  BeginPicture();
}

void RCServer::ReceiveCont(ANTENVMSG msg) {
  const TCPEndpointReceiveMsg* answer = static_cast<const TCPEndpointReceiveMsg*>(antEnvMsg::Receive(msg));
  Connection* connection = FindConnection(answer->continuation);
  if (connection != NULL && connection == newcomer_) {
    NewcomerReceived(*answer);
    return;
  }
  if (client_ == NULL || connection != client_) {
    return;
  }
  if (answer->error != TCP_SUCCESS) {
    // If the client has closed in an orderly way, the connection is closed in the same way, which takes no time.
    DropClient(Connection::ReasonOf(answer->error), answer->error != TCP_CONNECTION_CLOSED);
    return;
  }
  client_->Received(static_cast<size_t>(answer->sizeMin));
  if (newcomer_ != NULL && has_asked_) {
    TurnAwayWhileBusy(newcomer_);
  }
  ServeClient();
}

void RCServer::CloseCont(ANTENVMSG msg) {
  const TCPEndpointCloseMsg* answer = static_cast<const TCPEndpointCloseMsg*>(antEnvMsg::Receive(msg));
  Connection* connection = FindConnection(answer->continuation);
  if (connection == NULL) {
    return;
  }
  connection->Closed();
  // A new attempt to listen is left to PassTime(): if listening has failed, it would fail again now.
  if (connection->HadClient()) {
    ListenWhereClosed();
  }
}

void RCServer::DatagramCont(ANTENVMSG msg) {
  datagrams_.Sent(*static_cast<const UDPEndpointSendMsg*>(antEnvMsg::Receive(msg)));
  BeginPicture();
}

void RCServer::StatusCont(ANTENVMSG msg) {
  datagrams_.Received(*static_cast<const UDPEndpointReceiveMsg*>(antEnvMsg::Receive(msg)));
}

bool RCServer::CreateRegions() {
  bool succeeds =
      datagrams_.Create(myOID_) && pictures_.Create(subject[sbjEncodeJob]) && file_desk_.Create(subject[sbjFileJob]);
  for (int i = 0; i < NUMBER_OF_CONNECTIONS; ++i) {
    succeeds = connections_[i].Create(myOID_) && succeeds;
  }
  if (!succeeds) {
    OSYSLOG1((osyslogERROR, "RCServer: no shared memory for connections, images and files"));
  }
  return succeeds;
}

void RCServer::ObservePower() {
  if (!settings_.power_monitor) {
    OSYSPRINT(("RCServer: pause button and battery are left to POWERMON.BIN (POWER_MONITOR in RCSERVER.CFG)\n"));
    return;
  }
  GoOff(power_down_.Observe(OServiceEntry(myOID_, Extra_Entry[entryPowerChanged])));
}

// Tells the client why the robot goes off. DropClient() then carries out the order. A reason of NULL changes nothing.
void RCServer::GoOff(const char* reason) {
  if (reason == NULL) {
    return;
  }
  if (client_ == NULL) {
    power_down_.CarryOut(Now());
    return;
  }
  session_->RobotGoesOff(reason);
  ServeClient();
}

void RCServer::PassTime(longword frame) {
  clock_.Report(frame, SystemMilliseconds());
  for (int i = 0; i < NUMBER_OF_CONNECTIONS; ++i) {
    connections_[i].PassTime(Now());
  }
  if (listen_interval_.Chooses(Now())) {
    ListenWhereClosed();
  }
  CheckNewcomer();
  if (client_ != NULL) {
    CheckClient();
  } else {
    power_down_.CarryOut(Now());
  }
}

// A silent client of version 1 may be alive or lost. So its motions end, and it loses its place if another client
// connects.
void RCServer::CheckClient() {
  if (power_down_.IsOverdue(Now())) {
    DropClient(session_->EndReason(), true);
    return;
  }
  if (!session_->IsOver()) {
    last_not_over_ = Now();
  } else if (Now() - last_not_over_ >= FRAMES_PER_SECOND) {
    DropClient(session_->EndReason(), true);
    return;
  }
  if (session_->ExpectsHeartbeat() && client_->FramesWithoutBytes() >= HEARTBEAT_FRAMES) {
    DropClient("it has been silent for 5 s", true);
    return;
  }
  if (IsClientSilent()) {
    body_->Joints().Motions().EndRepetitions();
  }
}

// A client that has not sent a whole request may be any program, so it gets less time, whatever bytes it sends.
bool RCServer::IsClientSilent() const {
  if (!session_->HasRequested() && client_->FramesConnected() >= FIRST_REQUEST_FRAMES) {
    return true;
  }
  return client_->FramesWithoutSign() >= settings_.silent_client_seconds * FRAMES_PER_SECOND;
}

void RCServer::ListenWhereClosed() {
  for (int i = 0; i < NUMBER_OF_CONNECTIONS; ++i) {
    if (connections_[i].IsClosed() && !connections_[i].Listen(protocol::RCSERVER_PORT, ++endpoints_)) {
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

// Makes the newcomer the client, unless the robot goes off.
void RCServer::Admit(Connection* newcomer) {
  if (power_down_.IsOrdered()) {
    TurnAway(newcomer, "the robot goes off");
    return;
  }
  if (newcomer == newcomer_) {
    newcomer_ = NULL;
  }
  client_ = newcomer;
  last_not_over_ = Now();
  session_->Begin();
  datagrams_.ClientConnected(client_->ClientAddress());
  ServeClient();
}

// Handles a newcomer that has sent something or has gone. Further bytes are read after it has become the client.
void RCServer::NewcomerReceived(const TCPEndpointReceiveMsg& answer) {
  if (answer.error != TCP_SUCCESS) {
    CloseNewcomer(newcomer_, answer.error != TCP_CONNECTION_CLOSED);
    return;
  }
  newcomer_->Received(static_cast<size_t>(answer.sizeMin));
  if (protocol::Opening::isStrangers(newcomer_->ReceivedBytes(), newcomer_->ReceivedSize())) {
    AbortStranger(newcomer_);
  } else {
    CheckNewcomer();
  }
}

// A newcomer takes a client's place only with a whole request. Other newcomers wait for a frame, because the client
// itself may connect again before the server learns that its old connection has closed.
void RCServer::CheckNewcomer() {
  if (newcomer_ == NULL) {
    return;
  }
  if (client_ == NULL) {
    Admit(newcomer_);
    return;
  }
  const bool is_silent = IsClientSilent();
  // After a radio outage, a client often returns before the robot misses it.
  const bool may_be_client = session_->ExpectsHeartbeat() && newcomer_->ClientAddress() == client_->ClientAddress();
  const bool may_replace = is_silent || may_be_client;
  if (!may_replace ||
      !protocol::RequestReader::beginsWithRequest(newcomer_->ReceivedBytes(), newcomer_->ReceivedSize())) {
    if (Now() - newcomer_since_ >= (may_replace ? INTRODUCTION_FRAMES : 1)) {
      TurnAwayWhileBusy(newcomer_);
    }
  } else if (!is_silent && !has_asked_ && session_->AskForSign()) {
    has_asked_ = true;
    newcomer_since_ = Now();
    ServeClient();
  } else if (is_silent || std::min(Now() - newcomer_since_, client_->FramesQuiet()) >= SIGN_FRAMES) {
    DropClient(is_silent ? "it was silent and another client came" : "it has come back over a new connection", true);
    Admit(newcomer_);
  }
}

void RCServer::TurnAwayByAddress(Connection* newcomer) {
  char reason[64 + MAX_SETTINGS_FAULT_SIZE] = "ALLOWED_ADDRESSES in RCSERVER.CFG does not name it";
  if (settings_.fault[0] != '\0') {
    sprintf(reason, "RCSERVER.CFG is ignored: %s", settings_.fault);
  }
  TurnAway(newcomer, reason);
}

void RCServer::TurnAwayWhileBusy(Connection* newcomer) {
  char reason[64];
  sprintf(reason, "client %s is being served", client_->ClientName());
  TurnAway(newcomer, reason);
}

void RCServer::CloseNewcomer(Connection* newcomer, bool abort) {
  newcomer->Close(abort);
  if (newcomer == newcomer_) {
    newcomer_ = NULL;
  }
}

// Aborts the connection, which frees it at once.
void RCServer::TurnAway(Connection* newcomer, const char* reason) {
  CloseNewcomer(newcomer, true);
  if (reports_.Admits(Now())) {
    OSYSPRINT(("RCServer: %s is turned away: %s\n", newcomer->ClientName(), reason));
  }
}

void RCServer::AbortStranger(Connection* stranger) {
  CloseNewcomer(stranger, true);
  reports_.CountStranger(stranger->ClientName(), Now());
}

// Drops the client and ends everything it has started.
void RCServer::DropClient(const char* reason, bool abort) {
  if (reports_.Admits(Now())) {
    OSYSPRINT(("RCServer: client %s is gone: %s\n", client_->ClientName(), reason));
  }
  client_->Close(abort);
  ForgetClient();
}

void RCServer::ForgetClient() {
  client_ = NULL;
  session_->End();
  pictures_.Forget();
  file_.Release();
  power_down_.CarryOut(Now());
  body_->SendCommands();
}

// Does everything that can be done for the client now, if there is one.
void RCServer::ServeClient() {
  if (client_ == NULL) {
    return;
  }
  const bool had_requested = session_->HasRequested();
  session_->HandleRequests(PresentFrame());
  while (session_->WantsInput() && !session_->IsWithStranger() && client_->ReceivedSize() > 0) {
    session_->AddInput(client_->ReceivedBytes(), client_->ReceivedSize());
    client_->TakeReceived();
    session_->HandleRequests(PresentFrame());
  }
  if (session_->IsWithStranger()) {
    AbortStranger(client_);
    ForgetClient();
    return;
  }
  if (!had_requested && session_->HasRequested() && reports_.Admits(Now())) {
    OSYSPRINT(("RCServer: client %s is connected\n", client_->ClientName()));
  }
  power_down_.Note(Now());
  if (pictures_.HasPicture() && !session_->Pictures().Wants(pictures_.Order())) {
    pictures_.DropPicture();
  }
  body_->SendCommands();
  if (!SendOutput()) {
    DropClient("the IPStack does not send", true);
  } else if (session_->IsOver() && !client_->IsSending()) {
    DropClient(session_->EndReason(), false);
  } else if (!session_->IsEnding() && !client_->Receive()) {
    DropClient("the IPStack does not receive", true);
  }
}

// Sends waiting data. A picture is sent first, while it is fresh, unless the client wants sound first.
bool RCServer::SendOutput() {
  if (client_->IsSending()) {
    return true;
  }
  bool succeeds = true;
  if (const PictureDatagrams::KeptPicture* left_over = datagrams_.TakeLeftOver(Now())) {
    succeeds = SendPicture(PictureOrder(), left_over->image, left_over->jpeg, left_over->size);
  } else if (pictures_.HasPicture() && !SoundGoesFirst()) {
    const EncodedPicture& picture = pictures_.Picture();
    succeeds = SendPicture(pictures_.Order(), pictures_.Header(), picture.jpeg, picture.size);
    pictures_.DropPicture();
    last_picture_ = Now();
  } else if (file_.IsThere()) {
    const FileResult& file = file_.Get();
    succeeds =
        SendContent(session_->Stick().EncodeFileHeader(file.size, client_->SendBuffer()), file.content, file.size);
    file_.Release();
  } else if (session_->HasOutput()) {
    succeeds = client_->Send(session_->TakeOutput(client_->SendBuffer()), false);
  }
  return succeeds;
}

bool RCServer::SendPicture(const PictureOrder& order, const protocol::version2::ImageHeader& image, const byte* jpeg,
                           size_t size) {
  return SendContent(session_->EncodePictureHeader(order, image, size, client_->SendBuffer()), jpeg, size);
}

// Sends the header in the client's send buffer and what follows it.
bool RCServer::SendContent(size_t header_size, const byte* content, size_t size) {
  memcpy(client_->SendBuffer() + header_size, content, size);
  return client_->Send(header_size + size, true);
}

void RCServer::DropWithoutPicture(const char* problem) {
  OSYSLOG1((osyslogERROR, "RCServer: no picture: %s", problem));
  DropClient("no picture can be made for it", true);
}

bool RCServer::IsSendingPicture() const {
  return client_->IsSendingPicture() || datagrams_.HasPicture() || !datagrams_.MaySend(Now());
}

// True if the client wants sound first and some sound waits or is needed. But a client that got no picture at all would
// take the connection for dead.
bool RCServer::SoundGoesFirst() const {
  return Now() - last_picture_ < LONGEST_PICTURE_WAIT && session_->Sound().GoesFirst();
}

// Begins the next picture unless one is being sent, because the next one would only wait behind it.
void RCServer::BeginPicture() {
  if (client_ != NULL && !IsSendingPicture() && !SoundGoesFirst() && pictures_.MayBegin()) {
    pictures_.Begin();
  }
}
