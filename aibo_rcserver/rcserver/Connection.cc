#include "rcserver/Connection.h"

#include <entry.h>
#include <stdio.h>
#include <string.h>

namespace {

// What the IPStack may hold of what was sent. It is what a client that stops reading still gets when it goes on, so it
// is small: two or three pictures.
const size_t ENDPOINT_POOL_SIZE = 8192;

}  // namespace

const size_t Connection::PICTURE_CAPACITY;
const size_t Connection::MESSAGE_CAPACITY;
const size_t Connection::PICTURE_SIZE;
const size_t Connection::RECEIVE_SIZE;

Connection::Connection()
    : object_(),
      buffer_(NULL),
      endpoint_number_(0),
      state_(CLOSED),
      sending_(false),
      receiving_(false),
      picture_(NULL),
      picture_size_(0),
      is_sending_picture_(false),
      client_address_(0) {
  client_name_[0] = '\0';
}

bool Connection::Create(OID object) {
  object_ = object;
  stack_ = antStackRef("IPStack");
  antEnvCreateSharedBufferMsg create(MESSAGE_CAPACITY + PICTURE_SIZE + RECEIVE_SIZE);
  create.Call(stack_, sizeof(create));
  if (create.error != ANT_SUCCESS) {
    return false;
  }
  shared_buffer_ = create.buffer;
  shared_buffer_.Map();
  buffer_ = static_cast<byte*>(shared_buffer_.GetAddress());
  return true;
}

void Connection::Destroy() {
  if (buffer_ == NULL) {
    return;
  }
  shared_buffer_.UnMap();
  antEnvDestroySharedBufferMsg destroy(shared_buffer_);
  destroy.Call(stack_, sizeof(destroy));
  buffer_ = NULL;
}

bool Connection::Owns(const void* continuation) const {
  return state_ != CLOSED && reinterpret_cast<size_t>(continuation) == endpoint_number_;
}

bool Connection::Listen(Port port, size_t endpoint_number) {
  antEnvCreateEndpointMsg create(EndpointType_TCP, ENDPOINT_POOL_SIZE);
  create.Call(stack_, sizeof(create));
  if (create.error != ANT_SUCCESS) {
    return false;
  }
  endpoint_ = create.moduleRef;
  endpoint_number_ = endpoint_number;
  state_ = LISTENING;
  client_name_[0] = '\0';
  TCPEndpointListenMsg listen(endpoint_, IP_ADDR_ANY, port);
  if (!Post(listen, Extra_Entry[entryListenCont], sizeof(listen))) {
    Close(true);
    return false;
  }
  return true;
}

void Connection::Accepted(const TCPEndpointListenMsg& answer) {
  state_ = CONNECTED;
  sending_ = false;
  receiving_ = false;
  picture_size_ = 0;
  is_sending_picture_ = false;
  client_address_ = answer.fAddress.Address();
  sprintf(client_name_, "%u.%u.%u.%u:%u", client_address_ >> 24, (client_address_ >> 16) & 0xff,
          (client_address_ >> 8) & 0xff, client_address_ & 0xff, static_cast<unsigned>(answer.fPort));
}

void Connection::Close(bool abort) {
  if (state_ == CLOSING || state_ == CLOSED) {
    return;
  }
  state_ = CLOSING;
  TCPEndpointCloseMsg close(endpoint_);
  close.abort = abort;
  if (!Post(close, Extra_Entry[entryCloseCont], sizeof(close))) {
    state_ = CLOSED;
  }
}

void Connection::Closed() {
  state_ = CLOSED;
}

bool Connection::SendMessage(size_t size) {
  return Send(MessageBuffer(), size);
}

bool Connection::SendPicture(const byte* header, size_t header_size, size_t size) {
  picture_ = PictureBuffer() - header_size;
  picture_size_ = header_size + size;
  memcpy(picture_, header, header_size);
  return sending_ || SendWaitingPicture();
}

bool Connection::Sent() {
  sending_ = false;
  if (is_sending_picture_) {
    is_sending_picture_ = false;
    picture_size_ = 0;
  }
  return picture_size_ == 0 || SendWaitingPicture();
}

bool Connection::Receive() {
  if (!receiving_) {
    TCPEndpointReceiveMsg receive(endpoint_, ReceiveBuffer(), 1, static_cast<int>(RECEIVE_SIZE));
    receiving_ = Post(receive, Extra_Entry[entryReceiveCont], sizeof(receive));
  }
  return receiving_;
}

bool Connection::SendWaitingPicture() {
  is_sending_picture_ = true;
  return Send(picture_, picture_size_);
}

bool Connection::Send(byte* bytes, size_t size) {
  TCPEndpointSendMsg send(endpoint_, bytes, static_cast<int>(size));
  sending_ = Post(send, Extra_Entry[entrySendCont], sizeof(send));
  return sending_;
}

// Sends a message to the IPStack, whose answer will say by endpoint_number_ which endpoint it concerns.
bool Connection::Post(antEnvMsg& message, Selector entry, size_t size) {
  message.continuation = reinterpret_cast<void*>(endpoint_number_);
  return message.Send(stack_, object_, entry, size) == ANT_SUCCESS;
}
