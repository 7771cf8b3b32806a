#include "rcserver/Connection.h"

#include <EndpointTypes.h>
#include <entry.h>
#include <stdio.h>
#include <string.h>

namespace {

// Size of the IPStack's send buffer: slightly more than a part (Internet Protocol Version4, 1.3: 10 KB for packets of 8
// KB). A client that stops reading for a while gets these old bytes first, so the buffer holds only two or three
// pictures.
const size_t ENDPOINT_POOL_SIZE = 10 * 1024;

}  // namespace

const size_t Connection::MAX_PART_SIZE;
const longword Connection::CLOSE_PATIENCE;
const size_t Connection::PICTURE_SIZE;
const size_t Connection::SEND_CAPACITY;
const size_t Connection::RECEIVE_SIZE;

Connection::Connection()
    : object_(),
      buffer_(),
      endpoint_number_(0),
      state_(CLOSED),
      aborting_(false),
      close_began_(0),
      sending_(false),
      unsent_(NULL),
      unsent_size_(0),
      receiving_(false),
      received_begin_(0),
      received_end_(0),
      is_sending_picture_(false),
      client_address_(0) {
  client_name_[0] = '\0';
}

bool Connection::Create(OID object) {
  object_ = object;
  stack_ = antStackRef("IPStack");
  return buffer_.Create(stack_, SEND_CAPACITY + RECEIVE_SIZE);
}

void Connection::Destroy() {
  buffer_.Destroy(stack_);
}

bool Connection::Owns(const void* continuation) const {
  return state_ != CLOSED && reinterpret_cast<size_t>(continuation) == endpoint_number_;
}

bool Connection::Listen(Port port, size_t endpoint_number) {
  antEnvCreateEndpointMsg create(EndpointType_TCP, ENDPOINT_POOL_SIZE);
  if (create.Call(stack_, sizeof(create)) != ANT_SUCCESS || create.error != ANT_SUCCESS) {
    return false;
  }
  endpoint_ = create.moduleRef;
  endpoint_number_ = endpoint_number;
  state_ = LISTENING;
  client_name_[0] = '\0';
  TCPEndpointListenMsg listen(endpoint_, IP_ADDR_ANY, port);
  if (!Post(listen, Extra_Entry[entryListenCont], sizeof(listen))) {
    Close(true, 0);
    return false;
  }
  return true;
}

void Connection::Accepted(const TCPEndpointListenMsg& answer) {
  state_ = CONNECTED;
  sending_ = false;
  receiving_ = false;
  received_begin_ = 0;
  received_end_ = 0;
  is_sending_picture_ = false;
  client_address_ = answer.fAddress.Address();
  sprintf(client_name_, "%u.%u.%u.%u:%u", client_address_ >> 24, (client_address_ >> 16) & 0xff,
          (client_address_ >> 8) & 0xff, client_address_ & 0xff, static_cast<unsigned>(answer.fPort));
}

void Connection::Close(bool abort, longword now) {
  if (state_ == CLOSED || (state_ == CLOSING && (aborting_ || !abort))) {
    return;
  }
  state_ = CLOSING;
  aborting_ = abort;
  close_began_ = now;
  TCPEndpointCloseMsg close(endpoint_);
  close.abort = abort;
  if (!Post(close, Extra_Entry[entryCloseCont], sizeof(close))) {
    state_ = CLOSED;
  }
}

void Connection::PassTime(longword now) {
  if (state_ == CLOSING && now - close_began_ >= CLOSE_PATIENCE) {
    Close(true, now);
  }
}

void Connection::Closed() {
  state_ = CLOSED;
}

bool Connection::Send(size_t size, bool is_picture) {
  is_sending_picture_ = is_picture;
  unsent_ = SendBuffer();
  unsent_size_ = size;
  return SendPart();
}

bool Connection::Sent() {
  sending_ = false;
  if (unsent_size_ > 0) {
    return SendPart();
  }
  is_sending_picture_ = false;
  return true;
}

bool Connection::Receive() {
  if (receiving_) {
    return true;
  }
  if (ReceivedSize() == 0) {
    received_begin_ = 0;
    received_end_ = 0;
  }
  if (received_end_ > RECEIVE_SIZE / 2) {
    return true;
  }
  TCPEndpointReceiveMsg receive(endpoint_, ReceiveBuffer() + received_end_, 1,
                                static_cast<int>(RECEIVE_SIZE - received_end_));
  receiving_ = Post(receive, Extra_Entry[entryReceiveCont], sizeof(receive));
  return receiving_;
}

void Connection::Received(size_t size) {
  receiving_ = false;
  received_end_ += size;
}

bool Connection::SendPart() {
  const size_t size = unsent_size_ < MAX_PART_SIZE ? unsent_size_ : MAX_PART_SIZE;
  TCPEndpointSendMsg send(endpoint_, unsent_, static_cast<int>(size));
  unsent_ += size;
  unsent_size_ -= size;
  sending_ = Post(send, Extra_Entry[entrySendCont], sizeof(send));
  return sending_;
}

// Sends a message to the IPStack. Its answer comes with endpoint_number_ as the continuation.
bool Connection::Post(antEnvMsg& message, Selector entry, size_t size) {
  message.continuation = reinterpret_cast<void*>(endpoint_number_);
  return message.Send(stack_, object_, entry, size) == ANT_SUCCESS;
}
