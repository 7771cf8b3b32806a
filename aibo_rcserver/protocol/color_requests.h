/// Version 2's request `Z` and its push `z`: the camera's colour detection.
///
/// The camera compares each pixel with a table for each channel. It makes a plane with one byte per pixel and one bit
/// per channel: the bit is set if the channel's table contains the pixel's colour (Level2 Reference Guide, 4.4.1). The
/// robot sends how many pixels each channel has and where they are, and, if asked for, the plane.
#ifndef AIBO_RCSERVER_PROTOCOL_COLOR_REQUESTS_H
#define AIBO_RCSERVER_PROTOCOL_COLOR_REQUESTS_H

#include "protocol/fields.h"
#include "protocol/request.h"

namespace protocol {
namespace version2 {

const char REQUEST_COLORS = 'Z';  ///< colour detection, id = ColorOrder
const Request DETECT_COLORS = {REQUEST_COLORS, "detect colours", 0, NULL};
const char COLORS_PUSH = 'z';  ///< what was found in an image (request_number 0), or the reply to `Z`

/// The id of `Z`.
enum ColorOrder {
  COLORS_OFF = 0,   ///< no more pushes; no payload
  COLORS_ON = 1,    ///< asks for a push for every n-th image; the reply repeats the request's payload
  COLORS_TABLE = 2  ///< sets the table of one channel; the reply has no payload
};

/// Payload of `Z` 1 and its reply.
struct ColorSettings {
  unsigned short every_nth_image;  ///< never 0
  bool with_plane;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(every_nth_image);
    fields.require(every_nth_image != 0, "the image interval is 0; 1 means every image");
    fields.flag(with_plane, "the byte for the plane is neither 0 nor 1");
    fields.zeros(1);
  }
};

/// How many channels there are at most, because a pixel has one bit for each.
const int MAX_COLOR_CHANNELS = 8;

template <typename Fields>
void visitChannel(Fields& fields, unsigned char& channel) {
  fields.number(channel);
  fields.require(channel < MAX_COLOR_CHANNELS, "the channel is not 0 to 7");
  fields.zeros(3);
}

/// How many segments a table has: one for every 8 values of Y: segment 0 for 0..7, segment 31 for 248..255 (Sony's
/// program cdt2bmp in the sample ImageObserver).
const int COLOR_SEGMENTS = 32;

/// A range of colours at one brightness, both ends included. An empty segment has 128 in all four (ocdtINIT in
/// OPENR/ODataFormats.h).
struct ColorSegment {
  unsigned char cr_min;
  unsigned char cr_max;
  unsigned char cb_min;
  unsigned char cb_max;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(cr_min);
    fields.number(cr_max);
    fields.number(cb_min);
    fields.number(cb_max);
    fields.require(cr_min <= cr_max && cb_min <= cb_max, "a segment of the table has a minimum above its maximum");
  }
};

const ColorSegment EMPTY_COLOR_SEGMENT = {128, 128, 128, 128};
bool isEmpty(const ColorSegment& segment);

/// Payload of `Z` 2.
struct ColorTable {
  unsigned char channel;  ///< below MAX_COLOR_CHANNELS
  ColorSegment segments[COLOR_SEGMENTS];

  template <typename Fields>
  void visit(Fields& fields) {
    visitChannel(fields, channel);
    for (int i = 0; i < COLOR_SEGMENTS; ++i) {
      fields.item(segments[i]);
    }
  }
};

/// What one channel found, in pixels from the plane's upper left corner. Without pixels, all other fields are 0.
struct ColorRegion {
  unsigned char channel;
  unsigned pixels;
  unsigned short x;  ///< mean column of the pixels, in 64ths of a pixel; 0 is the middle of the first column
  unsigned short y;  ///< mean row of the pixels, in the same unit
  unsigned short left;
  unsigned short top;
  unsigned short width;
  unsigned short height;

  template <typename Fields>
  void visit(Fields& fields) {
    visitChannel(fields, channel);
    fields.number(pixels);
    fields.number(x);
    fields.number(y);
    fields.number(left);
    fields.number(top);
    fields.number(width);
    fields.number(height);
  }
};

const int COLOR_CENTROID_SCALE = 64;

/// Payload of a pushed `z`. Image count and frame match the picture of the same image (ImageHeader).
struct ColorRegions {
  unsigned image_count;
  unsigned frame_number;
  unsigned short width;   ///< width of the plane, never 0
  unsigned short height;  ///< height of the plane, never 0
  unsigned char count;    ///< channels with a table, 0..MAX_COLOR_CHANNELS
  bool has_plane;
  ColorRegion regions[MAX_COLOR_CHANNELS];  ///< in ascending order of channels
  const unsigned char* plane;  ///< packed and unchecked (unpackColorPlane()); after decoding, points into the payload
  size_t plane_size;           ///< bytes; 0 encodes everything except the plane, which the caller appends

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(image_count);
    fields.number(frame_number);
    fields.number(width);
    fields.number(height);
    fields.require(width != 0 && height != 0, "the plane has no pixels");
    fields.number(count);
    fields.flag(has_plane, "the byte for the plane is neither 0 nor 1");
    fields.zeros(2);
    fields.list(regions, count, MAX_COLOR_CHANNELS, "more channels than any camera has");
    for (int i = 1; i < count; ++i) {
      fields.require(regions[i - 1].channel < regions[i].channel, "the channels are not in ascending order");
    }
    fields.content(plane, plane_size);
    fields.require(has_plane == (plane_size > 0), "the count does not match the size of the payload");
  }
};

const size_t MAX_COLOR_REGIONS_SIZE = 16 + MAX_COLOR_CHANNELS * 20;

/// The largest plane that is sent: an ERS-7's.
const size_t MAX_COLOR_PLANE_WIDTH = 104;
const size_t MAX_COLOR_PLANE_HEIGHT = 80;

/// Packs a row of a plane, or all of it, with PackBits.
/// @param[out] out room for one byte more than there are pixels, and one for each further 128
size_t packColorPlane(const unsigned char* plane, size_t pixels, unsigned char* out);

/// @param pixels size of the plane; no more are written
/// @param[out] plane undefined unless the result is NULL
/// @return NULL, or what is wrong
const char* unpackColorPlane(const unsigned char* packed, size_t size, size_t pixels, unsigned char* plane);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_COLOR_REQUESTS_H
