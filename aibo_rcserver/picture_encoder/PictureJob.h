/// @file PictureJob.h
/// The messages between RCServer and PictureEncoder.
#ifndef AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_JOB_H
#define AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_JOB_H

#include <stddef.h>

/// The largest image of a camera: layer H of an ERS-7.
const size_t MAX_IMAGE_WIDTH = 208;
const size_t MAX_IMAGE_HEIGHT = 160;

/// Room for any picture of that size, and any real picture at double resolution. libjpeg-turbo's bound (tjBufSize) for
/// that size is 101888; the report's 64 KB (section 3.3.3) are too few. Noise at double resolution does not fit at high
/// qualities; it is encoded again at CAREFUL_QUALITY, which fits. There is not more room, because the IPStack's shared
/// memory may be scarce.
const size_t ENCODED_PICTURE_CAPACITY = 128 * 1024;
const int CAREFUL_QUALITY = 25;

/// RCServer.EncodeJob: an image to encode.
struct PictureJob {
  unsigned ticket;  ///< the job's number, not 0, which the picture repeats
  int quality;      ///< JPEG quality, 0..100
  size_t width;     ///< 1..MAX_IMAGE_WIDTH
  size_t height;    ///< 1..MAX_IMAGE_HEIGHT
  bool is_double;   ///< the picture has twice the image's width and height
  /// Rows of Y, Cr and Cb in turn, `width` bytes each, with the camera's tag. If is_double, each Y, Cr and Cb is
  /// followed by the same rows of Y_LH, Y_HL and Y_HH.
  unsigned char pixels[6 * MAX_IMAGE_WIDTH * MAX_IMAGE_HEIGHT];
};

/// PictureEncoder.Picture: the picture, or why there is none.
struct EncodedPicture {
  static const size_t MAX_PROBLEM_SIZE = 256;

  unsigned ticket;                 ///< the job's ticket
  int quality;                     ///< the quality that was used: the job's, or CAREFUL_QUALITY
  size_t size;                     ///< bytes of the JPEG file; 0 if there is no picture
  char problem[MAX_PROBLEM_SIZE];  ///< why there is no picture, in words; empty if there is one
  unsigned char jpeg[ENCODED_PICTURE_CAPACITY];
};

#endif  // AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_JOB_H
