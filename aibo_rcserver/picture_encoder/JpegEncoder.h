/// @file JpegEncoder.h
/// From a camera image to a JPEG file in memory.
#ifndef AIBO_RCSERVER_PICTURE_ENCODER_JPEG_ENCODER_H
#define AIBO_RCSERVER_PICTURE_ENCODER_JPEG_ENCODER_H

#include <setjmp.h>
#include <stddef.h>
#include <stdio.h>

// libjpeg 6b does not say extern "C" itself.
extern "C" {
#include <jpeglib.h>
}

#include "rcserver/camera/CameraImage.h"

/// Encodes camera images as baseline JPEG, YCbCr 4:2:0, with the calls that libjpeg 6b and libjpeg-turbo share.
///
/// The planes go into the encoder as they are: no RGB in between, and no copy if 16 divides the width. The camera's tag
/// bytes are painted over with the row above, in the encoder's own copy of the row. libjpeg takes its working memory
/// for each picture and gives it back. No libjpeg error ends the process: each makes Encode() fail. Not thread-safe.
class JpegEncoder {
 public:
  /// Largest width and height, in pixels: twice the camera's, for pictures of double resolution.
  static const size_t MAX_WIDTH = 416;
  static const size_t MAX_HEIGHT = 320;

  JpegEncoder();
  ~JpegEncoder();

  /// Bytes that hold a picture of this size whatever it shows and whatever its quality: three bytes a pixel, with
  /// width and height rounded up to 16, and 2048 for the headers. This is libjpeg-turbo's own bound (tjBufSize) for
  /// 4:2:0. The report's 64 KB (section 3.3.3) are not enough: noise at quality 100 takes up to 77 KB.
  static size_t WorstCaseSize(size_t width, size_t height);

  /// Encodes one image.
  /// @param quality 0..100
  /// @param[out] jpeg the JPEG file
  /// @param capacity bytes that fit into `jpeg`
  /// @return bytes of the JPEG file; 0 on failure, whose reason LastError() tells: an image that is empty or larger
  ///         than MAX_WIDTH x MAX_HEIGHT, a buffer too small, no memory
  size_t Encode(const CameraImage& image, int quality, unsigned char* jpeg, size_t capacity);

  /// Why Encode() failed the last time, in words.
  const char* LastError() const { return errors_.message; }

 private:
  // What libjpeg reports errors to. Its first member is libjpeg's, so that a pointer to the one is a pointer to the
  // other; the same goes for Destination.
  struct Errors {
    jpeg_error_mgr manager;
    jmp_buf escape;
    char message[JMSG_LENGTH_MAX];
  };
  struct Destination {
    jpeg_destination_mgr manager;
    unsigned char* buffer;
    size_t capacity;
  };

  static void Fail(j_common_ptr compress);
  static void Ignore(j_common_ptr compress);
  static void BeginBuffer(j_compress_ptr compress);
  static boolean BufferIsFull(j_compress_ptr compress);
  static void EndBuffer(j_compress_ptr compress);

  JpegEncoder(const JpegEncoder&);
  JpegEncoder& operator=(const JpegEncoder&);

  // One row of macroblocks: what libjpeg takes at once.
  static const size_t STRIP_HEIGHT = 16;
  typedef unsigned char Strip[STRIP_HEIGHT][MAX_WIDTH];
  typedef unsigned char HalfStrip[STRIP_HEIGHT / 2][MAX_WIDTH / 2];

  void Configure(size_t width, size_t height, int quality);
  void WriteStrips(const CameraImage& image);
  static void FindRows(const CameraImage& image, const unsigned char* plane, size_t top, Strip copies,
                       JSAMPROW rows[STRIP_HEIGHT]);
  static void CopyRow(const unsigned char* source, const unsigned char* source_of_tag, size_t width, JSAMPROW copy);
  static void Halve(const JSAMPROW rows[STRIP_HEIGHT], size_t width, const JSAMPROW half[STRIP_HEIGHT / 2]);

  jpeg_compress_struct compress_;
  Errors errors_;
  Destination destination_;
  bool created_;
  int quality_;
  Strip y_copies_;
  Strip chroma_copies_;  // Cb, then Cr, before it is halved
  HalfStrip cb_;
  HalfStrip cr_;
};

#endif  // AIBO_RCSERVER_PICTURE_ENCODER_JPEG_ENCODER_H
