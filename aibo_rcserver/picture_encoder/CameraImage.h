/// @file CameraImage.h
/// One layer of a camera image, as the robot delivers it.
#ifndef AIBO_RCSERVER_PICTURE_ENCODER_CAMERA_IMAGE_H
#define AIBO_RCSERVER_PICTURE_ENCODER_CAMERA_IMAGE_H

#include <stddef.h>

/// The planes Y, Cr and Cb of one layer, each of full width and height. The camera interleaves their rows, so rows of a
/// plane are `stride` bytes apart.
///
/// The camera overwrites the first TAG_SIZE bytes of the last row (OPENR/OFbkImage.h) with its counter of all images,
/// delivered or not, and with results of its colour detection.
struct CameraImage {
  /// How many pixels the camera overwrites at the beginning of the last row.
  static const size_t TAG_SIZE = 16;

  const unsigned char* y;
  const unsigned char* cr;
  const unsigned char* cb;
  size_t width;
  size_t height;
  size_t stride;  ///< bytes between rows of the same plane: width + skip
};

/// The bands of fine detail for a CameraImage, with its width, height and stride. An ERS-7 splits the luminance of its
/// sensor, which has twice the width and height of layer H, into Y and these three bands.
///
/// A value of 128 means no detail. With ll from Y and 128 subtracted from lh, hl and hh, one pixel of Y becomes four,
/// each limited to 0..255 (Sony's sample W3AIBO, JPEGEncoder.cc):
///
///     ll - lh - hl + hh    ll - lh + hl - hh
///     ll + lh - hl - hh    ll + lh + hl + hh
struct DetailBands {
  const unsigned char* lh;
  const unsigned char* hl;
  const unsigned char* hh;
};

#endif  // AIBO_RCSERVER_PICTURE_ENCODER_CAMERA_IMAGE_H
