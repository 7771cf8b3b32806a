// The colour detection: what the client asks for, and what it believes.
#include "protocol/color_requests.h"
#include "version2_fixture.h"

using namespace aibo_client;
using test_pictures::Bytes;
using testing::IsEmpty;
using testing::SizeIs;
using version2_frames::makeFrame;

namespace version2 = protocol::version2;

namespace {

ColorTablePtr tableNamed(const std::string& name) {
  ColorTable table;
  table.name = name;
  table.segments[1] = ColorRange{1, 2, 3, 4};
  return std::make_shared<ColorTable>(table);
}

const version2::ColorRegion kBall = {6, 100, 64 * 50, 64 * 40 + 32, 45, 36, 11, 10};

/// These regions after one of a channel that has no table.
version2::ColorRegions regionsOf(std::vector<version2::ColorRegion> regions) {
  regions.insert(regions.begin(), {1, 4, 64 * 3, 64 * 2, 3, 2, 2, 2});
  version2::ColorRegions colors = {7, 400, 104, 80, static_cast<unsigned char>(regions.size()), false, {}, nullptr, 0};
  std::copy(regions.begin(), regions.end(), colors.regions);
  return colors;
}

Bytes payloadOf(const version2::ColorRegions& colors, const Bytes& packed_plane = {}) {
  Bytes payload = encoded(colors);
  payload.insert(payload.end(), packed_plane.begin(), packed_plane.end());
  return payload;
}

class ColorsTest : public Version2SessionFixture {
 public:
  std::string request() { return Version2SessionFixture::request(4); }

  /// The detection is on for every third image; channel 6 detects a ball, and two others something else.
  void detectBall(bool with_mask = false) {
    begin();
    wanted_.colors = {true, 3, with_mask};
    for (const auto& [channel, name] : {std::pair(4, "goal"), {6, "ball"}, {7, "box"}}) {
      wanted_.color_tables.at(static_cast<std::size_t>(channel)) = tableNamed(name);
      EXPECT_EQ("Z 2 " + std::to_string(channel) + " 0 0 0", request());
      agree();
    }
    EXPECT_EQ(std::string("Z 1 0 3 ") + (with_mask ? "1 0" : "0 0"), request());
    agree();
  }

  void agree() { answer(frame_.payload); }

  void push(const version2::ColorRegions& colors, const Bytes& packed_plane = {}) {
    Version2SessionFixture::push('z', payloadOf(colors, packed_plane));
  }
};

TEST_F(ColorsTest, TablesAreSentBeforeTheDetectionIsSwitchedOnAndOnlyThen) {
  begin();
  wanted_.color_tables[0] = tableNamed("ball");
  wanted_.color_tables[6] = tableNamed("box");
  EXPECT_EQ("", request()) << "nobody wants to know";
  wanted_.colors = {true, 2, false};
  EXPECT_EQ("Z 2 0 0 0 0", request());
  ASSERT_THAT(frame_.payload, SizeIs(4 + 4 * version2::COLOR_SEGMENTS));
  EXPECT_THAT(Bytes(frame_.payload.begin() + 4, frame_.payload.begin() + 12),
              testing::ElementsAre(128, 128, 128, 128, 1, 2, 3, 4));
  EXPECT_EQ("Z 2 6 0 0 0", request());
  EXPECT_EQ("Z 1 0 2 0 0", request());
  EXPECT_EQ("", request());
  wanted_.colors = {true, 258, true};
  EXPECT_EQ("Z 1 1 2 1 0", request());
  wanted_.color_tables[6] = nullptr;
  EXPECT_EQ("Z 2 6 0 0 0", request());
  EXPECT_EQ(std::count(frame_.payload.begin(), frame_.payload.end(), 128), 128);
  wanted_.colors = ColorDetection();
  EXPECT_EQ("Z 0", request());
}

TEST_F(ColorsTest, ARegionHasTheNameOfItsTable) {
  detectBall();
  push(regionsOf({kBall}));
  ASSERT_THAT(colors_, SizeIs(1));
  const DetectedColors& colors = colors_[0];
  EXPECT_EQ(colors.frame_number, 400U);
  EXPECT_EQ(colors.image_count, 7U);
  EXPECT_EQ(colors.connection_number, 3U);
  EXPECT_EQ(colors.arrival, now_);
  EXPECT_EQ(colors.width, 104);
  EXPECT_EQ(colors.height, 80);
  EXPECT_THAT(colors.mask, IsEmpty());
  ASSERT_THAT(colors.regions, SizeIs(1));
  EXPECT_EQ(colors.regions[0].name, "ball");
  EXPECT_EQ(colors.regions[0].channel, 6);
  EXPECT_EQ(colors.regions[0].pixels, 100U);
  EXPECT_DOUBLE_EQ(colors.regions[0].x, 50);
  EXPECT_DOUBLE_EQ(colors.regions[0].y, 40.5);
  EXPECT_EQ(colors.regions[0].left, 45);
  EXPECT_EQ(colors.regions[0].top, 36);
  EXPECT_EQ(colors.regions[0].width, 11);
  EXPECT_EQ(colors.regions[0].height, 10);
}

TEST_F(ColorsTest, TheNewestCountsUnlessAnEarlierTableHasDetectedIt) {
  detectBall();
  version2::ColorRegions later = regionsOf({kBall});
  later.image_count = 8;
  Bytes both = makeFrame('z', 0, payloadOf(regionsOf({kBall})));
  const Bytes second = makeFrame('z', 0, payloadOf(later));
  both.insert(both.end(), second.begin(), second.end());
  wanted_.color_tables[6] = tableNamed("box");
  EXPECT_EQ("Z 2 6 0 0 0", request());
  receive(both);
  EXPECT_THAT(colors_, IsEmpty());
  agree();
  receive(both);
  ASSERT_THAT(colors_, SizeIs(1));
  EXPECT_EQ(colors_[0].regions[0].name, "box");
  EXPECT_EQ(colors_[0].image_count, 8U);
}

TEST_F(ColorsTest, TheMaskIsUnpacked) {
  detectBall(true);
  version2::ColorRegions colors = regionsOf({kBall});
  colors.has_plane = true;
  colors.width = 3;
  colors.height = 2;
  colors.regions[0] = {6, 2, 64, 0, 0, 0, 3, 1};
  colors.count = 1;
  push(colors, {1, 1, 0, 0, 1, 254, 0});
  ASSERT_THAT(colors_, SizeIs(1));
  EXPECT_THAT(colors_[0].mask, testing::ElementsAre(1, 0, 1, 0, 0, 0));
  EXPECT_NE("", whyGivenUp([&] { push(colors, {1, 1, 0}); })) << "too short";
}

TEST_F(ColorsTest, WhatContradictsItselfIsNotBelieved) {
  detectBall();
  const std::vector<version2::ColorRegion> impossible = {
      {0, 111, 64 * 50, 64 * 40, 45, 36, 11, 10},  // more pixels than the box has
      {0, 100, 64 * 57, 64 * 40, 45, 36, 11, 10},  // the centroid is outside
      {0, 100, 64 * 50, 64 * 46, 45, 36, 11, 10},
      {0, 100, 64 * 44, 64 * 40, 45, 36, 11, 10},
      {0, 100, 64 * 50, 64 * 35, 45, 36, 11, 10},
      {0, 100, 64 * 99, 64 * 40, 95, 36, 11, 10},  // the box is outside
      {0, 100, 64 * 50, 64 * 75, 45, 72, 11, 10},
      {0, 100, 0, 0, 0, 0, 0, 0},  // no box
      {0, 0, 0, 0, 0, 0, 5, 5},    // a box of nothing
  };
  for (version2::ColorRegion region : impossible) {
    region.channel = 4;
    version2::ColorRegion other = region;
    other.channel = 7;
    push(regionsOf({region, kBall, other}));
    ASSERT_FALSE(colors_.empty());
    ASSERT_THAT(colors_.back().regions, SizeIs(1));
    EXPECT_EQ(colors_.back().regions[0].pixels, 100U);
    EXPECT_DOUBLE_EQ(colors_.back().regions[0].y, 40.5);
    pass(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(counters_.impossible_values, 2 * impossible.size());
  EXPECT_EQ(logged("impossible colours"), 1);
  EXPECT_EQ(logged(": 111 pixels of goal in a box of 11x10."), 1);
}

TEST_F(ColorsTest, AnImpossiblePlaneIsDropped) {
  detectBall();
  version2::ColorRegions colors = regionsOf({});
  const std::pair<unsigned short, unsigned short> sizes[] = {{417, 320}, {416, 321}, {65535, 65535}, {416, 320}};
  for (const auto& [width, height] : sizes) {
    EXPECT_THAT(colors_, IsEmpty());
    colors.width = width;
    colors.height = height;
    push(colors);
  }
  EXPECT_THAT(colors_, SizeIs(1)) << "the last one";
  EXPECT_EQ(counters_.impossible_values, 3U);
}

TEST_F(ColorsTest, WhatWasNotAskedForIsLeftOut) {
  begin();
  push(regionsOf({kBall}));
  EXPECT_THAT(colors_, IsEmpty()) << "the detection is off";
  wanted_.colors.on = true;
  request();
  agree();
  push(regionsOf({kBall}));
  ASSERT_THAT(colors_, SizeIs(1));
  EXPECT_THAT(colors_[0].regions, IsEmpty()) << "the channel has no table";
}

}  // namespace
