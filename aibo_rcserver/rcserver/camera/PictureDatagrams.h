/// @file PictureDatagrams.h
/// The pictures of the stream by UDP.
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

  /// Sends the stream's pictures to this port of the client's computer from now on. Drops a picture that is being sent
  /// to another port.
  /// @param port 0 stops sending datagrams
  /// @return false if the IPStack refuses; then no datagrams are sent
  virtual bool SendTo(Port port) = 0;
};

/// Sends pictures only to the client, in datagrams that no network has to fragment (protocol/picture_datagram.h). Each
/// datagram follows after the IPStack has accepted the previous one.
///
/// UDP has no flow control, and on a slow radio link old pictures would fill the radio's queue. So at most
/// MOST_UNACKNOWLEDGED pictures are in flight. The client acknowledges each picture. Without an acknowledgement, the
/// next picture is sent after a timeout.
///
/// When the client reports a loss, the next PROTECTED_PICTURES have parities, so that the client can rebuild a lost
/// datagram.
class PictureDatagrams : public DatagramSwitch {
 public:
  /// Most pictures in flight: two, so that the radio does not idle while an acknowledgement is on its way.
  static const unsigned MOST_UNACKNOWLEDGED = 2;

  /// Timeout for an acknowledgement, in frames: PATIENCE, and PATIENCE_PER_PART for each part of the last picture. A
  /// part takes 12 ms at 1 Mbit/s.
  static const longword PATIENCE = 6;
  static const longword PATIENCE_PER_PART = 2;

  /// Pictures that have parities after a loss: about 2 s at full rate. If more than one datagram in 300 is lost, nearly
  /// all pictures have parities.
  static const unsigned PROTECTED_PICTURES = 64;

  PictureDatagrams();
  virtual ~PictureDatagrams() {}

  /// Gets the shared buffer. Call in DoInit, before anything else.
  /// @param object whose entry DatagramCont is called
  /// @return false if the IPStack has no memory for it
  bool Create(OID object);

  /// Gives the shared buffer back.
  void Destroy();

  /// A client is connected from this address.
  void ClientConnected(unsigned address) { receiver_ = address; }

  virtual bool SendTo(Port port);

  /// True if pictures of the stream go as datagrams.
  bool IsOn() const { return port_ != 0; }

  /// True while a picture has not been sent completely.
  bool HasPicture() const { return unsent_part_ < number_of_parts_ || is_sending_parity_; }

  /// False while too many pictures are unacknowledged.
  /// @param now OPEN-R frame
  bool MaySend(longword now) const;

  /// Begins to send a picture. Call it only if IsOn() and not HasPicture().
  /// @param jpeg `size` bytes, which are copied
  /// @param now OPEN-R frame
  void Send(const protocol::version2::ImageHeader& image, const byte* jpeg, size_t size, longword now);

  /// Handles the IPStack's answer to a datagram, and sends the next one if there is one.
  void Sent(const UDPEndpointSendMsg& answer);

  /// Handles a received datagram. All but the client's acknowledgements and reports of losses are ignored.
  void Received(const UDPEndpointReceiveMsg& answer);

 private:
  PictureDatagrams(const PictureDatagrams&);
  PictureDatagrams& operator=(const PictureDatagrams&);

  bool Open(Port port);
  void Close();
  bool GroupEnds() const;
  void SendPart();
  void SendParity();
  void SendDatagram(byte* datagram, size_t content_size);
  void Receive();
  byte* ReceiveBuffer() const;
  byte* ParityBuffer() const;

  OID object_;
  antStackRef stack_;
  SharedBuffer buffer_;  ///< room for the header of a datagram, the JPEG, a datagram with a parity, a received one
  antModuleRef endpoint_;
  size_t endpoint_number_;  ///< different for each endpoint, so that answers to earlier ones can be recognised
  unsigned receiver_;       ///< the client's address
  Port port_;               ///< 0: there is no endpoint
  protocol::version2::PictureDatagram next_;
  size_t unsent_part_;
  size_t number_of_parts_;
  bool has_parities_;         ///< the picture that is being sent
  bool is_sending_parity_;    ///< of the group before unsent_part_
  unsigned to_be_protected_;  ///< number of next pictures that get parities
  unsigned acknowledged_;     ///< number of acknowledged pictures
  longword last_begun_;       ///< frame in which a picture was last begun
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_DATAGRAMS_H
