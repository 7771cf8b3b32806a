#include "aibo_client/jpeg_inspector.h"

#include <gmock/gmock.h>

#include "support/test_pictures.h"

using test_pictures::Bytes;
using test_pictures::PictureKind;

namespace {

// Offsets within a segment, counted from its 0xFF (ITU T.81, B.2.2 and B.2.3).
constexpr std::size_t kFrameHeight = 5;
constexpr std::size_t kFrameWidth = 7;
constexpr std::size_t kFrameComponentCount = 9;
constexpr std::size_t kFramePrecision = 4;
constexpr std::size_t kFrameLumaSampling = 11;
constexpr std::size_t kFrameLength = 3;  // its low byte
constexpr std::size_t kScanSpectralStart = 11;

constexpr std::uint8_t kSof0 = 0xC0;
constexpr std::uint8_t kSos = 0xDA;
constexpr std::uint8_t kDht = 0xC4;
constexpr std::uint8_t kDqt = 0xDB;
constexpr std::uint8_t kComment = 0xFE;

std::string problemOf(const Bytes& jpeg) {
  return aibo_client::inspectJpeg(jpeg.data(), jpeg.size()).problem;
}

/// The ordinary picture with one byte of a segment set to another value.
Bytes alter(std::uint8_t marker, std::size_t offset, int value) {
  Bytes jpeg = test_pictures::make();
  jpeg.at(test_pictures::findMarker(jpeg, marker) + offset) = static_cast<std::uint8_t>(value);
  return jpeg;
}

void setSize(Bytes* jpeg, int width, int height) {
  const std::size_t frame = test_pictures::findMarker(*jpeg, kSof0);
  jpeg->at(frame + kFrameHeight) = static_cast<std::uint8_t>(height >> 8);
  jpeg->at(frame + kFrameHeight + 1) = static_cast<std::uint8_t>(height);
  jpeg->at(frame + kFrameWidth) = static_cast<std::uint8_t>(width >> 8);
  jpeg->at(frame + kFrameWidth + 1) = static_cast<std::uint8_t>(width);
}

TEST(JpegInspectorTest, PicturesOfEverySizeACameraHasAreGood) {
  for (const auto& [width, height] :
       {std::pair<int, int>{208, 160}, {104, 80}, {52, 40}, {416, 320}, {176, 144}, {88, 72}, {44, 36}, {352, 288}}) {
    PictureKind kind;
    kind.width = width;
    kind.height = height;
    const Bytes jpeg = test_pictures::make(kind);
    const aibo_client::JpegInspection inspection = aibo_client::inspectJpeg(jpeg.data(), jpeg.size());
    EXPECT_TRUE(inspection.good()) << inspection.problem;
    EXPECT_EQ(width, inspection.width);
    EXPECT_EQ(height, inspection.height);
  }
}

TEST(JpegInspectorTest, PicturesOfEveryQualityAndUsualSubsamplingAreGood) {
  for (const int subsampling : {TJSAMP_420, TJSAMP_422, TJSAMP_444, TJSAMP_440}) {
    for (const int quality : {1, 85, 100}) {
      PictureKind kind;
      kind.subsampling = subsampling;
      kind.quality = quality;
      EXPECT_EQ("", problemOf(test_pictures::make(kind))) << subsampling << " " << quality;
    }
  }
}

TEST(JpegInspectorTest, FillBytesBeforeAMarkerAreAllowed) {
  Bytes jpeg = test_pictures::make();
  jpeg.insert(jpeg.begin() + static_cast<std::ptrdiff_t>(test_pictures::findMarker(jpeg, kSof0)), 3, 0xFF);
  for (int fill_bytes = 1; fill_bytes <= 3; ++fill_bytes) {
    jpeg.insert(jpeg.end() - 2, 0xFF);
    EXPECT_EQ("", problemOf(jpeg)) << fill_bytes << " before the end";
  }
}

// The sanitizers see whether more is read than there is.
TEST(JpegInspectorTest, APictureCutAtAnyLengthIsRefused) {
  const Bytes jpeg = test_pictures::make();
  for (auto end = jpeg.begin(); end != jpeg.end(); ++end) {
    EXPECT_NE("", problemOf(Bytes(jpeg.begin(), end)));
  }
}

TEST(JpegInspectorTest, WhatIsNoWholeBaselineJpegIsRefused) {
  const Bytes jpeg = test_pictures::make();
  Bytes longer = jpeg;
  longer.push_back(0);
  Bytes without_marker = jpeg;
  without_marker.erase(without_marker.begin() + static_cast<std::ptrdiff_t>(test_pictures::findMarker(jpeg, kDqt)));
  Bytes other_begin = jpeg;
  other_begin[1] = 0xFE;
  PictureKind progressive;
  progressive.flags = TJFLAG_PROGRESSIVE;
  const std::pair<Bytes, std::string> rows[] = {
      {{}, "not a JPEG"},
      {Bytes(5000, 0), "not a JPEG"},
      {other_begin, "not a JPEG"},
      {{0xFF, 0xD8}, "cut off in its header"},
      {without_marker, "a header that no camera writes"},
      {longer, "bytes after its end"},
      {test_pictures::make(progressive), "not a baseline JPEG"},
  };
  for (const auto& [bytes, problem] : rows) {
    EXPECT_THAT(problemOf(bytes), testing::HasSubstr(problem));
  }
}

TEST(JpegInspectorTest, SizesThatNoCameraHasAreRefused) {
  for (const auto& [width, height] : {std::pair<int, int>{65500, 65500}, {0, 0}, {160, 208}, {208, 161}, {640, 480}}) {
    Bytes jpeg = test_pictures::make();
    setSize(&jpeg, width, height);
    EXPECT_EQ("a size that no camera has: " + std::to_string(width) + "x" + std::to_string(height), problemOf(jpeg));
  }
}

TEST(JpegInspectorTest, OtherColoursThanYCbCrAreRefused) {
  Bytes adobe = test_pictures::make();
  adobe.insert(adobe.begin() + 2, {0xFF, 0xEE, 0, 14, 'A', 'd', 'o', 'b', 'e', 0, 100, 0, 0, 0, 0, 0});
  EXPECT_EQ("its colours are not YCbCr", problemOf(adobe));
  adobe.at(2 + 15) = 1;  // its transform: YCbCr
  EXPECT_EQ("", problemOf(adobe));
}

TEST(JpegInspectorTest, HeadersOfOtherKindsOfPicturesAreRefused) {
  const struct {
    std::uint8_t marker;
    std::size_t offset;
    int value;
    std::string problem;
  } rows[] = {
      {kSof0, kFrameComponentCount, 4, "not one frame of 3 components with 8 bits"},
      {kSof0, kFramePrecision, 12, "not one frame of 3 components with 8 bits"},
      {kSof0, kFrameLumaSampling, 0x41, "an unusual subsampling"},
      {kSof0, kFrameLumaSampling + 3, 0x21, "an unusual subsampling"},
      {kSof0, kFrameLumaSampling + 6, 0x21, "an unusual subsampling"},
      {kSof0, kFrameLength, 18, "not one frame of 3 components with 8 bits"},
      {kSos, kScanSpectralStart, 5, "not one baseline scan of all components"},
      {kSos, kScanSpectralStart + 1, 5, "not one baseline scan of all components"},
      {kSos, kScanSpectralStart + 2, 5, "not one baseline scan of all components"},
      {kSos, 4, 1, "not one baseline scan of all components"},
      {kSos, 5, 77, "not one baseline scan of all components"},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(row.problem, problemOf(alter(row.marker, row.offset, row.value)));
  }
}

// ITU T.81, B.1.1.5, B.2.1 and table B.1.
TEST(JpegInspectorTest, AMarkerIsAllowedOnlyWhereItBelongs) {
  const Bytes jpeg = test_pictures::make();
  const struct {
    std::uint8_t marker;
    std::string in_data;
    std::string in_header;  // with an empty segment, before the frame header
  } rows[] = {
      {0x00, "", "a header that no camera writes"},
      {0xC0, "a marker within its compressed data", "not one frame of 3 components with 8 bits"},
      {0xC2, "a marker within its compressed data",
       "not a baseline JPEG (progressive, arithmetic, or another process)"},
      {0xC4, "a marker within its compressed data", ""},
      {0xD0, "", "a header that no camera writes"},
      {0xD8, "a marker within its compressed data", "a header that no camera writes"},
      {0xD9, "bytes after its end", "a header that no camera writes"},
      {0xDA, "a marker within its compressed data", "its frame header or its tables are missing"},
      {0xFE, "a marker within its compressed data", ""},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(static_cast<int>(row.marker));
    Bytes data = jpeg;
    data.at(jpeg.size() / 2) = 0xFF;
    data.at(jpeg.size() / 2 + 1) = row.marker;
    EXPECT_EQ(row.in_data, problemOf(data));
    Bytes header = jpeg;
    header.insert(header.begin() + 2, {0xFF, row.marker, 0, 2});
    EXPECT_EQ(row.in_header, problemOf(header));
  }
}

TEST(JpegInspectorTest, APictureWithoutItsTablesIsRefused) {
  for (const std::uint8_t table : {kDqt, kDht}) {
    Bytes jpeg = test_pictures::make();
    for (std::size_t i = 0; i + 1 < jpeg.size(); ++i) {
      jpeg[i + 1] = jpeg[i] == 0xFF && jpeg[i + 1] == table ? kComment : jpeg[i + 1];
    }
    EXPECT_EQ("its frame header or its tables are missing", problemOf(jpeg));
  }
}

TEST(JpegInspectorTest, ASegmentThatLiesAboutItsLengthIsRefused) {
  for (const std::uint8_t marker : {std::uint8_t{0xE0}, kDqt, kSof0, kDht}) {
    Bytes jpeg = alter(marker, 2, 0xFF);
    EXPECT_EQ("cut off in its header", problemOf(jpeg));
    jpeg = alter(marker, 2, 0);
    jpeg.at(test_pictures::findMarker(jpeg, marker) + 3) = 1;
    EXPECT_EQ("a header that no camera writes", problemOf(jpeg));
  }
}

}  // namespace
