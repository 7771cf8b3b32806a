// Tables of the colour detection: files, the service, and what is published of the colours detected.
#include <aibo_driver/LoadColorTable.h>
#include <gmock/gmock.h>
#include <ros/package.h>

#include "camera/color_table_file.h"
#include "node/camera/color_publisher.h"
#include "node/services.h"
#include "support/fake_client.h"
#include "support/refusal.h"
#include "support/temporary_folder.h"
#include "unit/driver/call_service.h"

namespace aibo_driver::node {
namespace {

using aibo_client::ColorRange;
using aibo_client::ColorTable;
using aibo_client::ConnectionState;
using camera::colorOf;
using camera::ColorTableException;
using camera::loadColorTable;
using camera::parseColorTable;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

constexpr char kPink[] =
    "name: pink\n"
    "ranges: [\n"
    "  {y: [0, 159], cr: [150, 230], cb: [120, 190]},\n"
    "  {y: [160, 255], cr: [160, 230], cb: [120, 190]}\n"
    "]\n";

std::string tableRefusal(const std::string& text) {
  return test_support::refusalOf<ColorTableException>([&] { parseColorTable(text, "FILE"); });
}

TEST(ColorTableFile, HasRangesForStepsOfBrightness) {
  const ColorTable table = parseColorTable(kPink, "FILE");
  EXPECT_EQ(table.name, "pink");
  EXPECT_EQ(table.segments[0], (ColorRange{150, 230, 120, 190}));
  EXPECT_EQ(table.segments[19], (ColorRange{150, 230, 120, 190}));
  EXPECT_EQ(table.segments[20], (ColorRange{160, 230, 120, 190}));
  EXPECT_EQ(table.segments[31], (ColorRange{160, 230, 120, 190}));
  const ColorTable corrected = parseColorTable(
      "name: a\nranges:\n- {y: [0, 255], cr: [0, 1], cb: [0, 1]}\n- {y: [8, 15], cr: [1, 2], cb: [3, 4]}\n", "FILE");
  EXPECT_EQ(corrected.segments[1], (ColorRange{1, 2, 3, 4})) << "the last range counts";
}

TEST(ColorTableFile, IsWrittenAsItIsRead) {
  EXPECT_EQ(camera::toYaml(parseColorTable(kPink, "FILE")), kPink);
  ColorTable gaps;
  gaps.name = "a: strange \"name\"";
  gaps.segments[3] = ColorRange{0, 255, 7, 7};
  gaps.segments[5] = ColorRange{0, 255, 7, 8};
  gaps.segments.back() = ColorRange{0, 255, 7, 9};
  const ColorTable again = parseColorTable(camera::toYaml(gaps), "FILE");
  EXPECT_EQ(again.name, gaps.name);
  EXPECT_EQ(again.segments, gaps.segments);
}

TEST(ColorTableFile, IsRefusedIfItWasCutOff) {
  const std::string whole = kPink;
  for (std::size_t size = 0; size < whole.size() - 1; ++size) {
    EXPECT_NE(tableRefusal(whole.substr(0, size)), "") << size;
  }
}

// Of Notepad, of an editor under DOS, and of one that writes Latin-1.
TEST(ColorTableFile, IsReadWhateverEditorWroteIt) {
  for (const char* const text :
       {"\xef\xbb\xbfname: pink # sch\xc3\xb6n\r\nranges: [{y: [0, 7], cr: [1, 2], cb: [3, 4]}]\r\n",
        "name: pink\r\nranges: [{y: [0, 7], cr: [1, 2], cb: [3, 4]}]\r\n\x1a",
        "# \xfc\x1a\x85\xff\nname: pink\nranges: [{y: [0, 7], cr: [1, 2], cb: [3, 4]}]"}) {
    EXPECT_EQ(tableRefusal(text), "") << text;
    EXPECT_EQ(parseColorTable(text, "FILE").segments[0], (ColorRange{1, 2, 3, 4})) << text;
  }
}

TEST(ColorTableFile, IsRefusedWithWhatIsWrongAndWhere) {
  const std::string ranges = "\nranges: [{y: [0, 7], cr: [1, 2], cb: [3, 4]}]";
  const std::pair<std::string, const char*> rows[] = {
      {"\xef\xbb\xbfname: a\r\n\tkey: b\r\n\x1a", "see its line 2."},
      {"name: pi\xfcnk" + ranges, "have a name"},  // Latin-1 outside of a comment
      {"name: pink\x1a" + ranges, "have a name"},  // an end of file that is none
      {std::string(8193, '['), "too long"},
      {std::string(8192, '['), "FILE: it is not YAML"},
      {"", "no list of ranges"},
      {"name: a\nranges: []", "no list of ranges"},
      {"[name, ranges]", "no list of ranges"},
      {"ranges: [{y: [0, 7], cr: [0, 1], cb: [0, 1]}]", "name"},
      {"name: [a]" + ranges, "have a name"},
      {"name: a\nranges: [3]", "FILE, range 1"},
      {"name: a\nranges: [{y: [0, 7], cr: [0, 1]}]", "range 1: cb is missing"},
      {"name: a\nranges: [{y: [0, 7], cr: [0, 256], cb: [0, 1]}]", "cr is [0, 256]"},
      {"name: a\nranges: [{y: [0, 7], cr: [9, 8], cb: [0, 1]}]", "cr is [9, 8]"},
      {"name: a\nranges: [{y: [0, 7], cr: [a, b], cb: [0, 1]}]", "two whole numbers"},
      {"name: a\nranges: [{y: [4, 7], cr: [0, 1], cb: [0, 1]}]", "steps of 8"},
      {"name: a\nranges: [{y: [0, 8], cr: [0, 1], cb: [0, 1]}]", "steps of 8"},
  };
  for (const auto& [text, problem] : rows) {
    EXPECT_THAT(tableRefusal(text), HasSubstr(problem));
  }
  EXPECT_THAT(tableRefusal("name: a\nkey: [secret"), testing::Not(HasSubstr("secret"))) << "it may be anybody's file";
}

TEST(ColorTableFile, PutsOnlyPlainAndShortTextIntoTopicsAndMessages) {
  const std::string ranges = "\nranges: [{y: [0, 7], cr: [0, 1], cb: [0, 1]}]";
  EXPECT_EQ(tableRefusal("name: b\xC3\xA4ll" + ranges), "");
  for (const std::string& name : {std::string("\"a\\e[2J\""), std::string("\"a\\u202e\""), std::string(65, 'a')}) {
    EXPECT_THAT(tableRefusal("name: " + name + ranges), HasSubstr("without control characters")) << name;
  }
  EXPECT_THAT(tableRefusal("name: a\nranges: [{y: [0, 7], cr: " + std::string(1000, 'a') + ", cb: [0, 1]}]"),
              HasSubstr("cr is something else;"));
  EXPECT_THAT(tableRefusal("name: a\nranges: [{y: [0, 7], cr: a\xE2\x80\xAE, cb: [0, 1]}]"),
              HasSubstr("cr is something else;"));
}

TEST(ColorTableFile, OfAFolderIsFoundByItsName) {
  const std::string folder = ros::package::getPath("aibo_driver") + "/config/colors";
  EXPECT_EQ(loadColorTable("pink_ball", folder).segments[31], (ColorRange{160, 230, 120, 190}));
  EXPECT_THROW(loadColorTable("no_such_table", folder), ColorTableException);
  EXPECT_THAT(test_support::refusalOf<ColorTableException>([&] { loadColorTable("no_such.yaml", folder); }),
              HasSubstr("'no_such.yaml'"))
      << "a file in the working directory";
}

TEST(ColorTableFile, StandsForItsColor) {
  ColorTable mean;
  mean.segments[1] = ColorRange{140, 150, 118, 122};
  mean.segments[2] = mean.segments[4] = ColorRange{152, 160, 102, 106};
  EXPECT_EQ(colorOf(mean).red, 194) << "160 + 1.402 * 24.33";
  EXPECT_EQ(colorOf(mean).green, 149) << "160 - 0.714 * 24.33 + 0.344 * 18.67";
  EXPECT_EQ(colorOf(mean).blue, 126) << "160 - 1.772 * 18.67";
  const camera::RgbColor grey = colorOf({});
  EXPECT_THAT((std::vector<int>{grey.red, grey.green, grey.blue}), ElementsAre(160, 160, 160));
}

class ColorTableServiceTest : public ::testing::Test {
 protected:
  ColorTableServiceTest() {
    client_.present.state = ConnectionState::kConnected;
    client_.present.robot.capabilities = {"H", "Z"};
  }

  LoadColorTable::Response load(int channel, const std::string& file, const std::string& table = "") {
    LoadColorTable::Request request;
    request.channel = static_cast<std::uint8_t>(channel);
    request.file = file;
    request.table = table;
    return test_support::callService<LoadColorTable>(colorTableServices(model_, client_, set_table_),
                                                     "load_color_table", request);
  }

  test_support::FakeClient client_;
  std::vector<std::pair<int, std::string>> loaded_;
  robot_model::RobotModel model_ = *robot_model::findRobotModel("ERS-7");
  const SetColorTable set_table_ = [this](int channel, const aibo_client::ColorTablePtr& table) {
    loaded_.emplace_back(channel, table ? table->name : "");
  };
};

TEST_F(ColorTableServiceTest, AFileATextOrNothing) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path("a.txt")) << kPink;
  EXPECT_THAT(load(2, folder.path("a.txt").string()).message, HasSubstr("Channel 2 has the table pink"));
  EXPECT_THAT(load(0, "pink_ball").message, HasSubstr("Channel 0 has the table pink_ball"));
  EXPECT_TRUE(load(6, "", kPink).success);
  EXPECT_THAT(load(6, "", "").message, HasSubstr("Channel 6 has no table"));
  EXPECT_THAT(loaded_, ElementsAre(Pair(2, "pink"), Pair(0, "pink_ball"), Pair(6, "pink"), Pair(6, "")));
}

TEST_F(ColorTableServiceTest, WhatCannotBeLoadedLeavesTheChannelAsItIs) {
  EXPECT_THAT(load(7, "pink_ball").message, HasSubstr("no channel 7"));
  EXPECT_THAT(load(0, "", "nonsense").message, HasSubstr("No table was loaded: table: it has no list of ranges"));
  EXPECT_THAT(load(0, "/no/such/file.yaml").message, HasSubstr("/no/such/file.yaml"));
  EXPECT_THAT(load(0, "pink_ball", kPink).message, HasSubstr("both given"));
  EXPECT_FALSE(load(0, "", "nonsense").success);
  EXPECT_THAT(loaded_, testing::IsEmpty());
  model_ = *robot_model::findRobotModel("ERS-210");
  EXPECT_TRUE(load(7, "pink_ball").success);
  EXPECT_THAT(load(8, "pink_ball").message, HasSubstr("an ERS-210 has the channels 0 to 7"));
}

TEST_F(ColorTableServiceTest, SaysWhenTheRobotDoesNotHaveItYet) {
  client_.present.state = ConnectionState::kConnecting;
  const LoadColorTable::Response later = load(0, "pink_ball");
  EXPECT_TRUE(later.success);
  EXPECT_THAT(later.message, HasSubstr("gets it as soon as it is connected"));
  client_.present = {};
  client_.present.state = ConnectionState::kConnected;
  const LoadColorTable::Response response = load(0, "pink_ball");
  EXPECT_FALSE(response.success);
  EXPECT_THAT(response.message, HasSubstr("detects no colours"));
  EXPECT_THAT(loaded_, ElementsAre(Pair(0, "pink_ball"), Pair(0, "pink_ball"))) << "it is kept";
}

TEST_F(ColorTableServiceTest, TablesOfTheStartAreForTheChannelsInTurn) {
  loadColorTables(" pink_ball, pink_ball pink_ball", model_, set_table_);
  EXPECT_THAT(loaded_, ElementsAre(Pair(0, "pink_ball"), Pair(1, "pink_ball"), Pair(2, "pink_ball")));
}

TEST_F(ColorTableServiceTest, ATableOfTheStartThatCannotBeLoadedIsAnError) {
  const std::string problem = test_support::refusalOf<aibo_client::InvalidArgumentException>(
      [&] { loadColorTables("pink_ball no_such_table", model_, set_table_); });
  EXPECT_THAT(problem, HasSubstr("Parameter color_tables names the table 'no_such_table'"));
  EXPECT_THAT(problem, HasSubstr("there is no such file"));
}

aibo_client::DetectedColors someColors() {
  aibo_client::DetectedColors colors;
  colors.frame_number = 400;
  colors.image_count = 7;
  colors.width = 4;
  colors.height = 1;
  colors.regions = {
      {3, "pink", 2, 1.5, 0, 1, 0, 2, 1}, {4, "red", 5, 2.5, 6, 1, 3, 4, 7}, {5, "blue", 0, 0, 0, 0, 0, 0, 0}};
  colors.mask = {8, 0, 9, 0x80};
  return colors;
}

TEST(ColorMessages, AreInPixelsOfThePicture) {
  std_msgs::Header header;
  header.frame_id = "eye";
  header.stamp = ros::Time(7, 5);
  const ColorRegions regions = toRegions(someColors(), header);
  EXPECT_EQ(regions.header, header);
  EXPECT_EQ(regions.frame_number, 400U);
  EXPECT_EQ(regions.image_count, 7U);
  EXPECT_EQ(regions.width, 8U);
  EXPECT_EQ(regions.height, 2U);
  ASSERT_EQ(regions.regions.size(), 3U);
  const ColorRegion& region = regions.regions[0];
  EXPECT_EQ(region.channel, 3);
  EXPECT_EQ(region.name, "pink");
  EXPECT_EQ(region.pixels, 8U);
  EXPECT_FLOAT_EQ(region.x, 3.5) << "the middle of the columns 2 to 5";
  const ColorRegion& red = regions.regions[1];
  EXPECT_FLOAT_EQ(red.y, 12.5);
  EXPECT_EQ(red.box.x_offset, 2U);
  EXPECT_EQ(red.box.y_offset, 6U);
  EXPECT_EQ(red.box.width, 8U);
  EXPECT_EQ(red.box.height, 14U);
  EXPECT_EQ(regions.regions[2].pixels, 0U);
  EXPECT_FLOAT_EQ(regions.regions[2].x, 0);
}

TEST(ColorMessages, TheMaskHasTheColorOfTheLowestChannel) {
  ChannelColors channels{};
  channels[0] = {1, 2, 3};
  channels[3] = {4, 5, 6};
  channels[7] = {7, 8, 9};
  std_msgs::Header header;
  header.frame_id = "eye";
  header.stamp = ros::Time(7, 5);
  const sensor_msgs::Image mask = toMask(someColors(), channels, header);
  EXPECT_EQ(mask.header, header);
  EXPECT_EQ(mask.encoding, "rgb8");
  EXPECT_EQ(mask.step, 12U);
  EXPECT_THAT(mask.data, ElementsAre(4, 5, 6, 0, 0, 0, 1, 2, 3, 7, 8, 9));
}

}  // namespace
}  // namespace aibo_driver::node
