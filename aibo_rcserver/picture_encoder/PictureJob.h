/// @file PictureJob.h
/// The messages between RCServer and PictureEncoder.
#ifndef AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_JOB_H
#define AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_JOB_H

#include <stddef.h>

/// The largest image of a camera: layer H of an ERS-7.
const size_t MAX_IMAGE_WIDTH = 208;
const size_t MAX_IMAGE_HEIGHT = 160;

/// Bytes that hold any picture of that size (JpegEncoder::WorstCaseSize() says 101888), and any of double resolution
/// that a camera makes. Noise in double resolution does not fit at high qualities; it is made again at CAREFUL_QUALITY,
/// at which it does. More would fit into a frame, but shared memory of the IPStack is not known to be plentiful.
const size_t ENCODED_PICTURE_CAPACITY = 128 * 1024;
const int CAREFUL_QUALITY = 25;

/// RCServer.EncodeJob: make a picture of this image.
struct PictureJob {
  unsigned ticket;  ///< comes back with the picture; not 0
  int quality;      ///< JPEG quality, 0..100
  size_t width;     ///< pixels of the image, 1..MAX_IMAGE_WIDTH
  size_t height;    ///< pixels of the image, 1..MAX_IMAGE_HEIGHT
  bool is_double;   ///< the picture has twice its width and height
  /// Rows of Y, Cr and Cb in turn, `width` bytes each, as in the camera image, with the camera's tag; if is_double,
  /// each followed by the same rows of Y_LH, Y_HL and Y_HH.
  unsigned char pixels[6 * MAX_IMAGE_WIDTH * MAX_IMAGE_HEIGHT];
};

/// PictureEncoder.Picture: the picture, or why there is none.
struct EncodedPicture {
  static const size_t MAX_PROBLEM_SIZE = 256;

  unsigned ticket;                 ///< of the job
  int quality;                     ///< at which it was made: the job's, or CAREFUL_QUALITY
  size_t size;                     ///< bytes of the JPEG file; 0: there is none
  char problem[MAX_PROBLEM_SIZE];  ///< why there is none, in words; empty if there is one
  unsigned char jpeg[ENCODED_PICTURE_CAPACITY];
};

#endif  // AIBO_RCSERVER_PICTURE_ENCODER_PICTURE_JOB_H
