/// @file Connection.h
/// One place for a client at the IPStack.
#ifndef RCSERVER_CONNECTION_H
#define RCSERVER_CONNECTION_H

#include <OPENR/OPENR.h>
#include <TCPEndpointMsg.h>
#include <ant.h>

#include "protocol/request_reader.h"
#include "protocol/version1.h"

/// Listens, serves one client and closes, again and again: each time with a new endpoint, because an endpoint of the
/// IPStack serves one connection.
///
/// At most one send and one receive are under way at a time. Replies that cannot be sent at once are kept, in order.
/// While any are kept nothing is received: a client that asks without reading the answers is slowed down by TCP, and
/// the memory for replies has a fixed size.
class Connection {
 public:
  enum State { CLOSED, LISTENING, CONNECTED, CLOSING };

  /// Bytes of a picture that can be sent: 100 KiB, which hold any 208x160 picture (JpegEncoder::WorstCaseSize).
  static const size_t PICTURE_CAPACITY = 100 * 1024;

  Connection();

  /// Gets the shared buffer. To be called in DoInit, before anything else.
  /// @param object whose entries ListenCont, SendCont, ReceiveCont and CloseCont are called
  /// @return false if the IPStack has no memory for it
  bool Create(OID object);

  /// Gives the shared buffer back.
  void Destroy();

  State GetState() const { return state_; }

  /// True if an answer with this continuation belongs to the endpoint that this connection has now. Answers that
  /// concern an endpoint of the past are to be ignored.
  bool Owns(const void* continuation) const;

  /// From CLOSED to LISTENING.
  /// @return false if the IPStack refuses; it may be tried again later
  bool Listen(Port port);

  /// The answer to Listen(): from LISTENING to CONNECTED.
  void Accepted(const TCPEndpointListenMsg& answer);

  /// From any state to CLOSING.
  /// @param abort true: with a reset, for a client taken for dead; false: what was sent still arrives
  void Close(bool abort);

  /// The answer to Close(): from CLOSING to CLOSED.
  void Closed();

  /// Where to put the next picture, PICTURE_CAPACITY bytes. Not while IsSending().
  byte* PictureBuffer();

  /// Sends the picture in PictureBuffer(), header and picture at once. Not while IsSending().
  /// @return false if the IPStack refuses
  bool SendPicture(size_t size);

  /// Keeps a reply, to be sent by Continue().
  void AddReply(const protocol::ValueReply& reply);

  /// A send is under way.
  bool IsSending() const { return sending_; }

  /// The answer to a send.
  void Sent() { sending_ = false; }

  /// The answer to a receive: its bytes are for NextRequest() now.
  void Received(const TCPEndpointReceiveMsg& answer);

  /// The next request of the client.
  /// @return false if there is no whole one
  bool NextRequest(protocol::Request* request) { return reader_.next(request); }

  /// Sends kept replies and receives more, as far as that is possible now. To be called whenever something was done.
  /// @return false if the IPStack refuses
  bool Continue();

  /// True if a client has come since Listen().
  bool HadClient() const { return client_name_[0] != '\0'; }

  /// The client's address, "192.168.1.2:40000".
  const char* ClientName() const { return client_name_; }

 private:
  Connection(const Connection&);
  Connection& operator=(const Connection&);

  // Of the shared buffer: what is sent, then what is received.
  static const size_t SEND_SIZE = protocol::PICTURE_HEADER_SIZE + PICTURE_CAPACITY;
  static const size_t RECEIVE_SIZE = protocol::RequestReader::MAX_APPENDED;

  bool Send(size_t size);
  bool Receive();
  bool Post(antEnvMsg& message, Selector entry, size_t size);
  byte* SendBuffer() const { return buffer_; }
  byte* ReceiveBuffer() const { return buffer_ + SEND_SIZE; }

  OID object_;
  antStackRef stack_;
  antSharedBuffer shared_buffer_;
  byte* buffer_;
  antModuleRef endpoint_;
  size_t endpoint_number_;  ///< of all endpoints ever made, one a number
  State state_;
  bool sending_;
  bool receiving_;
  protocol::RequestReader reader_;
  byte replies_[protocol::RequestReader::MAX_REQUESTS * protocol::VALUE_REPLY_SIZE];
  size_t replies_size_;
  char client_name_[sizeof("255.255.255.255:65535")];
};

#endif  // RCSERVER_CONNECTION_H
