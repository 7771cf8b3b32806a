#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_DATAGRAMS_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_DATAGRAMS_H

#include <OPENR/OPENR.h>
#include <UDPEndpointMsg.h>
#include <ant.h>

#include "picture_encoder/PictureJob.h"
#include "protocol/picture_datagram.h"
#include "rcserver/SharedBuffer.h"

/// Lets a client's requests switch datagrams on and off.
class DatagramSwitch {
 public:
  virtual ~DatagramSwitch() {}

  /// From now on, sends the stream's pictures, or only a test, to this port of the client's computer. A picture that is
  /// being sent to another port is dropped.
  /// @param order the order; its port is not 0
  /// @return false if the IPStack refuses; in that case no datagrams are sent
  virtual bool SendTo(const protocol::version2::DatagramOrder& order) = 0;

  virtual void Stop() = 0;

  /// Stops sending datagrams. Pictures that the client may not have yet are kept, so that they can be sent by TCP.
  virtual void HandOver() = 0;
};

/// Sends pictures only to the client, in datagrams that no network has to fragment (protocol/picture_datagram.h). Each
/// datagram follows after the IPStack has accepted the previous one.
///
/// UDP has no flow control, and on a slow radio link old pictures would fill the radio's queue. So at most
/// MOST_UNACKNOWLEDGED pictures are in flight. The client's status acknowledges pictures, and has missing parts
/// repeated. If no status comes, the next picture is sent after a timeout.
class PictureDatagrams : public DatagramSwitch {
 public:
  /// Most pictures in flight: two, so that the radio does not idle while a status is on its way. A picture of which
  /// only parts are being repeated does not count.
  static const unsigned MOST_UNACKNOWLEDGED = 2;

  /// Timeout for a status, in frames: PATIENCE, and PATIENCE_PER_PART for each part of the last picture. A part takes
  /// 12 ms at 1 Mbit/s.
  static const longword PATIENCE = 6;
  static const longword PATIENCE_PER_PART = 2;

  /// A picture that was begun this many frames ago is too old to be handed over to TCP: 200 ms.
  static const longword OLDEST_LEFT_OVER = 25;

  PictureDatagrams();
  virtual ~PictureDatagrams() {}

  /// Gets the shared buffer. Call this in DoInit, before anything else.
  /// @param object the object whose entry DatagramCont is called
  /// @return false if the IPStack has no memory for it
  bool Create(OID object);

  void Destroy();

  /// Call this when a client has connected from this address.
  void ClientConnected(unsigned address) { receiver_ = address; }

  virtual bool SendTo(const protocol::version2::DatagramOrder& order);
  virtual void Stop();
  virtual void HandOver();

  bool IsOn() const { return order_.port != 0 && !order_.is_test; }
  bool HasPicture() const { return is_sending_ || HasUnsent(); }

  /// False while too many pictures wait to be acknowledged.
  /// @param now OPEN-R frame
  bool MaySend(longword now) const;

  /// Begins to send a picture. Call it only if IsOn() and not HasPicture().
  /// @param jpeg `size` bytes, which are copied
  /// @param now OPEN-R frame
  void Send(const protocol::version2::ImageHeader& image, const byte* jpeg, size_t size, longword now);

  /// Handles the IPStack's answer to a datagram, and sends the next one if there is one.
  void Sent(const UDPEndpointSendMsg& answer);

  /// Handles a received datagram. Only the client's datagrams count.
  void Received(const UDPEndpointReceiveMsg& answer);

  struct KeptPicture {
    protocol::version2::ImageHeader image;
    const byte* jpeg;
    size_t size;
    longword begun;  ///< OPEN-R frame in which the picture was begun
  };

  /// Takes the oldest picture that HandOver() has kept and that is not too old. It is valid until the next call.
  /// @param now OPEN-R frame
  /// @return NULL if there is none
  const KeptPicture* TakeLeftOver(longword now);

 private:
  bool Open();
  void Close();
  bool HasUnsent() const { return missing_ != 0 || unsent_part_ < number_of_parts_; }
  void Acknowledge(unsigned next_picture);
  void Repeat(const protocol::version2::DatagramStatus& status);
  void SendNext();
  void SendMissingPart();
  void SendPart(unsigned picture, size_t part);
  void SendDatagram(size_t size);
  void DropUnsent();
  void Receive();
  KeptPicture& Kept(unsigned picture) { return kept_[picture % protocol::version2::KEPT_PICTURES]; }
  byte* DatagramBuffer() const;
  byte* ReceiveBuffer() const;

  OID object_;
  antStackRef stack_;
  SharedBuffer buffer_;  ///< room for the kept JPEGs, a datagram, and a received datagram
  antModuleRef endpoint_;
  size_t endpoint_number_;  ///< different for each endpoint, so that answers to earlier ones can be recognised
  unsigned receiver_;       ///< the client's address
  protocol::version2::DatagramOrder order_;  ///< port 0: there is no endpoint
  bool is_sending_;                          ///< a datagram has not been answered by the IPStack yet
  unsigned next_sequence_;                   ///< number of the next datagram
  unsigned next_picture_;                    ///< number of the next picture; the one before it is the current one
  unsigned acknowledged_;                    ///< the client has, or has given up, all pictures before this number
  unsigned left_over_;                       ///< how many of the last pictures are to be sent by TCP
  size_t unsent_part_;                       ///< the next part of the current picture to be sent
  size_t number_of_parts_;                   ///< number of parts of the current picture
  unsigned missing_picture_;                 ///< the picture whose missing parts are to be repeated
  size_t first_missing_;                     ///< bit 0 of missing_ is this part
  unsigned missing_;                         ///< the parts to be repeated, as in DatagramStatus
  bool is_repairing_;                        ///< the parts are those of the oldest picture that is not acknowledged
  KeptPicture kept_[protocol::version2::KEPT_PICTURES];
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_DATAGRAMS_H
