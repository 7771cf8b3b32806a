/// @file JpegEncoder.h
/// Encodes a camera image as a JPEG file in memory.
#ifndef AIBO_RCSERVER_PICTURE_ENCODER_JPEG_ENCODER_H
#define AIBO_RCSERVER_PICTURE_ENCODER_JPEG_ENCODER_H

#include <setjmp.h>
#include <stddef.h>
#include <stdio.h>

// libjpeg 6b does not say extern "C" itself.
extern "C" {
#include <jpeglib.h>
}

#include "picture_encoder/CameraImage.h"

/// Encodes camera images as baseline JPEG, YCbCr 4:2:0, with the calls that libjpeg 6b and libjpeg-turbo share.
///
/// The planes go into libjpeg as they are: without a conversion to RGB, and without a copy if 16 divides the width. The
/// camera's tag bytes are replaced by the row above, in a copy of the row. libjpeg allocates its working memory for
/// each picture and frees it. An error in libjpeg makes Encode() fail and does not end the process. Not thread-safe.
class JpegEncoder {
 public:
  /// Largest width and height, in pixels: twice the camera's, for pictures of double resolution.
  static const size_t MAX_WIDTH = 416;
  static const size_t MAX_HEIGHT = 320;

  JpegEncoder();
  ~JpegEncoder();

  /// Bytes that hold any picture of this size at any quality: three bytes per pixel, with width and height rounded up
  /// to 16, and 2048 for the headers. This is libjpeg-turbo's own bound (tjBufSize) for 4:2:0. The report's 64 KB
  /// (section 3.3.3) are not enough: noise at quality 100 takes up to 77 KB.
  static size_t WorstCaseSize(size_t width, size_t height);

  /// Encodes one image.
  /// @param quality 0..100
  /// @param[out] jpeg the JPEG file
  /// @param capacity bytes that fit into `jpeg`
  /// @return bytes of the JPEG file; 0 on failure: the image is empty or larger than MAX_WIDTH x MAX_HEIGHT, the buffer
  ///   is too small, or there is no memory. LastError() says which
  size_t Encode(const CameraImage& image, int quality, unsigned char* jpeg, size_t capacity) {
    return EncodeWith(image, NULL, quality, jpeg, capacity);
  }

  /// Encodes an image in double resolution: twice its width and height. Its chroma is taken as it is, because a JPEG of
  /// 4:2:0 halves that of the picture.
  size_t EncodeDouble(const CameraImage& image, const DetailBands& detail, int quality, unsigned char* jpeg,
                      size_t capacity) {
    return EncodeWith(image, &detail, quality, jpeg, capacity);
  }

  /// Why Encode() last failed, in words.
  const char* LastError() const { return errors_.message; }

 private:
  // libjpeg reports errors to this. The first member is libjpeg's own struct, so a pointer to one is a pointer to the
  // other; the same holds for Destination.
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

  // One row of macroblocks, which libjpeg takes at once.
  static const size_t STRIP_HEIGHT = 16;
  typedef unsigned char Strip[STRIP_HEIGHT][MAX_WIDTH];
  typedef unsigned char HalfStrip[STRIP_HEIGHT / 2][MAX_WIDTH / 2];

  size_t EncodeWith(const CameraImage& image, const DetailBands* detail, int quality, unsigned char* jpeg,
                    size_t capacity);
  void Configure(size_t width, size_t height, int quality);
  void WriteStrips(const CameraImage& image, const DetailBands* detail);
  void FillStrip(const CameraImage& image, size_t top, JSAMPROW y_rows[STRIP_HEIGHT]);
  void FillDoubleStrip(const CameraImage& image, const DetailBands& detail, size_t top, JSAMPROW y_rows[STRIP_HEIGHT]);
  static void FindRows(const CameraImage& image, const unsigned char* plane, size_t top, size_t unit, Strip copies,
                       JSAMPROW rows[STRIP_HEIGHT]);
  static void CopyRow(const unsigned char* source, const unsigned char* source_of_tag, size_t width,
                      size_t padded_width, JSAMPROW copy);
  static void Halve(const JSAMPROW rows[STRIP_HEIGHT], size_t width, HalfStrip half);

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
