#ifndef AIBO_RCSERVER_RCSERVER_CONNECTION_H
#define AIBO_RCSERVER_RCSERVER_CONNECTION_H

#include <OPENR/OPENR.h>
#include <TCPEndpointMsg.h>
#include <ant.h>

#include <algorithm>

#include "picture_encoder/PictureJob.h"
#include "rcserver/Outbox.h"
#include "rcserver/Session.h"
#include "rcserver/SharedBuffer.h"

/// Listens, serves one client, closes and listens again, each time with a new endpoint, because an endpoint of the
/// IPStack serves only one connection.
///
/// At most one send and one receive are under way at a time. Messages and pictures are sent in parts of at most
/// MAX_PART_SIZE bytes, each after the IPStack has accepted the previous one.
///
/// The IPStack answers an orderly close only after the client has closed, too (Internet Protocol Version4, 2.2 and
/// 2.7). If the client takes longer than CLOSE_PATIENCE, the connection is aborted.
class Connection {
 public:
  /// Most bytes that are passed to the IPStack at once. Nearly every picture fits, including its header.
  static const size_t MAX_PART_SIZE = 8 * 1024;

  /// Longest time for an orderly close, in frames: 2 s.
  static const longword CLOSE_PATIENCE = 250;

  /// Bytes that can be sent at once: a picture with its header, or everything that an outbox holds.
  static const size_t PICTURE_SIZE = Session::MAX_PICTURE_HEADER_SIZE + ENCODED_PICTURE_CAPACITY;
  static const size_t SEND_CAPACITY = PICTURE_SIZE > Outbox::CAPACITY ? PICTURE_SIZE : Outbox::CAPACITY;

  Connection();

  /// Gets the shared buffer. Call this in DoInit, before anything else.
  /// @param object whose entries ListenCont, SendCont, ReceiveCont and CloseCont are called
  /// @return false if the IPStack has no memory for it
  bool Create(OID object);

  void Destroy();

  bool IsClosed() const { return state_ == CLOSED; }
  bool IsListening() const { return state_ == LISTENING; }

  /// True if an answer with this continuation belongs to this connection's current endpoint. Answers to earlier
  /// endpoints must be ignored.
  bool Owns(const void* continuation) const;

  /// Starts to listen. Call it only if IsClosed().
  /// @param endpoint_number different from those of all earlier endpoints
  /// @return false if the IPStack refuses; try again later
  bool Listen(Port port, size_t endpoint_number);

  /// The answer to Listen(): a client is connected.
  void Accepted(const TCPEndpointListenMsg& answer);

  /// Begins to close the connection. If the IPStack refuses, the connection counts as closed.
  /// @param abort true: reset the connection, for a client that is turned away or considered dead; false: data already
  ///   sent still arrives
  void Close(bool abort);

  /// Call this in each frame, before anything else. It aborts an orderly close that takes too long.
  /// @param now OPEN-R frame
  void PassTime(longword now);

  /// The answer to Close().
  void Closed();

  bool IsSending() const { return client_.sending; }
  bool IsSendingPicture() const { return client_.is_sending_picture; }

  /// Buffer of SEND_CAPACITY bytes for the next message or picture. Do not use it while IsSending().
  byte* SendBuffer() const { return buffer_.Bytes(); }

  /// Sends the contents of SendBuffer(). Do not call while IsSending().
  /// @return false if the IPStack refuses
  bool Send(size_t size, bool is_picture);

  /// The answer to a send: sends the next part, if there is one.
  /// @return false if the IPStack refuses
  bool Sent();

  /// Asks the IPStack for bytes, unless a receive is under way or half of the buffer holds bytes that have not been
  /// taken. So a message that the client sends in one piece is rarely split, and a close by the client is noticed even
  /// while received bytes wait.
  /// @return false if the IPStack refuses
  bool Receive();

  /// Why a send or a receive has failed, in words for the console.
  static const char* ReasonOf(TCPEndpointError error);

  void Received(size_t size);
  const byte* ReceivedBytes() const { return ReceiveBuffer() + client_.received_begin; }
  size_t ReceivedSize() const { return client_.received_end - client_.received_begin; }
  void TakeReceived() { client_.received_begin = client_.received_end; }

  /// True if a client has connected since the last call of Listen().
  bool HadClient() const { return client_.name[0] != '\0'; }

  /// OPEN-R frames since the client connected.
  longword FramesConnected() const { return now_ - client_.connected; }

  /// Frames since bytes last came from the client.
  longword FramesWithoutBytes() const { return now_ - client_.last_bytes; }

  /// Frames since the client's last sign of life: bytes came from it, or a send was completed.
  longword FramesWithoutSign() const { return std::min(FramesWithoutBytes(), now_ - client_.last_sent); }

  /// Frames since bytes came from the client, or the client took bytes that had waited in the IPStack.
  longword FramesQuiet() const { return std::min(FramesWithoutBytes(), now_ - client_.last_taken); }

  /// The client's address as a number; 127.0.0.1 is 0x7f000001.
  unsigned ClientAddress() const { return client_.address; }

  /// The client's address, "192.168.1.2:40000".
  const char* ClientName() const { return client_.name; }

 private:
  enum State { CLOSED, LISTENING, CONNECTED, CLOSING };

  // What is known about the client. Everything is 0 until a client has connected.
  struct Client {
    bool sending;
    bool is_sending_picture;
    byte* unsent;  ///< the rest of the message or picture that is being sent
    size_t unsent_size;
    bool receiving;
    size_t received_begin;  ///< offset of the first byte that has not been taken
    size_t received_end;    ///< offset for the next received bytes
    longword connected;
    longword last_bytes;  ///< frame in which bytes last came
    longword last_given;  ///< frame in which the IPStack was last given something to send
    longword last_sent;   ///< frame in which it last accepted something
    longword last_taken;  ///< frame in which it last accepted something that it had been given earlier
    unsigned address;
    char name[sizeof("255.255.255.255:65535")];
  };

  static const size_t RECEIVE_SIZE = Session::INPUT_CAPACITY;

  bool SendPart();
  bool Post(antEnvMsg& message, Selector entry, size_t size);
  byte* ReceiveBuffer() const { return buffer_.Bytes() + SEND_CAPACITY; }

  OID object_;
  antStackRef stack_;
  SharedBuffer buffer_;  ///< SendBuffer(), then received bytes
  antModuleRef endpoint_;
  size_t endpoint_number_;
  State state_;
  longword now_;
  bool aborting_;         ///< in CLOSING
  longword close_began_;  ///< in CLOSING: frame in which the close began
  Client client_;
};

#endif  // AIBO_RCSERVER_RCSERVER_CONNECTION_H
