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

/// What a client's requests can do about datagrams.
class DatagramSwitch {
 public:
  virtual ~DatagramSwitch() {}

  /// Has the pictures of the stream sent to this port of the client's computer from now on. A picture that is being
  /// sent to another port is dropped.
  /// @param port 0: they are not sent as datagrams any more
  /// @return false if the IPStack refuses; then they are not sent as datagrams
  virtual bool SendTo(Port port) = 0;
};

/// Sends pictures to the client, and to nobody else, in datagrams that no network has to cut
/// (protocol/picture_datagram.h). One datagram is under way at a time: the next follows when the IPStack has taken it.
///
/// UDP itself does not slow a sender down, and on a slow radio link old pictures would fill the queue of the radio. So
/// at most MOST_UNACKNOWLEDGED pictures are on their way: the client acknowledges each, and without an acknowledgement
/// the next one goes after a while.
///
/// When the client reports a loss, the next PROTECTED_PICTURES have parities, so that they become whole even if they
/// lose a datagram.
class PictureDatagrams : public DatagramSwitch {
 public:
  /// Two, so that the radio does not wait for the acknowledgement.
  static const unsigned MOST_UNACKNOWLEDGED = 2;

  /// Frames without an acknowledgement until the next picture goes all the same: this many, and PATIENCE_PER_PART for
  /// each part of the last picture. A part takes 12 ms at 1 Mbit/s.
  static const longword PATIENCE = 6;
  static const longword PATIENCE_PER_PART = 2;

  /// About 2 s at full rate: if more than one datagram in 300 is lost, nearly all pictures have parities.
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

  /// True while there is a picture that has not been sent completely.
  bool HasPicture() const { return unsent_part_ < number_of_parts_ || is_sending_parity_; }

  /// False while enough pictures are on their way.
  /// @param now OPEN-R frame
  bool MaySend(longword now) const;

  /// Begins to send a picture. Only if IsOn() and not HasPicture().
  /// @param jpeg of `size` bytes, is copied
  /// @param now OPEN-R frame
  void Send(const protocol::version2::ImageHeader& image, const byte* jpeg, size_t size, longword now);

  /// The IPStack's answer to a datagram: sends the next one, if there is one.
  void Sent(const UDPEndpointSendMsg& answer);

  /// A datagram has come. Only the client's acknowledgements and reports of losses count.
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
  size_t endpoint_number_;  ///< different for each endpoint, so that answers to earlier ones can be told
  unsigned receiver_;       ///< the client's address
  Port port_;               ///< 0: there is no endpoint
  protocol::version2::PictureDatagram next_;
  size_t unsent_part_;
  size_t number_of_parts_;
  bool has_parities_;         ///< the picture that is being sent
  bool is_sending_parity_;    ///< of the group before unsent_part_
  unsigned to_be_protected_;  ///< pictures that shall have parities
  unsigned acknowledged_;     ///< pictures, counted from the first
  longword last_begun_;       ///< frame in which a picture was last begun
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_PICTURE_DATAGRAMS_H
