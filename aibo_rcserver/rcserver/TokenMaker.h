/// @file TokenMaker.h
/// Tokens by which the robot knows its clients again.
#ifndef AIBO_RCSERVER_RCSERVER_TOKEN_MAKER_H
#define AIBO_RCSERVER_RCSERVER_TOKEN_MAKER_H

#include <OPENR/ODataFormats.h>

#include "protocol/hello.h"

/// Makes tokens of 64 bits that nobody can guess who does not see the robot's network traffic.
///
/// OPEN-R has no random numbers. They come from the noise of the camera's first image and of those that become
/// pictures, and from when clients come. Hundreds of pixels of an image, whose lowest bits are noise, are more than
/// enough. A client of a robot whose camera is covered gets a token with fewer random bits. On a computer, the
/// simulator adds random numbers of the system. This is no cryptography: it keeps mistakes out, not an attacker who
/// listens.
class TokenMaker {
 public:
  TokenMaker();

  /// Mixes something unpredictable in.
  void Stir(unsigned value);

  /// The same with some of the image's pixels.
  void Stir(OFbkImageVectorData* image);

  /// Whether there has been an image yet.
  bool HasImage() const { return has_image_; }

  /// Makes a token that is different from all before.
  void Make(char (&token)[protocol::version2::TOKEN_SIZE + 1]);

 private:
  unsigned one_;  // 32 bits each, mixed in different ways
  unsigned other_;
  bool has_image_;
};

#endif  // AIBO_RCSERVER_RCSERVER_TOKEN_MAKER_H
