/// @file CameraImage.h
/// One layer of a camera image, as the robot delivers it.
#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_CAMERA_IMAGE_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_CAMERA_IMAGE_H

#include <stddef.h>

/// Planes Y, Cr and Cb of one layer, each of full width and height. The camera interleaves their rows, so a row of one
/// plane is `stride` bytes from its next one.
///
/// Where the picture of the last row should begin, the camera puts TAG_SIZE bytes of its own (OPENR/OFbkImage.h):
/// two of them are the camera's counter of images, the rest belongs to its colour detection.
struct CameraImage {
  /// Pixels at the beginning of the last row that are no picture.
  static const size_t TAG_SIZE = 16;

  const unsigned char* y;
  const unsigned char* cr;
  const unsigned char* cb;
  size_t width;   ///< pixels
  size_t height;  ///< pixels
  size_t stride;  ///< bytes from one row to the next of the same plane: width + skip

  /// The camera's counter of images, 0..65535: it goes up by one an image, delivered or not.
  unsigned short FieldCounter() const {
    const unsigned char* tag = y + (height - 1) * stride;
    return static_cast<unsigned short>(tag[0] | (tag[1] << 8));
  }
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_CAMERA_IMAGE_H
