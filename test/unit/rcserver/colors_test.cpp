// The camera's colour detection (`Z`).
#include "protocol/color_requests.h"
#include "rcserver/camera/ColorCounter.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;

constexpr unsigned kWidth = 104;
constexpr unsigned kHeight = 80;

std::string colorSettings(unsigned short every_nth_image, bool with_plane = false) {
  return payloadOf(ColorSettings{every_nth_image, with_plane});
}

// A table of colours for the brightest segment.
ColorTable tableOf(unsigned char channel) {
  ColorTable table = {channel, {}};
  for (ColorSegment& segment : table.segments) {
    segment = EMPTY_COLOR_SEGMENT;
  }
  table.segments[31] = {150, 230, 120, 190};
  return table;
}

// A plane with a bit in a rectangle.
void draw(unsigned left, unsigned top, unsigned width, unsigned height, int channel, std::vector<byte>* plane) {
  for (unsigned y = top; y < top + height; ++y) {
    for (unsigned x = left; x < left + width; ++x) {
      (*plane)[y * kWidth + x] = static_cast<byte>((*plane)[y * kWidth + x] | 1 << channel);
    }
  }
}

struct Colors {
  ColorRegions regions{};
  std::vector<byte> plane;
};

class ColorsTest : public FakeRobotFixture {
 protected:
  void SetUp() override {
    robot_.color_plane.assign(kWidth * kHeight, 0);
    start();
    connectVersion2();
  }

  void load(const ColorTable& table) { ASSERT_EQ(answerTo('Z', COLORS_TABLE, payloadOf(table)).header.kind, 'z'); }

  void switchOn(unsigned short every_nth_image = 1, bool with_plane = false) {
    ASSERT_EQ(answerTo('Z', COLORS_ON, colorSettings(every_nth_image, with_plane)).header.kind, 'z');
  }

  // Everything that has been pushed, which must be colours.
  std::vector<Colors> pushed() {
    std::vector<Colors> all;
    for (const Frame& next : arrived()) {
      EXPECT_EQ(next.header.kind, COLORS_PUSH);
      EXPECT_EQ(next.header.request_number, 0);
      Colors colors;
      colors.regions = payloadIn<ColorRegions>(next);
      if (colors.regions.has_plane) {
        colors.plane.resize(kWidth * kHeight);
        EXPECT_EQ(
            unpackColorPlane(colors.regions.plane, colors.regions.plane_size, colors.plane.size(), colors.plane.data()),
            nullptr);
      }
      all.push_back(colors);
    }
    return all;
  }

  Colors nextImage() {
    pushed();
    takeImage();
    const std::vector<Colors> all = pushed();
    EXPECT_THAT(all, testing::SizeIs(1));
    return all.empty() ? Colors() : all.back();
  }
};

TEST_F(ColorsTest, TheCameraGetsTheTable) {
  ColorTable wanted = tableOf(2);
  wanted.segments[0] = {1, 2, 3, 4};
  load(wanted);
  ASSERT_THAT(robot_.color_tables, testing::SizeIs(1));
  const std::vector<longword>& table = robot_.color_tables.at(ocdtCHANNEL2);
  EXPECT_THAT(std::vector<longword>(table.begin() + 1, table.end() - 1), testing::Each(ocdtINIT));
  EXPECT_EQ(table.front(), longword{4} << 24 | longword{3} << 16 | longword{2} << 8 | longword{1});
  EXPECT_EQ(table.back(), longword{190} << 24 | longword{120} << 16 | longword{230} << 8 | longword{150});
}

TEST_F(ColorsTest, EachChannelWithATableIsCounted) {
  load(tableOf(0));
  load(tableOf(6));
  draw(10, 20, 4, 2, 0, &robot_.color_plane);
  draw(50, 23, 1, 1, 0, &robot_.color_plane);
  draw(7, 22, 2, 1, 0, &robot_.color_plane);
  draw(30, 30, 3, 3, 1, &robot_.color_plane);          // has no table
  draw(0, kHeight - 1, 9, 1, 0, &robot_.color_plane);  // the camera's tag
  draw(12, 20, 4, 2, 6, &robot_.color_plane);          // partly the same pixels
  switchOn(1, true);
  const Colors colors = nextImage();
  EXPECT_EQ(colors.regions.image_count, robot_.lastImage());
  EXPECT_EQ(colors.regions.frame_number, clock_.frame());
  EXPECT_EQ(colors.regions.width, kWidth);
  EXPECT_EQ(colors.regions.height, kHeight);
  std::vector<byte> without_tag = robot_.color_plane;
  std::fill(without_tag.end() - kWidth, without_tag.end(), byte{0});
  EXPECT_EQ(colors.plane, without_tag);
  ASSERT_EQ(colors.regions.count, 2);
  const auto numbersOf = [&colors](int i) {
    const ColorRegion& region = colors.regions.regions[i];
    return std::vector<unsigned>{region.channel, region.pixels, region.x,     region.y,
                                 region.left,    region.top,    region.width, region.height};
  };
  EXPECT_THAT(numbersOf(0), testing::ElementsAre(0, 11, (64 * (2 * (10 + 11 + 12 + 13) + 50 + 7 + 8) + 5) / 11,
                                                 (64 * (4 * 20 + 4 * 21 + 2 * 22 + 23) + 5) / 11, 7, 20, 44, 4));
  EXPECT_THAT(numbersOf(1), testing::ElementsAre(6, 8, 64 * 54 / 4, 64 * 41 / 2, 12, 20, 4, 2));
}

TEST_F(ColorsTest, HaveNoPlaneThatIsLargerThanOfAnErs7) {
  load(tableOf(0));
  for (const unsigned width : {104U, 105U}) {
    robot_.color_plane.assign(width * kHeight, 1);
    switchOn(1, true);
    const Colors colors = nextImage();
    EXPECT_EQ(colors.regions.has_plane, width == 104);
    EXPECT_EQ(colors.regions.regions[0].width, width);
  }
}

TEST_F(ColorsTest, ComeForEveryNthImageUntilTheyAreSwitchedOff) {
  load(tableOf(0));
  switchOn(3);
  pushed();
  for (int i = 0; i < 9; ++i) {
    takeImage();
  }
  EXPECT_THAT(pushed(), testing::SizeIs(3));
  EXPECT_EQ(answerTo('Z', COLORS_OFF).header.kind, 'z');
  pushed();
  takeImage();
  EXPECT_THAT(pushed(), testing::IsEmpty());
}

TEST_F(ColorsTest, NoneFollowTheAnswerThatSwitchesThemOffOrLoadsAnotherTable) {
  for (const std::string& change : {frame('Z', COLORS_OFF, 2), frame('Z', COLORS_TABLE, 2, payloadOf(tableOf(0)))}) {
    connectBehindAPicture();
    send(frame('Z', COLORS_ON, 1, colorSettings(1)));
    takeImage();
    send(change);
    std::optional<Frame> next = nextFrame();
    while (next && next->header.request_number != 2) {
      next = nextFrame();
    }
    EXPECT_THAT(pushed(), testing::IsEmpty());
  }
}

TEST_F(ColorsTest, AClientThatReadsLateGetsOnlyTheNewest) {
  connectBehindAPicture();
  send(frame('Z', COLORS_ON, 1, colorSettings(1)));
  for (int i = 0; i < 20; ++i) {
    takeImage();
  }
  EXPECT_EQ(payloadIn<ColorRegions>(nextPush(COLORS_PUSH)).image_count, robot_.lastImage());
  EXPECT_THAT(pushed(), testing::IsEmpty());
}

TEST_F(ColorsTest, AnEmptyTableEndsTheChannel) {
  load(tableOf(0));
  ColorTable dark = tableOf(3);
  std::swap(dark.segments[0], dark.segments[31]);
  load(dark);
  ColorTable empty = tableOf(0);
  empty.segments[31] = EMPTY_COLOR_SEGMENT;
  load(empty);
  EXPECT_THAT(robot_.color_tables.at(ocdtCHANNEL0), testing::Each(ocdtINIT));
  switchOn();
  const Colors colors = nextImage();
  ASSERT_EQ(colors.regions.count, 1);
  EXPECT_EQ(colors.regions.regions[0].channel, 3);
  EXPECT_FALSE(colors.regions.has_plane);
}

TEST_F(ColorsTest, NothingIsLeftForTheNextClient) {
  load(tableOf(0));
  load(tableOf(6));
  EXPECT_THAT(robot_.color_tables, testing::SizeIs(2));
  switchOn();
  reconnect();
  EXPECT_THAT(robot_.color_tables.at(ocdtCHANNEL0), testing::Each(ocdtINIT));
  EXPECT_THAT(robot_.color_tables.at(ocdtCHANNEL6), testing::Each(ocdtINIT));
  takeImage();
  EXPECT_THAT(pushed(), testing::IsEmpty());
  switchOn();
  EXPECT_EQ(nextImage().regions.count, 0);
}

TEST_F(ColorsTest, ACameraWithoutThePlaneIsReportedOnce) {
  robot_.color_plane.clear();
  switchOn();
  takeImage();
  std::optional<Frame> report = frameThatIsHere();
  ASSERT_TRUE(report);
  expectRefusal(*report, CODE_NOT_SUPPORTED, "no plane");
  takeImage();
  EXPECT_FALSE(frameThatIsHere());
}

}  // namespace
