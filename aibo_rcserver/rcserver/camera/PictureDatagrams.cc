#include "rcserver/camera/PictureDatagrams.h"

#include <EndpointTypes.h>
#include <IPAddress.h>
#include <entry.h>
#include <string.h>

using protocol::version2::DATAGRAM_HEADER_SIZE;
using protocol::version2::DATAGRAM_PART_SIZE;
using protocol::version2::ImageHeader;
using protocol::version2::MAX_DATAGRAM_SIZE;
using protocol::version2::PARTS_PER_PARITY;
using protocol::version2::PictureDatagram;

namespace {

// Size of the IPStack's send buffer: two packets, as in Sony's sample UDPEchoServer, so that few datagrams wait.
const size_t ENDPOINT_POOL_SIZE = 2 * MAX_DATAGRAM_SIZE;

const size_t RECEIVE_SIZE = protocol::version2::ACKNOWLEDGEMENT_SIZE + 1;  // one more byte, to detect longer datagrams
const size_t PARITY_OFFSET = DATAGRAM_HEADER_SIZE + ENCODED_PICTURE_CAPACITY;
const size_t RECEIVE_OFFSET = PARITY_OFFSET + MAX_DATAGRAM_SIZE;

}  // namespace

const unsigned PictureDatagrams::MOST_UNACKNOWLEDGED;
const longword PictureDatagrams::PATIENCE;
const longword PictureDatagrams::PATIENCE_PER_PART;
const unsigned PictureDatagrams::PROTECTED_PICTURES;

PictureDatagrams::PictureDatagrams()
    : object_(),
      buffer_(),
      endpoint_number_(0),
      receiver_(0),
      port_(0),
      next_(),
      unsent_part_(0),
      number_of_parts_(0),
      has_parities_(false),
      is_sending_parity_(false),
      to_be_protected_(0),
      acknowledged_(0),
      last_begun_(0) {}

bool PictureDatagrams::Create(OID object) {
  object_ = object;
  stack_ = antStackRef("IPStack");
  return buffer_.Create(stack_, RECEIVE_OFFSET + RECEIVE_SIZE);
}

void PictureDatagrams::Destroy() {
  Close();
  buffer_.Destroy(stack_);
}

bool PictureDatagrams::SendTo(Port port) {
  Close();
  return port == 0 || Open(port);
}

bool PictureDatagrams::MaySend(longword now) const {
  const longword patience = PATIENCE + PATIENCE_PER_PART * static_cast<longword>(number_of_parts_);
  return !IsOn() || next_.picture - acknowledged_ < MOST_UNACKNOWLEDGED || now - last_begun_ >= patience;
}

void PictureDatagrams::Send(const ImageHeader& image, const byte* jpeg, size_t size, longword now) {
  last_begun_ = now;
  memcpy(buffer_.Bytes() + DATAGRAM_HEADER_SIZE, jpeg, size);
  next_.jpeg_size = static_cast<unsigned>(size);
  next_.image = image;
  unsent_part_ = 0;
  number_of_parts_ = protocol::version2::numberOfParts(size);
  has_parities_ = to_be_protected_ > 0;
  to_be_protected_ -= has_parities_ ? 1 : 0;
  SendPart();
}

// A datagram that could not be sent counts as lost on the way.
void PictureDatagrams::Sent(const UDPEndpointSendMsg& answer) {
  if (port_ == 0 || reinterpret_cast<size_t>(answer.continuation) != endpoint_number_ || !HasPicture()) {
    return;
  }
  if (is_sending_parity_) {
    is_sending_parity_ = false;
  } else {
    ++unsent_part_;
    is_sending_parity_ = has_parities_ && GroupEnds();
  }
  if (is_sending_parity_) {
    SendParity();
  } else if (HasPicture()) {
    SendPart();
  } else {
    ++next_.picture;
  }
}

void PictureDatagrams::Received(const UDPEndpointReceiveMsg& answer) {
  if (port_ == 0 || reinterpret_cast<size_t>(answer.continuation) != endpoint_number_) {
    return;
  }
  const bool is_from_client =
      answer.error == UDP_SUCCESS && answer.address.Address() == receiver_ && answer.port == port_;
  const size_t size = is_from_client ? static_cast<size_t>(answer.size) : 0;
  protocol::version2::Acknowledgement whole;
  protocol::version2::LossReport loss;
  if (decode(ReceiveBuffer(), size, &whole) == NULL) {
    if (whole.picture <= next_.picture && whole.picture >= acknowledged_) {
      acknowledged_ = whole.picture + 1;
    }
  } else if (decode(ReceiveBuffer(), size, &loss) == NULL && loss.picture <= next_.picture) {
    to_be_protected_ = PROTECTED_PICTURES;
  }
  Receive();
}

bool PictureDatagrams::Open(Port port) {
  antEnvCreateEndpointMsg create(EndpointType_UDP, ENDPOINT_POOL_SIZE);
  if (create.Call(stack_, sizeof(create)) != ANT_SUCCESS || create.error != ANT_SUCCESS) {
    return false;
  }
  endpoint_ = create.moduleRef;
  ++endpoint_number_;
  port_ = port;
  next_.sequence = 0;
  next_.picture = 0;
  acknowledged_ = 0;
  to_be_protected_ = 0;
  UDPEndpointBindMsg bind(endpoint_, IP_ADDR_ANY, IP_PORT_ANY);
  if (bind.Call(stack_, sizeof(bind)) != ANT_SUCCESS || bind.error != UDP_SUCCESS) {
    Close();
    return false;
  }
  Receive();
  return true;
}

void PictureDatagrams::Close() {
  if (port_ != 0) {
    UDPEndpointCloseMsg close(endpoint_);
    close.Call(stack_, sizeof(close));
  }
  port_ = 0;
  unsent_part_ = 0;
  number_of_parts_ = 0;
  is_sending_parity_ = false;
}

// True if the part that was sent last ends its group.
bool PictureDatagrams::GroupEnds() const {
  return unsent_part_ % PARTS_PER_PARITY == 0 || unsent_part_ == number_of_parts_;
}

// The header overwrites the end of the previous part, which the IPStack has already taken.
void PictureDatagrams::SendPart() {
  byte* const datagram = buffer_.Bytes() + unsent_part_ * DATAGRAM_PART_SIZE;
  const size_t part_size = protocol::version2::sizeOfPart(next_.jpeg_size, unsent_part_);
  if (has_parities_) {
    byte* const parity = ParityBuffer() + DATAGRAM_HEADER_SIZE;
    if (unsent_part_ % PARTS_PER_PARITY == 0) {
      memset(parity, 0, part_size);
    }
    protocol::version2::addToParity(datagram + DATAGRAM_HEADER_SIZE, part_size, parity);
  }
  next_.is_parity = false;
  next_.part = static_cast<unsigned short>(unsent_part_);
  SendDatagram(datagram, part_size);
}

void PictureDatagrams::SendParity() {
  const size_t first_part = (unsent_part_ - 1) / PARTS_PER_PARITY * PARTS_PER_PARITY;
  next_.is_parity = true;
  next_.part = static_cast<unsigned short>(first_part);
  SendDatagram(ParityBuffer(), protocol::version2::sizeOfPart(next_.jpeg_size, first_part));
}

// @param datagram room for its header, and behind it its content
void PictureDatagrams::SendDatagram(byte* datagram, size_t content_size) {
  encode(next_, datagram);
  ++next_.sequence;
  UDPEndpointSendMsg send(endpoint_, IPAddress(static_cast<uint32>(receiver_)), port_, datagram,
                          static_cast<int>(DATAGRAM_HEADER_SIZE + content_size));
  send.continuation = reinterpret_cast<void*>(endpoint_number_);
  if (send.Send(stack_, object_, Extra_Entry[entryDatagramCont], sizeof(send)) != ANT_SUCCESS) {
    number_of_parts_ = 0;  // drop the rest of this picture
    is_sending_parity_ = false;
    ++next_.picture;
  }
}

// If the IPStack refuses, no acknowledgement is received, so each picture waits for the timeout.
void PictureDatagrams::Receive() {
  UDPEndpointReceiveMsg receive(endpoint_, ReceiveBuffer(), static_cast<int>(RECEIVE_SIZE));
  receive.continuation = reinterpret_cast<void*>(endpoint_number_);
  receive.Send(stack_, object_, Extra_Entry[entryAcknowledgementCont], sizeof(receive));
}

byte* PictureDatagrams::ReceiveBuffer() const {
  return buffer_.Bytes() + RECEIVE_OFFSET;
}

byte* PictureDatagrams::ParityBuffer() const {
  return buffer_.Bytes() + PARITY_OFFSET;
}
