/// @file JpegEncoder.h
#ifndef AIBO_RCSERVER_PICTURE_ENCODER_JPEG_ENCODER_H
#define AIBO_RCSERVER_PICTURE_ENCODER_JPEG_ENCODER_H

#include <setjmp.h>
#include <stddef.h>
#include <stdio.h>

// libjpeg 6b's header lacks extern "C".
extern "C" {
#include <jpeglib.h>
}

#include "picture_encoder/CameraImage.h"

/// Encodes camera images as baseline JPEG, YCbCr 4:2:0. It uses only calls that libjpeg 6b and libjpeg-turbo share.
///
/// The planes go into libjpeg without conversion to RGB, and without a copy if 16 divides the width. In a copy of the
/// last row, the row above replaces the camera's tag. libjpeg allocates and frees its memory for each picture. An error
/// in libjpeg makes Encode() fail and does not end the process. The class is not thread-safe.
class JpegEncoder {
 public:
  /// The largest picture in pixels: twice the camera's size, for double resolution.
  static const size_t MAX_WIDTH = 416;
  static const size_t MAX_HEIGHT = 320;

  JpegEncoder();
  ~JpegEncoder();

  /// @param quality 0..100
  /// @param[out] jpeg the JPEG file
  /// @param capacity bytes that fit into `jpeg`
  /// @return bytes of the JPEG file; 0 on failure: the image is empty or larger than MAX_WIDTH x MAX_HEIGHT, the buffer
  ///   is too small, or memory is lacking. LastError() says which of these it is
  size_t Encode(const CameraImage& image, int quality, unsigned char* jpeg, size_t capacity) {
    return EncodeWith(image, NULL, quality, jpeg, capacity);
  }

  /// Encodes an image at double resolution: twice its width and height. The chroma is used as it is, because JPEG 4:2:0
  /// stores it at half resolution.
  size_t EncodeDouble(const CameraImage& image, const DetailBands& detail, int quality, unsigned char* jpeg,
                      size_t capacity) {
    return EncodeWith(image, &detail, quality, jpeg, capacity);
  }

  /// Why the last encoding failed, in words.
  const char* LastError() const { return errors_.message; }

 private:
  // Receives libjpeg's errors. Its first member is libjpeg's own struct, so a pointer to one is a pointer to the other;
  // the same holds for Destination.
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

  // One row of macroblocks: libjpeg takes 16 rows at once.
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
  Strip chroma_copies_;  // Cb, then Cr, before they are halved
  HalfStrip cb_;
  HalfStrip cr_;
};

#endif  // AIBO_RCSERVER_PICTURE_ENCODER_JPEG_ENCODER_H
