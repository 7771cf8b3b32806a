#include "picture_encoder/JpegEncoder.h"

#include <string.h>

extern "C" {
#include <jerror.h>
}

namespace {

const size_t MACROBLOCK = 16;  // pixels in each direction, at 4:2:0
const int NO_QUALITY = -1;

// Up to this quality, libjpeg's fast transform (JDCT_IFAST) costs less than 0.1 dB against its accurate one, and saves
// a sixth of the instructions. The cost grows with the quality: 0.2 dB at 95, 0.6 dB at 100.
const int MAX_QUALITY_OF_FAST_DCT = 85;

size_t RoundUp(size_t size) {
  return (size + MACROBLOCK - 1) / MACROBLOCK * MACROBLOCK;
}

// Each sample of the half row is the mean of four. The code uses pointers, because the robot's old compiler makes
// faster code for them than for indices.
void HalveRows(const unsigned char* upper, const unsigned char* lower, size_t half_width, unsigned char* half) {
  unsigned char* const end = half + half_width;
  for (; half != end; ++half) {
    *half = static_cast<unsigned char>((upper[0] + upper[1] + lower[0] + lower[1] + 2U) >> 2);
    upper += 2;
    lower += 2;
  }
}

unsigned char Clip(int value) {
  return static_cast<unsigned char>(value < 0 ? 0 : value > 255 ? 255 : value);
}

// Makes two rows of double resolution from one row of each band. `at` is the row's offset in the bands.
void DoubleRow(const unsigned char* y, const DetailBands& detail, size_t at, size_t width, unsigned char* upper,
               unsigned char* lower) {
  const unsigned char* ll = y + at;
  const unsigned char* lh = detail.lh + at;
  const unsigned char* hl = detail.hl + at;
  const unsigned char* hh = detail.hh + at;
  for (const unsigned char* const end = ll + width; ll != end; ++ll, ++lh, ++hl, ++hh) {
    const int above = *ll - *lh + 128;
    const int below = *ll + *lh - 128;
    const int difference = *hl - *hh;
    const int sum = *hl + *hh - 256;
    upper[0] = Clip(above - difference);
    upper[1] = Clip(above + difference);
    lower[0] = Clip(below - sum);
    lower[1] = Clip(below + sum);
    upper += 2;
    lower += 2;
  }
}

// Repeats the last pixel of a row to fill the macroblock.
void Pad(unsigned char* row, size_t width, size_t padded_width) {
  memset(row + width, row[width - 1], padded_width - width);
}

}  // namespace

const size_t CameraImage::TAG_SIZE;
const size_t JpegEncoder::MAX_WIDTH;
const size_t JpegEncoder::MAX_HEIGHT;

JpegEncoder::JpegEncoder() : created_(false), quality_(NO_QUALITY) {
  errors_.message[0] = '\0';
  compress_.err = jpeg_std_error(&errors_.manager);
  errors_.manager.error_exit = Fail;
  errors_.manager.output_message = Ignore;
  if (setjmp(errors_.escape) != 0) {
    return;
  }
  jpeg_create_compress(&compress_);
  destination_.manager.init_destination = BeginBuffer;
  destination_.manager.empty_output_buffer = BufferIsFull;
  destination_.manager.term_destination = EndBuffer;
  compress_.dest = &destination_.manager;
  created_ = true;
}

JpegEncoder::~JpegEncoder() {
  if (created_) {
    jpeg_destroy_compress(&compress_);
  }
}

size_t JpegEncoder::EncodeWith(const CameraImage& image, const DetailBands* detail, int quality, unsigned char* jpeg,
                               size_t capacity) {
  const size_t scale = detail != NULL ? 2 : 1;
  const size_t width = scale * image.width;
  const size_t height = scale * image.height;
  if (width < 1 || width > MAX_WIDTH || image.height < 2 || height > MAX_HEIGHT) {
    sprintf(errors_.message, "cannot encode %lu x %lu pixels: 1 x 2 to %lu x %lu is possible",
            static_cast<unsigned long>(width), static_cast<unsigned long>(height),
            static_cast<unsigned long>(MAX_WIDTH), static_cast<unsigned long>(MAX_HEIGHT));
    return 0;
  }
  if (!created_) {
    return 0;
  }
  destination_.buffer = jpeg;
  destination_.capacity = capacity;
  // Fail() skips destructors, so no object with a destructor may be below this line.
  if (setjmp(errors_.escape) != 0) {
    jpeg_abort_compress(&compress_);
    return 0;
  }
  Configure(width, height, quality);
  jpeg_start_compress(&compress_, TRUE);
  WriteStrips(image, detail);
  jpeg_finish_compress(&compress_);
  return destination_.capacity - destination_.manager.free_in_buffer;
}

void JpegEncoder::Configure(size_t width, size_t height, int quality) {
  if (compress_.image_width != width || compress_.image_height != height) {
    quality_ = NO_QUALITY;
    compress_.image_width = static_cast<JDIMENSION>(width);
    compress_.image_height = static_cast<JDIMENSION>(height);
    compress_.input_components = 3;
    compress_.in_color_space = JCS_YCbCr;
    jpeg_set_defaults(&compress_);  // baseline; Y at full resolution, Cb and Cr at half
    compress_.raw_data_in = TRUE;
  }
  if (quality_ != quality) {
    jpeg_set_quality(&compress_, quality, TRUE);
    compress_.dct_method = quality <= MAX_QUALITY_OF_FAST_DCT ? JDCT_IFAST : JDCT_ISLOW;
    quality_ = quality;
  }
}

void JpegEncoder::WriteStrips(const CameraImage& image, const DetailBands* detail) {
  JSAMPROW y_rows[STRIP_HEIGHT];
  JSAMPROW cb_rows[STRIP_HEIGHT / 2];
  JSAMPROW cr_rows[STRIP_HEIGHT / 2];
  for (size_t row = 0; row < STRIP_HEIGHT / 2; ++row) {
    cb_rows[row] = cb_[row];
    cr_rows[row] = cr_[row];
  }
  JSAMPARRAY planes[] = {y_rows, cb_rows, cr_rows};
  for (size_t top = 0; top < compress_.image_height; top += STRIP_HEIGHT) {
    if (detail == NULL) {
      FillStrip(image, top, y_rows);
    } else {
      FillDoubleStrip(image, *detail, top, y_rows);
    }
    jpeg_write_raw_data(&compress_, planes, STRIP_HEIGHT);
  }
}

void JpegEncoder::FillStrip(const CameraImage& image, size_t top, JSAMPROW y_rows[STRIP_HEIGHT]) {
  JSAMPROW chroma_rows[STRIP_HEIGHT];
  FindRows(image, image.y, top, MACROBLOCK, y_copies_, y_rows);
  FindRows(image, image.cb, top, 2, chroma_copies_, chroma_rows);
  Halve(chroma_rows, image.width, cb_);
  FindRows(image, image.cr, top, 2, chroma_copies_, chroma_rows);
  Halve(chroma_rows, image.width, cr_);
}

// In all bands, the row above replaces the last row's tag, because we do not know which band has the tag.
void JpegEncoder::FillDoubleStrip(const CameraImage& image, const DetailBands& detail, size_t top,
                                  JSAMPROW y_rows[STRIP_HEIGHT]) {
  const size_t last = image.height - 1;
  const size_t tag_size = image.width < CameraImage::TAG_SIZE ? image.width : CameraImage::TAG_SIZE;
  const size_t padded_width = RoundUp(2 * image.width);
  for (size_t row = 0; row < STRIP_HEIGHT / 2; ++row) {
    const size_t source_row = top / 2 + row < last ? top / 2 + row : last;
    const size_t at = source_row * image.stride;
    const size_t at_tag = source_row == last ? at - image.stride : at;
    JSAMPROW const upper = y_copies_[2 * row];
    JSAMPROW const lower = y_copies_[2 * row + 1];
    DoubleRow(image.y, detail, at, image.width, upper, lower);
    DoubleRow(image.y, detail, at_tag, tag_size, upper, lower);
    Pad(upper, 2 * image.width, padded_width);
    Pad(lower, 2 * image.width, padded_width);
    y_rows[2 * row] = upper;
    y_rows[2 * row + 1] = lower;
    CopyRow(image.cb + at, image.cb + at_tag, image.width, padded_width / 2, cb_[row]);
    CopyRow(image.cr + at, image.cr + at_tag, image.width, padded_width / 2, cr_[row]);
  }
}

// Points to 16 rows of a plane, in the camera image where possible. The last row is copied because of its tag. All rows
// are copied if the width is not a multiple of `unit`, so that the copy fills the last macroblock. Below the image, the
// last row repeats.
void JpegEncoder::FindRows(const CameraImage& image, const unsigned char* plane, size_t top, size_t unit, Strip copies,
                           JSAMPROW rows[STRIP_HEIGHT]) {
  const size_t last = image.height - 1;
  const bool has_whole_units = image.width % unit == 0;
  for (size_t row = 0; row < STRIP_HEIGHT; ++row) {
    const size_t source_row = top + row < last ? top + row : last;
    const unsigned char* source = plane + source_row * image.stride;
    if (source_row < last && has_whole_units) {
      rows[row] = const_cast<JSAMPROW>(source);  // libjpeg does not write to the row, although its API lacks const
    } else {
      CopyRow(source, source_row == last ? source - image.stride : source, image.width, RoundUp(image.width),
              copies[row]);
      rows[row] = copies[row];
    }
  }
}

// Copies a row, takes the tag's pixels from another row, and fills the macroblock.
void JpegEncoder::CopyRow(const unsigned char* source, const unsigned char* source_of_tag, size_t width,
                          size_t padded_width, JSAMPROW copy) {
  memcpy(copy, source, width);
  memcpy(copy, source_of_tag, width < CameraImage::TAG_SIZE ? width : CameraImage::TAG_SIZE);
  Pad(copy, width, padded_width);
}

// Halves 16 rows and fills the last macroblock. If the width is odd, the last pixel counts twice.
void JpegEncoder::Halve(const JSAMPROW rows[STRIP_HEIGHT], size_t width, HalfStrip half) {
  const size_t half_width = (width + 1) / 2;
  for (size_t row = 0; row < STRIP_HEIGHT / 2; ++row) {
    HalveRows(rows[2 * row], rows[2 * row + 1], half_width, half[row]);
    Pad(half[row], half_width, RoundUp(width) / 2);
  }
}

void JpegEncoder::Fail(j_common_ptr compress) {
  Errors* errors = static_cast<Errors*>(static_cast<void*>(compress->err));
  errors->manager.format_message(compress, errors->message);
  longjmp(errors->escape, 1);
}

void JpegEncoder::Ignore(j_common_ptr) {}

void JpegEncoder::BeginBuffer(j_compress_ptr compress) {
  Destination* destination = static_cast<Destination*>(static_cast<void*>(compress->dest));
  destination->manager.next_output_byte = destination->buffer;
  destination->manager.free_in_buffer = destination->capacity;
}

boolean JpegEncoder::BufferIsFull(j_compress_ptr compress) {
  ERREXIT(compress, JERR_BUFFER_SIZE);
  return FALSE;
}

void JpegEncoder::EndBuffer(j_compress_ptr) {}
