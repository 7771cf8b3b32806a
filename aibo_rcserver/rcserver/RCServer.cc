#include "rcserver/RCServer.h"

#include <OPENR/OFbkImage.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

#include <entry.h>
#include <stdio.h>
#include <string.h>

#include "objects/HostSettings.h"
#include "protocol/opening.h"
#include "protocol/version1.h"

namespace {

const longword FRAMES_PER_SECOND = 125;  // of 8 ms
const longword FRAMES_PER_MINUTE = 60 * FRAMES_PER_SECOND;

bool IsStranger(const byte* bytes, size_t size) {
  protocol::Opening opening;
  opening.add(bytes, size);
  return opening.verdict() == protocol::Opening::STRANGER;
}

// OPEN-R passes event data as const, but its own classes need a non-const pointer. The data is not modified.
template <typename Vector>
Vector* VectorOf(const ONotifyEvent& event, int number = 0) {
  return static_cast<Vector*>(const_cast<void*>(event.Data(number)));
}

// The plane of detected colours. Its pixels are NULL if the image has none.
ColorPlane FindColorPlane(OFbkImageVectorData* image_vector) {
  const OFbkImage image(image_vector->GetInfo(ofbkimageLAYER_C), image_vector->GetData(ofbkimageLAYER_C),
                        ofbkimageBAND_CDT);
  const bool is_there = image.IsValid() && image.Width() > 0 && image.Height() > 1;
  const ColorPlane plane = {is_there ? image.Pointer() : NULL, static_cast<size_t>(image.Width()),
                            static_cast<size_t>(image.Height()), static_cast<size_t>(image.Width() + image.Skip())};
  return plane;
}

const char* ReasonOf(TCPEndpointError error) {
  switch (error) {
    case TCP_CONNECTION_CLOSED:
      return "it closed the connection";
    case TCP_CONNECTION_RESET:
      return "it reset the connection";
    case TCP_CONNECTION_TIMEOUT:
      return "it cannot be reached";
    default:
      return "the IPStack failed";
  }
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
      quiet_since_(0),
      body_(NULL),
      power_down_(file_desk_),
      session_(NULL),
      last_picture_(0),
      signs_(),
      last_attempt_(0),
      strangers_(0),
      last_stranger_(0 - FRAMES_PER_MINUTE) {}

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
    OfferImage(image_vector);
    BeginPicture();
  }
  if (client_ != NULL && session_->Camera().WantsColors(pictures_.ImageCount())) {
    session_->Camera().ColorsDetected(FindColorPlane(image_vector), pictures_.ImageCount(),
                                      image_vector->GetInfo(ofbkimageLAYER_H)->frameNumber);
    ServeClient();
  }
  observer[event.ObsIndex()]->AssertReady();
}

void RCServer::NotifyPicture(const ONotifyEvent& event) {
  if (pictures_.Take(event, observer[event.ObsIndex()])) {
    UsePicture();
  }
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
    connection->Close(true, Now());
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
    quiet_since_ = Now();
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
    DropClient(ReasonOf(answer->error), true);
    return;
  }
  signs_.last_sign_of_life = Now();
  if (signs_.last_given != Now()) {  // the bytes have waited until the client took others
    quiet_since_ = Now();
  }
  signs_.last_given = Now();
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
    DropClient(ReasonOf(answer->error), answer->error != TCP_CONNECTION_CLOSED);
    return;
  }
  client_->Received(static_cast<size_t>(answer->sizeMin));
  signs_.last_sign_of_life = Now();
  signs_.last_bytes_received = Now();
  quiet_since_ = Now();
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
  if (Now() - last_attempt_ >= FRAMES_PER_SECOND) {
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
    signs_.last_not_over = Now();
  } else if (Now() - signs_.last_not_over >= FRAMES_PER_SECOND) {
    DropClient(session_->EndReason(), true);
    return;
  }
  if (session_->ExpectsHeartbeat() && Now() - signs_.last_bytes_received >= HEARTBEAT_FRAMES) {
    DropClient("it has been silent for 5 s", true);
    return;
  }
  if (IsClientSilent()) {
    body_->Joints().Motions().EndRepetitions();
  }
}

// A client that has not sent a whole request may be any program, so it gets less time, whatever bytes it sends.
bool RCServer::IsClientSilent() const {
  if (!session_->HasRequested() && Now() - signs_.admitted >= FIRST_REQUEST_FRAMES) {
    return true;
  }
  return Now() - signs_.last_sign_of_life >= settings_.silent_client_seconds * FRAMES_PER_SECOND;
}

void RCServer::ListenWhereClosed() {
  last_attempt_ = Now();
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
  const Signs signs = {Now(), Now(), Now(), Now(), false, Now()};
  signs_ = signs;
  session_->Begin();
  datagrams_.ClientConnected(client_->ClientAddress());
  ServeClient();
}

// True if the newcomer may be the client. After a radio outage, it often returns before the robot misses it.
bool RCServer::MayBeClientAgain(const Connection& newcomer) const {
  return session_->ExpectsHeartbeat() && newcomer.ClientAddress() == client_->ClientAddress();
}

// Handles a newcomer that has sent something or has gone. Further bytes are read after it has become the client.
void RCServer::NewcomerReceived(const TCPEndpointReceiveMsg& answer) {
  if (answer.error != TCP_SUCCESS) {
    CloseNewcomer(newcomer_, answer.error != TCP_CONNECTION_CLOSED);
    return;
  }
  newcomer_->Received(static_cast<size_t>(answer.sizeMin));
  if (IsStranger(newcomer_->ReceivedBytes(), newcomer_->ReceivedSize())) {
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
  const bool may_replace = is_silent || MayBeClientAgain(*newcomer_);
  if (!may_replace ||
      !protocol::RequestReader::beginsWithRequest(newcomer_->ReceivedBytes(), newcomer_->ReceivedSize())) {
    if (Now() - newcomer_since_ >= (may_replace ? INTRODUCTION_FRAMES : 1)) {
      TurnAwayWhileBusy(newcomer_);
    }
  } else if (!is_silent && !has_asked_ && session_->AskForSign()) {
    has_asked_ = true;
    quiet_since_ = Now();
    ServeClient();
  } else if (is_silent || Now() - quiet_since_ >= SIGN_FRAMES) {
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
  newcomer->Close(abort, Now());
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

// The console names few strangers, because a program such as a browser may try again without end.
void RCServer::AbortStranger(Connection* stranger) {
  CloseNewcomer(stranger, true);
  ++strangers_;
  if (Now() - last_stranger_ >= FRAMES_PER_MINUTE) {
    OSYSPRINT(
        ("RCServer: %s is not a client: its first bytes are not a request, but may be a web browser's. %u such "
         "connections have been aborted since the last report\n",
         stranger->ClientName(), strangers_));
    strangers_ = 0;
    last_stranger_ = Now();
  }
}

// Drops the client and ends everything it has started.
void RCServer::DropClient(const char* reason, bool abort) {
  if (reports_.Admits(Now())) {
    OSYSPRINT(("RCServer: client %s is gone: %s\n", client_->ClientName(), reason));
  }
  client_->Close(abort, Now());
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
  if (!signs_.is_announced && session_->HasRequested()) {
    signs_.is_announced = true;
    if (reports_.Admits(Now())) {
      OSYSPRINT(("RCServer: client %s is connected\n", client_->ClientName()));
    }
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
  signs_.last_given = Now();
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

void RCServer::OfferImage(OFbkImageVectorData* image_vector) {
  PictureOrder order;
  if (!FindOrder(&order)) {
    return;
  }
  if (const char* problem = pictures_.Offer(image_vector, order, body_->Camera().Settings())) {
    OSYSLOG1((osyslogERROR, "RCServer: %s", problem));
    DropClient("there is no picture for it", true);
  }
}

// Finds the kind of picture to make of this image; false if no picture is due.
bool RCServer::FindOrder(PictureOrder* order) {
  // A picture that still waits is replaced by one of this newer image.
  if (!pictures_.TakeBack(order)) {
    return !IsSendingPicture() && session_->Pictures().ImageArrived(pictures_.ImageCount(), order);
  }
  if (!session_->Pictures().Wants(*order)) {
    return false;
  }
  session_->Pictures().TakeAgain(*order, pictures_.ImageCount());
  return true;
}

bool RCServer::IsSendingPicture() const {
  return client_->IsSendingPicture() || datagrams_.HasPicture() || !datagrams_.MaySend(Now());
}

// True if the client wants sound first and some sound waits or is needed. But a client that got no picture at all would
// take the connection for dead.
bool RCServer::SoundGoesFirst() const {
  return Now() - last_picture_ < LONGEST_PICTURE_WAIT && body_->Hearing().GoesFirst() &&
         (session_->SoundWaits() || body_->Voice().IsShort());
}

// Begins the next picture unless one is being sent, because the next one would only wait behind it.
void RCServer::BeginPicture() {
  if (client_ != NULL && !IsSendingPicture() && !SoundGoesFirst() && pictures_.MayBegin()) {
    pictures_.Begin();
  }
}

void RCServer::UsePicture() {
  const EncodedPicture& picture = pictures_.Picture();
  if (picture.size == 0) {
    OSYSLOG1((osyslogERROR, "RCServer: no picture: %s", picture.problem));
    DropClient("there is no picture for it", true);
    return;
  }
  if (pictures_.Order().is_for_stick) {
    session_->PictureTaken(picture.jpeg, picture.size);
    pictures_.DropPicture();
  } else if (datagrams_.IsOn() && pictures_.Order().is_of_stream && session_->Pictures().Wants(pictures_.Order())) {
    last_picture_ = Now();
    datagrams_.Send(pictures_.Header(), picture.jpeg, picture.size, Now());
    pictures_.DropPicture();
  }
  ServeClient();
}
