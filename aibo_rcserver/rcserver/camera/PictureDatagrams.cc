#include "rcserver/camera/PictureDatagrams.h"

#include <EndpointTypes.h>
#include <IPAddress.h>
#include <entry.h>
#include <string.h>

using namespace protocol::version2;

namespace {

// Size of the IPStack's send buffer: two packets, as in Sony's sample UDPEchoServer, so that few datagrams wait.
const size_t ENDPOINT_POOL_SIZE = 2 * MAX_DATAGRAM_SIZE;

const size_t RECEIVE_SIZE = DATAGRAM_STATUS_SIZE + 1;  // one more byte, to detect longer datagrams
const size_t DATAGRAM_OFFSET = KEPT_PICTURES * ENCODED_PICTURE_CAPACITY;
const size_t RECEIVE_OFFSET = DATAGRAM_OFFSET + MAX_DATAGRAM_SIZE;

}  // namespace

const unsigned PictureDatagrams::MOST_UNACKNOWLEDGED;
const longword PictureDatagrams::PATIENCE;
const longword PictureDatagrams::PATIENCE_PER_PART;
const longword PictureDatagrams::OLDEST_LEFT_OVER;

PictureDatagrams::PictureDatagrams()
    : object_(),
      buffer_(),
      endpoint_number_(0),
      receiver_(0),
      order_(),
      is_sending_(false),
      next_sequence_(0),
      next_picture_(0),
      acknowledged_(0),
      left_over_(0),
      unsent_part_(0),
      number_of_parts_(0),
      missing_picture_(0),
      first_missing_(0),
      missing_(0),
      is_repairing_(false) {
  memset(kept_, 0, sizeof(kept_));
}

bool PictureDatagrams::Create(OID object) {
  object_ = object;
  stack_ = antStackRef("IPStack");
  return buffer_.Create(stack_, RECEIVE_OFFSET + RECEIVE_SIZE);
}

void PictureDatagrams::Destroy() {
  Close();
  buffer_.Destroy(stack_);
}

bool PictureDatagrams::SendTo(const DatagramOrder& order) {
  Stop();
  order_ = order;
  if (!Open()) {
    return false;
  }
  if (order.is_test) {
    encodeTest(order_, DatagramBuffer());
    SendDatagram(MAX_DATAGRAM_SIZE);
  }
  return true;
}

void PictureDatagrams::Stop() {
  Close();
  left_over_ = 0;
}

void PictureDatagrams::HandOver() {
  if (order_.port == 0) {
    return;  // pictures that may be missing have been handed over, or were for another client
  }
  const unsigned unacknowledged = next_picture_ - acknowledged_;
  Close();
  left_over_ = unacknowledged < KEPT_PICTURES ? unacknowledged : KEPT_PICTURES;
}

const PictureDatagrams::KeptPicture* PictureDatagrams::TakeLeftOver(longword now) {
  while (left_over_ > 0) {
    const KeptPicture& oldest = Kept(next_picture_ - left_over_);
    --left_over_;
    if (now - oldest.begun <= OLDEST_LEFT_OVER) {
      return &oldest;
    }
  }
  return NULL;
}

bool PictureDatagrams::MaySend(longword now) const {
  const longword patience = PATIENCE + PATIENCE_PER_PART * static_cast<longword>(number_of_parts_);
  const longword last_begun = kept_[(next_picture_ - 1) % KEPT_PICTURES].begun;
  const unsigned in_flight = next_picture_ - acknowledged_ - (is_repairing_ ? 1 : 0);
  return !IsOn() || in_flight < MOST_UNACKNOWLEDGED || now - last_begun >= patience;
}

// The new picture replaces an older one, whose parts cannot be repeated any more.
void PictureDatagrams::Send(const ImageHeader& image, const byte* jpeg, size_t size, longword now) {
  if (next_picture_ - missing_picture_ == KEPT_PICTURES) {
    missing_ = 0;
  }
  byte* const copy = buffer_.Bytes() + next_picture_ % KEPT_PICTURES * ENCODED_PICTURE_CAPACITY;
  memcpy(copy, jpeg, size);
  const KeptPicture picture = {image, copy, size, now};
  Kept(next_picture_) = picture;
  ++next_picture_;
  unsent_part_ = 0;
  number_of_parts_ = numberOfParts(size);
  SendNext();
}

// A datagram that could not be sent counts as lost on the way.
void PictureDatagrams::Sent(const UDPEndpointSendMsg& answer) {
  if (order_.port != 0 && reinterpret_cast<size_t>(answer.continuation) == endpoint_number_) {
    is_sending_ = false;
    SendNext();
  }
}

void PictureDatagrams::Received(const UDPEndpointReceiveMsg& answer) {
  if (order_.port == 0 || reinterpret_cast<size_t>(answer.continuation) != endpoint_number_) {
    return;
  }
  const bool is_from_client =
      answer.error == UDP_SUCCESS && answer.address.Address() == receiver_ && answer.port == order_.port;
  const size_t size = is_from_client ? static_cast<size_t>(answer.size) : 0;
  DatagramStatus status;
  if (decode(ReceiveBuffer(), size, &status) == NULL) {
    Acknowledge(status.picture);
    Repeat(status);
  }
  Receive();
}

// The numbers are compared by their distances, because they may overflow.
void PictureDatagrams::Acknowledge(unsigned next_picture) {
  if (next_picture != acknowledged_ && next_picture - acknowledged_ <= next_picture_ - acknowledged_) {
    acknowledged_ = next_picture;
    is_repairing_ = false;
  }
}

void PictureDatagrams::Repeat(const DatagramStatus& status) {
  const unsigned behind = next_picture_ - status.picture;
  if (status.missing == 0 || status.picture != acknowledged_ || behind == 0 || behind > KEPT_PICTURES) {
    return;
  }
  const size_t sent = behind == 1 ? unsent_part_ : numberOfParts(Kept(status.picture).size);
  const size_t count = sent < status.first_part ? 0 : sent - status.first_part;
  is_repairing_ = true;
  missing_picture_ = status.picture;
  first_missing_ = status.first_part;
  missing_ = count < DatagramStatus::MOST_MISSING ? status.missing & ((1u << count) - 1) : status.missing;
  SendNext();
}

bool PictureDatagrams::Open() {
  antEnvCreateEndpointMsg create(EndpointType_UDP, ENDPOINT_POOL_SIZE);
  if (create.Call(stack_, sizeof(create)) != ANT_SUCCESS || create.error != ANT_SUCCESS) {
    order_.port = 0;
    return false;
  }
  endpoint_ = create.moduleRef;
  ++endpoint_number_;
  next_sequence_ = order_.first_sequence;
  next_picture_ = order_.first_picture;
  acknowledged_ = order_.first_picture;
  UDPEndpointBindMsg bind(endpoint_, IP_ADDR_ANY, IP_PORT_ANY);
  if (bind.Call(stack_, sizeof(bind)) != ANT_SUCCESS || bind.error != UDP_SUCCESS) {
    Close();
    return false;
  }
  Receive();
  return true;
}

void PictureDatagrams::Close() {
  if (order_.port != 0) {
    UDPEndpointCloseMsg close(endpoint_);
    close.Call(stack_, sizeof(close));
  }
  order_.port = 0;
  is_sending_ = false;
  is_repairing_ = false;
  DropUnsent();
}

// Repeated parts go first, because the client waits for them.
void PictureDatagrams::SendNext() {
  if (is_sending_) {
    return;
  }
  if (missing_ != 0) {
    SendMissingPart();
  } else if (unsent_part_ < number_of_parts_) {
    SendPart(next_picture_ - 1, unsent_part_++);
  }
}

void PictureDatagrams::SendMissingPart() {
  unsigned bit = 0;
  while ((missing_ >> bit & 1) == 0) {
    ++bit;
  }
  missing_ &= ~(1u << bit);
  SendPart(missing_picture_, first_missing_ + bit);
}

void PictureDatagrams::SendPart(unsigned picture, size_t part) {
  const KeptPicture& kept = Kept(picture);
  const PictureDatagram header = {static_cast<unsigned short>(part), next_sequence_, picture,
                                  static_cast<unsigned>(kept.size), kept.image};
  const size_t size = sizeOfPart(kept.size, part);
  ++next_sequence_;
  encode(header, DatagramBuffer());
  memcpy(DatagramBuffer() + DATAGRAM_HEADER_SIZE, kept.jpeg + part * DATAGRAM_PART_SIZE, size);
  SendDatagram(DATAGRAM_HEADER_SIZE + size);
}

// Sends the contents of DatagramBuffer(). If the IPStack refuses, the rest of the picture is dropped.
void PictureDatagrams::SendDatagram(size_t size) {
  UDPEndpointSendMsg send(endpoint_, IPAddress(static_cast<uint32>(receiver_)), order_.port, DatagramBuffer(),
                          static_cast<int>(size));
  send.continuation = reinterpret_cast<void*>(endpoint_number_);
  is_sending_ = send.Send(stack_, object_, Extra_Entry[entryDatagramCont], sizeof(send)) == ANT_SUCCESS;
  if (!is_sending_) {
    DropUnsent();
  }
}

void PictureDatagrams::DropUnsent() {
  missing_ = 0;
  unsent_part_ = number_of_parts_;
}

// If the IPStack refuses, no status is ever received, and each picture waits for the timeout.
void PictureDatagrams::Receive() {
  UDPEndpointReceiveMsg receive(endpoint_, ReceiveBuffer(), static_cast<int>(RECEIVE_SIZE));
  receive.continuation = reinterpret_cast<void*>(endpoint_number_);
  receive.Send(stack_, object_, Extra_Entry[entryStatusCont], sizeof(receive));
}

byte* PictureDatagrams::DatagramBuffer() const {
  return buffer_.Bytes() + DATAGRAM_OFFSET;
}

byte* PictureDatagrams::ReceiveBuffer() const {
  return buffer_.Bytes() + RECEIVE_OFFSET;
}
