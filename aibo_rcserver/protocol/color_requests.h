/// @file color_requests.h
/// Version 2's request `Z` and its push `z`: the camera's colour detection. Decoders and encoders follow the rules in
/// version2.h.
///
/// The camera compares each pixel with tables, one for each channel, and makes a plane of one byte per pixel, with a
/// bit for each channel whose table contains the pixel's colour (Level2 Reference Guide, 4.4.1). The robot sends what
/// is in the plane: how many pixels each channel has, and where; on demand also the plane.
#ifndef AIBO_RCSERVER_PROTOCOL_COLOR_REQUESTS_H
#define AIBO_RCSERVER_PROTOCOL_COLOR_REQUESTS_H

#include <stddef.h>

namespace protocol {
namespace version2 {

const char REQUEST_COLORS = 'Z';  ///< colour detection, id = ColorOrder
const char COLORS_PUSH = 'z';     ///< what was detected in an image if request_number is 0; otherwise the reply to `Z`

/// What `Z` asks for: its id.
enum ColorOrder {
  COLORS_OFF = 0,   ///< no push any more; no payload
  COLORS_ON = 1,    ///< a push for each n-th image; the reply has the same payload
  COLORS_TABLE = 2  ///< the table of one channel; the reply has no payload
};

/// Payload of `Z` 1 and of its reply: uint16 every n-th image, uint8 with the plane, uint8 0.
struct ColorSettings {
  unsigned short every_nth_image;  ///< of the camera; never 0
  bool with_plane;
};

const size_t COLOR_SETTINGS_SIZE = 4;
size_t encodeColorSettings(const ColorSettings& settings, unsigned char* out);
const char* decodeColorSettings(const unsigned char* payload, size_t size, ColorSettings* settings);

/// A camera has at most this many channels, one for each bit of a pixel.
const int MAX_COLOR_CHANNELS = 8;

/// The table has a segment for each 8 values of Y: segment 0 is for Y 0..7, segment 31 for Y 248..255 (Sony's program
/// cdt2bmp, of the sample ImageObserver).
const int COLOR_SEGMENTS = 32;
const int Y_PER_COLOR_SEGMENT = 8;

/// Colours of one brightness, both ends included. All four numbers 128 mean that there are none: so a table begins
/// (ocdtINIT in OPENR/ODataFormats.h).
struct ColorSegment {
  unsigned char cr_min;
  unsigned char cr_max;
  unsigned char cb_min;
  unsigned char cb_max;
};

const ColorSegment EMPTY_COLOR_SEGMENT = {128, 128, 128, 128};
bool isEmpty(const ColorSegment& segment);

/// Payload of `Z` 2: uint8 channel, 3 x uint8 0, 32 x {uint8 Cr min, uint8 Cr max, uint8 Cb min, uint8 Cb max}. No
/// minimum is above its maximum.
struct ColorTable {
  unsigned char channel;  ///< below MAX_COLOR_CHANNELS
  ColorSegment segments[COLOR_SEGMENTS];
};

const size_t COLOR_TABLE_SIZE = 4 + COLOR_SEGMENTS * 4;
size_t encodeColorTable(const ColorTable& table, unsigned char* out);
const char* decodeColorTable(const unsigned char* payload, size_t size, ColorTable* table);

/// What one channel has detected. Coordinates are in pixels of the plane, from its upper left corner. Without pixels,
/// everything else is 0.
struct ColorRegion {
  unsigned char channel;
  unsigned pixels;
  unsigned short x;  ///< the mean of the pixels' columns, in 64ths of a pixel; 0 is the middle of the first column
  unsigned short y;  ///< the same for rows
  unsigned short left;
  unsigned short top;
  unsigned short width;
  unsigned short height;
};

const int COLOR_CENTROID_SCALE = 64;

/// Payload of a pushed `z`: uint32 image count, uint32 frame, uint16 width, uint16 height, uint8 count, uint8 1 = the
/// plane follows, uint16 0; count x {uint8 channel, 3 x uint8 0, uint32 pixels, uint16 x, uint16 y, uint16 left, uint16
/// top, uint16 width, uint16 height}; then the plane, if it follows, packed (packColorPlane()), up to the end. Count
/// and frame are those of a picture of the same image (ImageHeader).
struct ColorRegions {
  unsigned image_count;
  unsigned frame_number;
  unsigned short width;   ///< of the plane, never 0
  unsigned short height;  ///< of the plane, never 0
  unsigned char count;    ///< of channels that have a table, 0..MAX_COLOR_CHANNELS
  bool has_plane;
  ColorRegion regions[MAX_COLOR_CHANNELS];  ///< by ascending channel
};

const size_t MAX_COLOR_REGIONS_SIZE = 16 + MAX_COLOR_CHANNELS * 20;

/// Encodes all but the plane, which goes behind it.
size_t encodeColorRegions(const ColorRegions& regions, unsigned char* out);

/// @param[out] plane the packed plane, in the payload; its size is 0 if there is none. It is not checked:
///   unpackColorPlane() does that.
const char* decodeColorRegions(const unsigned char* payload, size_t size, ColorRegions* regions,
                               const unsigned char** plane, size_t* plane_size);

/// Most pixels of a plane that is sent: those of an ERS-7's, 104 x 80.
const size_t MAX_COLOR_PLANE_SIZE = 104 * 80;

/// Largest size of a packed plane of so many pixels.
inline size_t packedColorPlaneSize(size_t pixels) {
  return pixels + (pixels + 127) / 128;
}

/// Packs a plane by the widespread scheme PackBits: a byte n up to 127 is followed by n + 1 bytes of the plane as they
/// are, a byte n from 129 on by one byte that is there 257 - n times. 128 is not used.
/// @param[out] out room for packedColorPlaneSize(pixels) bytes
size_t packColorPlane(const unsigned char* plane, size_t pixels, unsigned char* out);

/// @param pixels of the plane; never more are written
/// @param[out] plane undefined if the result is not NULL
/// @return NULL, or why this is not a plane of so many pixels
const char* unpackColorPlane(const unsigned char* packed, size_t size, size_t pixels, unsigned char* plane);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_COLOR_REQUESTS_H
