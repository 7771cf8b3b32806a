/// @file Connection.h
/// One place for a client at the IPStack.
#ifndef AIBO_RCSERVER_RCSERVER_CONNECTION_H
#define AIBO_RCSERVER_RCSERVER_CONNECTION_H

#include <OPENR/OPENR.h>
#include <TCPEndpointMsg.h>
#include <ant.h>

#include "picture_encoder/PictureJob.h"
#include "rcserver/Outbox.h"
#include "rcserver/Session.h"

/// Listens, serves one client and closes, again and again: each time with a new endpoint, because an endpoint of the
/// IPStack serves one connection.
///
/// At most one message or picture and one receive are under way at a time. What is sent goes in parts of at most
/// MAX_PART_SIZE bytes, each when the IPStack has taken the one before. A picture may be handed over while a message is
/// under way, and waits: so answers and telemetry cost the stream no picture.
///
/// An orderly close is answered only when the client has closed, too (Internet Protocol Version4, 2.2 and 2.7). A
/// client that takes longer than CLOSE_PATIENCE is aborted.
class Connection {
 public:
  /// Most bytes that are given to the IPStack at once. Nearly every picture fits in there with its header.
  static const size_t MAX_PART_SIZE = 8 * 1024;

  /// Frames that an orderly close may take: 2 s.
  static const longword CLOSE_PATIENCE = 250;

  /// Bytes of a picture that can be sent.
  static const size_t PICTURE_CAPACITY = ENCODED_PICTURE_CAPACITY;

  /// Bytes of messages that can be sent at once: all that an outbox holds.
  static const size_t MESSAGE_CAPACITY = Outbox::CAPACITY;

  Connection();

  /// Gets the shared buffer. To be called in DoInit, before anything else.
  /// @param object whose entries ListenCont, SendCont, ReceiveCont and CloseCont are called
  /// @return false if the IPStack has no memory for it
  bool Create(OID object);

  /// Gives the shared buffer back.
  void Destroy();

  bool IsClosed() const { return state_ == CLOSED; }
  bool IsListening() const { return state_ == LISTENING; }

  /// True if an answer with this continuation belongs to the endpoint that this connection has now. Answers that
  /// concern an endpoint of the past are to be ignored.
  bool Owns(const void* continuation) const;

  /// From CLOSED to LISTENING.
  /// @param endpoint_number that no other endpoint of the object has had
  /// @return false if the IPStack refuses; it may be tried again later
  bool Listen(Port port, size_t endpoint_number);

  /// The answer to Listen(): from LISTENING to CONNECTED.
  void Accepted(const TCPEndpointListenMsg& answer);

  /// From any state to CLOSING; to CLOSED if the IPStack refuses.
  /// @param abort true: with a reset, for a client taken for dead or turned away; false: what was sent still arrives
  /// @param now OPEN-R frame
  void Close(bool abort, longword now);

  /// Aborts an orderly close that takes too long.
  /// @param now OPEN-R frame
  void PassTime(longword now);

  /// The answer to Close(): from CLOSING to CLOSED.
  void Closed();

  /// True while a message or a picture is being sent.
  bool IsSending() const { return sending_; }

  /// Where to put the next message, MESSAGE_CAPACITY bytes. Not while IsSending().
  byte* MessageBuffer() const { return buffer_; }

  /// Sends the message in MessageBuffer(). Not while IsSending().
  /// @return false if the IPStack refuses
  bool SendMessage(size_t size) { return Send(MessageBuffer(), size); }

  /// True while there is a picture that has not been sent to its end.
  bool HasPicture() const { return picture_size_ > 0; }

  /// True while there is a picture of which nothing has been sent.
  bool HasWaitingPicture() const { return HasPicture() && !is_sending_picture_; }

  /// Where to put the next picture, PICTURE_CAPACITY bytes. Not while HasPicture().
  byte* PictureBuffer() const { return MessageBuffer() + MESSAGE_CAPACITY + Session::MAX_PICTURE_HEADER_SIZE; }

  /// Hands over the picture in PictureBuffer(): it waits.
  /// @param header, header_size what goes before it, up to Session::MAX_PICTURE_HEADER_SIZE bytes
  void PutPicture(const byte* header, size_t header_size, size_t size);

  /// Drops the picture that waits.
  void DropWaitingPicture() { picture_size_ = 0; }

  /// Sends the picture that waits. Not while IsSending().
  /// @return false if the IPStack refuses
  bool SendWaitingPicture();

  /// The answer to a send: sends the next part, if there is one.
  /// @return false if the IPStack refuses
  bool Sent();

  /// Asks the IPStack for bytes, unless it has been asked already.
  /// @return false if it refuses
  bool Receive();

  /// The answer to Receive().
  void Received() { receiving_ = false; }

  /// The bytes that Received() has brought, until the next Receive().
  const byte* ReceivedBytes() const { return ReceiveBuffer(); }

  /// True if a client has come since Listen().
  bool HadClient() const { return client_name_[0] != '\0'; }

  /// The client's address as a number; 127.0.0.1 is 0x7f000001.
  unsigned ClientAddress() const { return client_address_; }

  /// The client's address, "192.168.1.2:40000".
  const char* ClientName() const { return client_name_; }

 private:
  enum State { CLOSED, LISTENING, CONNECTED, CLOSING };

  Connection(const Connection&);
  Connection& operator=(const Connection&);

  // Parts of the shared buffer, in this order: a message, a picture with its header, what is received.
  static const size_t PICTURE_SIZE = Session::MAX_PICTURE_HEADER_SIZE + PICTURE_CAPACITY;
  static const size_t RECEIVE_SIZE = Session::INPUT_CAPACITY;

  bool Send(byte* bytes, size_t size);
  bool SendPart();
  bool Post(antEnvMsg& message, Selector entry, size_t size);
  byte* ReceiveBuffer() const { return buffer_ + MESSAGE_CAPACITY + PICTURE_SIZE; }

  OID object_;
  antStackRef stack_;
  antSharedBuffer shared_buffer_;
  byte* buffer_;
  antModuleRef endpoint_;
  size_t endpoint_number_;
  State state_;
  bool aborting_;         ///< in CLOSING
  longword close_began_;  ///< in CLOSING: the frame in which it began
  bool sending_;
  byte* unsent_;  ///< what is left of the message or picture that is being sent
  size_t unsent_size_;
  bool receiving_;
  byte* picture_;            ///< with its header
  size_t picture_size_;      ///< 0: there is none
  bool is_sending_picture_;  ///< else it waits
  unsigned client_address_;
  char client_name_[sizeof("255.255.255.255:65535")];
};

#endif  // AIBO_RCSERVER_RCSERVER_CONNECTION_H
