/// @file CameraImage.h
/// One layer of a camera image, as the robot delivers it.
#ifndef AIBO_RCSERVER_PICTURE_ENCODER_CAMERA_IMAGE_H
#define AIBO_RCSERVER_PICTURE_ENCODER_CAMERA_IMAGE_H

#include <stddef.h>

/// The planes Y, Cr and Cb of one layer, each of full width and height. The camera interleaves their rows, so two rows
/// of a plane are `stride` bytes apart.
///
/// The camera overwrites the first TAG_SIZE bytes of the last row (OPENR/OFbkImage.h): with its counter of images,
/// which counts all of them, delivered or not, and with results of its colour detection.
struct CameraImage {
  /// Pixels at the beginning of the last row that the camera overwrites.
  static const size_t TAG_SIZE = 16;

  const unsigned char* y;
  const unsigned char* cr;
  const unsigned char* cb;
  size_t width;   ///< pixels
  size_t height;  ///< pixels
  size_t stride;  ///< bytes from one row to the next of the same plane: width + skip
};

/// The bands of fine detail that belong to a CameraImage, with its width, height and stride. An ERS-7 splits the
/// luminance of its sensor, which has twice the width and height of layer H, into Y and these three.
///
/// 128 is no detail. With ll of Y, and lh, hl, hh less 128, the four pixels in place of one of Y are
/// ll - lh - hl + hh (upper left), ll - lh + hl - hh (upper right), ll + lh - hl - hh (lower left) and
/// ll + lh + hl + hh (lower right), limited to 0..255 (Sony's sample W3AIBO, JPEGEncoder.cc).
struct DetailBands {
  const unsigned char* lh;
  const unsigned char* hl;
  const unsigned char* hh;
};

#endif  // AIBO_RCSERVER_PICTURE_ENCODER_CAMERA_IMAGE_H
