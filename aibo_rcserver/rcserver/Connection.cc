#include "rcserver/Connection.h"

#include <EndpointTypes.h>
#include <entry.h>
#include <stdio.h>

namespace {

// Size of the IPStack's send buffer: slightly more than a part (Internet Protocol Version4, 1.3: 10 KB for packets of 8
// KB). A client that has stopped reading for a while first gets these old bytes, so the buffer holds only two or three
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
      now_(0),
      aborting_(false),
      close_began_(0),
      client_() {}

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
  client_ = Client();
  TCPEndpointListenMsg listen(endpoint_, IP_ADDR_ANY, port);
  if (!Post(listen, Extra_Entry[entryListenCont], sizeof(listen))) {
    Close(true);
    return false;
  }
  return true;
}

void Connection::Accepted(const TCPEndpointListenMsg& answer) {
  state_ = CONNECTED;
  client_.connected = client_.last_bytes = client_.last_given = client_.last_sent = client_.last_taken = now_;
  client_.address = answer.fAddress.Address();
  sprintf(client_.name, "%u.%u.%u.%u:%u", client_.address >> 24, (client_.address >> 16) & 0xff,
          (client_.address >> 8) & 0xff, client_.address & 0xff, static_cast<unsigned>(answer.fPort));
}

void Connection::Close(bool abort) {
  if (state_ == CLOSED || (state_ == CLOSING && (aborting_ || !abort))) {
    return;
  }
  state_ = CLOSING;
  aborting_ = abort;
  close_began_ = now_;
  TCPEndpointCloseMsg close(endpoint_);
  close.abort = abort;
  if (!Post(close, Extra_Entry[entryCloseCont], sizeof(close))) {
    state_ = CLOSED;
  }
}

void Connection::PassTime(longword now) {
  now_ = now;
  if (state_ == CLOSING && now - close_began_ >= CLOSE_PATIENCE) {
    Close(true);
  }
}

void Connection::Closed() {
  state_ = CLOSED;
}

bool Connection::Send(size_t size, bool is_picture) {
  client_.is_sending_picture = is_picture;
  client_.unsent = SendBuffer();
  client_.unsent_size = size;
  return SendPart();
}

bool Connection::Sent() {
  client_.sending = false;
  client_.last_sent = now_;
  client_.last_taken = client_.last_given == now_ ? client_.last_taken : now_;
  if (client_.unsent_size > 0) {
    return SendPart();
  }
  client_.is_sending_picture = false;
  return true;
}

bool Connection::Receive() {
  if (client_.receiving) {
    return true;
  }
  if (ReceivedSize() == 0) {
    client_.received_begin = 0;
    client_.received_end = 0;
  }
  if (client_.received_end > RECEIVE_SIZE / 2) {
    return true;
  }
  TCPEndpointReceiveMsg receive(endpoint_, ReceiveBuffer() + client_.received_end, 1,
                                static_cast<int>(RECEIVE_SIZE - client_.received_end));
  client_.receiving = Post(receive, Extra_Entry[entryReceiveCont], sizeof(receive));
  return client_.receiving;
}

const char* Connection::ReasonOf(TCPEndpointError error) {
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

void Connection::Received(size_t size) {
  client_.receiving = false;
  client_.last_bytes = now_;
  client_.received_end += size;
}

bool Connection::SendPart() {
  const size_t size = client_.unsent_size < MAX_PART_SIZE ? client_.unsent_size : MAX_PART_SIZE;
  TCPEndpointSendMsg send(endpoint_, client_.unsent, static_cast<int>(size));
  client_.unsent += size;
  client_.unsent_size -= size;
  client_.last_given = now_;
  client_.sending = Post(send, Extra_Entry[entrySendCont], sizeof(send));
  return client_.sending;
}

// Sends a message to the IPStack. Its answer comes with endpoint_number_ as the continuation.
bool Connection::Post(antEnvMsg& message, Selector entry, size_t size) {
  message.continuation = reinterpret_cast<void*>(endpoint_number_);
  return message.Send(stack_, object_, entry, size) == ANT_SUCCESS;
}
