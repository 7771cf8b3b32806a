#include "protocol/color_requests.h"

#include <string.h>

#include "protocol/big_endian.h"

namespace protocol {
namespace version2 {
namespace {

const size_t REGIONS_HEADER_SIZE = 16;
const size_t REGION_SIZE = 20;
const size_t TABLE_HEADER_SIZE = 4;
const size_t SEGMENT_SIZE = 4;

const size_t LONGEST_PACKED_RUN = 128;
const unsigned char NOT_USED = 128;

const char RESERVED_NOT_ZERO[] = "a reserved byte is not 0";
const char UNKNOWN_CHANNEL[] = "the channel is not 0 to 7";

bool isZero(const unsigned char* bytes, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    if (bytes[i] != 0) {
      return false;
    }
  }
  return true;
}

void encodeRegion(const ColorRegion& region, unsigned char* out) {
  encodeBigEndian32(static_cast<unsigned>(region.channel) << 24, out);
  encodeBigEndian32(region.pixels, out + 4);
  encodeBigEndian16(region.x, out + 8);
  encodeBigEndian16(region.y, out + 10);
  encodeBigEndian16(region.left, out + 12);
  encodeBigEndian16(region.top, out + 14);
  encodeBigEndian16(region.width, out + 16);
  encodeBigEndian16(region.height, out + 18);
}

ColorRegion decodeRegion(const unsigned char* in) {
  const ColorRegion region = {in[0],
                              decodeBigEndian32(in + 4),
                              decodeBigEndian16(in + 8),
                              decodeBigEndian16(in + 10),
                              decodeBigEndian16(in + 12),
                              decodeBigEndian16(in + 14),
                              decodeBigEndian16(in + 16),
                              decodeBigEndian16(in + 18)};
  return region;
}

const char* checkRegions(const unsigned char* in, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const unsigned char* region = in + i * REGION_SIZE;
    if (region[0] >= MAX_COLOR_CHANNELS) {
      return UNKNOWN_CHANNEL;
    }
    if (i > 0 && region[0] <= region[0 - static_cast<int>(REGION_SIZE)]) {
      return "the channels are not in ascending order";
    }
    if (!isZero(region + 1, 3)) {
      return RESERVED_NOT_ZERO;
    }
  }
  return NULL;
}

// How often the first of these bytes is there in a row.
size_t runAt(const unsigned char* bytes, size_t size) {
  size_t run = 1;
  while (run < size && run < LONGEST_PACKED_RUN && bytes[run] == bytes[0]) {
    ++run;
  }
  return run;
}

// How many bytes there are before the next run that is worth packing: three or more.
size_t literalsAt(const unsigned char* bytes, size_t size) {
  size_t count = 1;
  while (count < size && count < LONGEST_PACKED_RUN && runAt(bytes + count, size - count) < 3) {
    ++count;
  }
  return count;
}

}  // namespace

size_t encodeColorSettings(const ColorSettings& settings, unsigned char* out) {
  encodeBigEndian16(settings.every_nth_image, out);
  out[2] = settings.with_plane ? 1 : 0;
  out[3] = 0;
  return COLOR_SETTINGS_SIZE;
}

const char* decodeColorSettings(const unsigned char* payload, size_t size, ColorSettings* settings) {
  if (size != COLOR_SETTINGS_SIZE) {
    return "the payload does not have the size of settings of the colour detection";
  }
  if (payload[2] > 1) {
    return "the byte for the plane is neither 0 nor 1";
  }
  if (payload[3] != 0) {
    return RESERVED_NOT_ZERO;
  }
  if (decodeBigEndian16(payload) == 0) {
    return "every 0th image is no image; 1 is every image";
  }
  settings->every_nth_image = decodeBigEndian16(payload);
  settings->with_plane = payload[2] == 1;
  return NULL;
}

bool isEmpty(const ColorSegment& segment) {
  return memcmp(&segment, &EMPTY_COLOR_SEGMENT, sizeof(segment)) == 0;
}

size_t encodeColorTable(const ColorTable& table, unsigned char* out) {
  encodeBigEndian32(static_cast<unsigned>(table.channel) << 24, out);
  for (int i = 0; i < COLOR_SEGMENTS; ++i) {
    const ColorSegment& segment = table.segments[i];
    unsigned char* const bytes = out + TABLE_HEADER_SIZE + static_cast<size_t>(i) * SEGMENT_SIZE;
    bytes[0] = segment.cr_min;
    bytes[1] = segment.cr_max;
    bytes[2] = segment.cb_min;
    bytes[3] = segment.cb_max;
  }
  return COLOR_TABLE_SIZE;
}

const char* decodeColorTable(const unsigned char* payload, size_t size, ColorTable* table) {
  if (size != COLOR_TABLE_SIZE) {
    return "the payload does not have the size of a colour table";
  }
  if (payload[0] >= MAX_COLOR_CHANNELS) {
    return UNKNOWN_CHANNEL;
  }
  if (!isZero(payload + 1, 3)) {
    return RESERVED_NOT_ZERO;
  }
  for (const unsigned char* segment = payload + TABLE_HEADER_SIZE; segment != payload + size; segment += SEGMENT_SIZE) {
    if (segment[0] > segment[1] || segment[2] > segment[3]) {
      return "a segment of the table has a minimum above its maximum";
    }
  }
  table->channel = payload[0];
  for (int i = 0; i < COLOR_SEGMENTS; ++i) {
    const unsigned char* const bytes = payload + TABLE_HEADER_SIZE + static_cast<size_t>(i) * SEGMENT_SIZE;
    const ColorSegment segment = {bytes[0], bytes[1], bytes[2], bytes[3]};
    table->segments[i] = segment;
  }
  return NULL;
}

size_t encodeColorRegions(const ColorRegions& regions, unsigned char* out) {
  encodeBigEndian32(regions.image_count, out);
  encodeBigEndian32(regions.frame_number, out + 4);
  encodeBigEndian16(regions.width, out + 8);
  encodeBigEndian16(regions.height, out + 10);
  out[12] = regions.count;
  out[13] = regions.has_plane ? 1 : 0;
  encodeBigEndian16(0, out + 14);
  for (size_t i = 0; i < regions.count; ++i) {
    encodeRegion(regions.regions[i], out + REGIONS_HEADER_SIZE + i * REGION_SIZE);
  }
  return REGIONS_HEADER_SIZE + regions.count * REGION_SIZE;
}

const char* decodeColorRegions(const unsigned char* payload, size_t size, ColorRegions* regions,
                               const unsigned char** plane, size_t* plane_size) {
  if (size < REGIONS_HEADER_SIZE) {
    return "the payload is too short for colour regions";
  }
  const size_t count = payload[12];
  const size_t end = REGIONS_HEADER_SIZE + count * REGION_SIZE;
  if (count > static_cast<size_t>(MAX_COLOR_CHANNELS)) {
    return "more channels than any camera has";
  }
  if (payload[13] > 1) {
    return "the byte for the plane is neither 0 nor 1";
  }
  const bool has_plane = payload[13] == 1;
  if (has_plane ? size <= end : size != end) {
    return "the count does not match the size of the payload";
  }
  if (decodeBigEndian16(payload + 14) != 0) {
    return RESERVED_NOT_ZERO;
  }
  if (decodeBigEndian16(payload + 8) == 0 || decodeBigEndian16(payload + 10) == 0) {
    return "a plane without pixels";
  }
  if (const char* problem = checkRegions(payload + REGIONS_HEADER_SIZE, count)) {
    return problem;
  }
  regions->image_count = decodeBigEndian32(payload);
  regions->frame_number = decodeBigEndian32(payload + 4);
  regions->width = decodeBigEndian16(payload + 8);
  regions->height = decodeBigEndian16(payload + 10);
  regions->count = payload[12];
  regions->has_plane = has_plane;
  for (size_t i = 0; i < count; ++i) {
    regions->regions[i] = decodeRegion(payload + REGIONS_HEADER_SIZE + i * REGION_SIZE);
  }
  *plane = payload + end;
  *plane_size = size - end;
  return NULL;
}

size_t packColorPlane(const unsigned char* plane, size_t pixels, unsigned char* out) {
  const unsigned char* const begin = out;
  for (size_t at = 0; at < pixels;) {
    const size_t run = runAt(plane + at, pixels - at);
    if (run >= 3) {
      *out++ = static_cast<unsigned char>(257 - run);
      *out++ = plane[at];
      at += run;
    } else {
      const size_t literals = literalsAt(plane + at, pixels - at);
      *out++ = static_cast<unsigned char>(literals - 1);
      memcpy(out, plane + at, literals);
      out += literals;
      at += literals;
    }
  }
  return static_cast<size_t>(out - begin);
}

const char* unpackColorPlane(const unsigned char* packed, size_t size, size_t pixels, unsigned char* plane) {
  size_t written = 0;
  for (size_t at = 0; at < size;) {
    const unsigned char code = packed[at++];
    const bool is_run = code > NOT_USED;
    const size_t count = is_run ? 257U - code : code + 1U;
    const size_t bytes = is_run ? 1 : count;
    if (code == NOT_USED || bytes > size - at || count > pixels - written) {
      return "the packed plane is not one of this size";
    }
    if (is_run) {
      memset(plane + written, packed[at], count);
    } else {
      memcpy(plane + written, packed + at, count);
    }
    at += bytes;
    written += count;
  }
  return written == pixels ? NULL : "the packed plane is too short";
}

}  // namespace version2
}  // namespace protocol
