#include "client/argument_checks.h"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>
#include <string>

#include "aibo_client/rcserver_client.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using testing::HasSubstr;

namespace {

std::string complaintAbout(const std::vector<JointTarget>& targets, milliseconds duration = milliseconds(0)) {
  try {
    checkJointTargets(targets, duration);
  } catch (const InvalidArgumentException& error) {
    return error.what();
  }
  return "";
}

TEST(ArgumentChecksTest, TargetsAreChecked) {
  EXPECT_EQ("", complaintAbout({{1, 0}, {255, -6.28}}, milliseconds(65535)));
  EXPECT_THAT(complaintAbout({}), HasSubstr("the number of joints is 0"));
  EXPECT_THAT(complaintAbout(std::vector<JointTarget>(33)), HasSubstr("the number of joints is 33"));
  EXPECT_THAT(complaintAbout({{0, 0}}), HasSubstr("the id of a joint is 0")) << "0 would be all joints";
  EXPECT_THAT(complaintAbout({{256, 0}}), HasSubstr("the id of a joint is 256"));
  EXPECT_THAT(complaintAbout({{3, 0}, {3, 1}}), HasSubstr("the joint 3 is given twice"));
  EXPECT_THAT(complaintAbout({{3, std::nan("")}}), HasSubstr("joint 3: its position is"));
  EXPECT_THAT(complaintAbout({{3, -INFINITY}}), HasSubstr("joint 3: its position is"));
  EXPECT_THAT(complaintAbout({{3, 7}}), HasSubstr("joint 3: its position is 7.0"));
  EXPECT_THAT(complaintAbout({{3, 0}}, milliseconds(-1)), HasSubstr("duration is -1 ms"));
  EXPECT_THAT(complaintAbout({{3, 0}}, milliseconds(65536)), HasSubstr("duration is 65536 ms"));
}

TEST(ArgumentChecksTest, SpeedLimitsAreChecked) {
  EXPECT_NO_THROW(checkJointSpeedLimits({{1, 0.001}, {2, 100}}));
  EXPECT_THROW(checkJointSpeedLimits({{1, 0}}), InvalidArgumentException);
  EXPECT_THROW(checkJointSpeedLimits({{1, -1}}), InvalidArgumentException);
  EXPECT_THROW(checkJointSpeedLimits({{1, 101}}), InvalidArgumentException);
  EXPECT_THROW(checkJointSpeedLimits({{1, std::nan("")}}), InvalidArgumentException);
  EXPECT_THROW(checkJointSpeedLimits({{1, 1}, {1, 2}}), InvalidArgumentException);
}

TEST(ArgumentChecksTest, LedsAreChecked) {
  EXPECT_NO_THROW(checkLedCommands({{1, 0}, {255, 255}}));
  EXPECT_THROW(checkLedCommands({}), InvalidArgumentException);
  EXPECT_THROW(checkLedCommands({{0, 1}}), InvalidArgumentException);
  EXPECT_THROW(checkLedCommands({{1, 1}, {1, 2}}), InvalidArgumentException);
  EXPECT_THROW(checkLedCommands({{1, -1}}), InvalidArgumentException);
  EXPECT_THROW(checkLedCommands({{1, 256}}), InvalidArgumentException);
}

TEST(ArgumentChecksTest, EachSegmentOfAColorTableIsChecked) {
  ColorTable table;
  EXPECT_NO_THROW(checkColorTable(table));
  for (std::optional<ColorRange>& segment : table.segments) {
    segment = ColorRange{0, 256, 0, 0};
    EXPECT_THROW(checkColorTable(table), InvalidArgumentException);
    segment.reset();
  }
  const auto complaint_about = [&table](const ColorRange& range) -> std::string {
    table.segments[2] = range;
    try {
      checkColorTable(table);
    } catch (const InvalidArgumentException& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ("", complaint_about({0, 255, 0, 255}));
  EXPECT_EQ("", complaint_about({7, 7, 9, 9}));
  const std::string where = " of segment 2 of the colour table is ";
  EXPECT_EQ("the lowest Cr" + where + "8, but has to be 0..7", complaint_about({8, 7, 0, 9}));
  EXPECT_EQ("the lowest Cr" + where + "-1, but has to be 0..7", complaint_about({-1, 7, 0, 9}));
  EXPECT_EQ("the highest Cr" + where + "-1, but has to be 0..255", complaint_about({-1, -1, 0, 9}));
  EXPECT_EQ("the lowest Cb" + where + "10, but has to be 0..9", complaint_about({0, 7, 10, 9}));
  EXPECT_EQ("the lowest Cb" + where + "-1, but has to be 0..9", complaint_about({0, 7, -1, 9}));
  EXPECT_EQ("the highest Cb" + where + "256, but has to be 0..255", complaint_about({0, 7, 0, 256}));
}

TEST(ArgumentChecksTest, MotionsAreChecked) {
  EXPECT_EQ("NOD.MTN", checkedMotionName("nod.mtn"));
  for (const std::string& name : {std::string("../NOD.MTN"), std::string("NOD"), std::string(), std::string(1, '\0')}) {
    EXPECT_THROW(checkedMotionName(name), InvalidArgumentException) << name;
  }
  EXPECT_NO_THROW(checkMotionContent(std::vector<std::uint8_t>(65523)));
  EXPECT_THROW(checkMotionContent(std::vector<std::uint8_t>(65524)), InvalidArgumentException);
  EXPECT_THROW(checkMotionContent({}), InvalidArgumentException);
}

template <typename Change>
std::string complaintAboutOptions(const Change& change) {
  ClientOptions options;
  change(options);
  try {
    RcServerClient client(options, {});
  } catch (const InvalidArgumentException& error) {
    return error.what();
  }
  return "";
}

TEST(ArgumentChecksTest, ANameThatIsDangerousForANewMotionIsRefusedOnlyForThat) {
  EXPECT_EQ("WAG~1.MTN", checkedMotionName("wag~1.mtn"));
  EXPECT_EQ("WAG.MTN", checkedNewMotionName("wag.mtn"));
  for (const std::string name : {"CON.MTN", "com1.mtn", "WAG~1.MTN"}) {
    EXPECT_THROW(checkedNewMotionName(name), InvalidArgumentException) << name;
  }
}

TEST(ArgumentChecksTest, AHostIsANameOrAnAddressAlone) {
  for (const char* good : {"aibo", "aibo.local", "192.168.1.5", "::1", "fe80::1%wlan0"}) {
    EXPECT_NO_THROW(checkHost(good)) << good;
  }
  const std::pair<const char*, const char*> wrong[] = {
      {"robot:54321", "which has a port in it; host has to be 'robot' and port 54321"},
      {"192.168.1.5:54321", "host has to be '192.168.1.5' and port 54321"},
      {"[::1]:54321", "host has to be '::1' and port 54321"},
      {"[::1]", "but has to be '::1', without brackets"},
      {"::1:x", "neither a name nor an address"},
      {"http://robot", "without a scheme"},
      {"robot/", "without a scheme, path"},
      {"my robot", "or blank"},
      {"", "host is empty"}};
  for (const auto& [host, problem] : wrong) {
    ClientOptions options;
    options.host = host;
    try {
      checkClientOptions(options);
      ADD_FAILURE() << host;
    } catch (const InvalidArgumentException& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(problem));
    }
  }
}

TEST(ArgumentChecksTest, AnIpv6AddressIsWrittenInBrackets) {
  EXPECT_EQ("[::1]:54321", addressText("::1", 54321));
  EXPECT_EQ("aibo:1", addressText("aibo", 1));
}

TEST(ArgumentChecksTest, TheDefaultOptionsAreAllowed) {
  EXPECT_EQ("", complaintAboutOptions([](ClientOptions&) {}));
}

TEST(ArgumentChecksTest, ABadOptionIsNamedWithItsRange) {
  EXPECT_THAT(complaintAboutOptions([](ClientOptions& o) { o.host = ""; }), HasSubstr("host is empty"));
  EXPECT_EQ("port is 0, but has to be 1..65535", complaintAboutOptions([](ClientOptions& o) { o.port = 0; }));
  EXPECT_THAT(complaintAboutOptions([](ClientOptions& o) { o.port = 65536; }), HasSubstr("port"));
  EXPECT_THAT(complaintAboutOptions([](ClientOptions& o) { o.jpeg_quality = 0; }), HasSubstr("jpeg_quality"));
  EXPECT_THAT(complaintAboutOptions([](ClientOptions& o) { o.jpeg_quality = 101; }), HasSubstr("1..100"));
  EXPECT_THAT(complaintAboutOptions([](ClientOptions& o) { o.protocol_version = 2; }), HasSubstr("protocol_version"));
  EXPECT_EQ("connect_timeout is 49 ms, but has to be 50..60000 ms",
            complaintAboutOptions([](ClientOptions& o) { o.connect_timeout = milliseconds(49); }));
  EXPECT_THAT(complaintAboutOptions([](ClientOptions& o) { o.read_timeout = milliseconds(60001); }),
              HasSubstr("read_timeout"));
  EXPECT_THAT(complaintAboutOptions([](ClientOptions& o) { o.reconnect_wait_min = milliseconds(9); }),
              HasSubstr("reconnect_wait_min"));
  EXPECT_THAT(complaintAboutOptions([](ClientOptions& o) { o.reconnect_wait_min = milliseconds(2001); }),
              HasSubstr("10..2000 ms"));
  EXPECT_THAT(complaintAboutOptions([](ClientOptions& o) { o.reconnect_wait_max = milliseconds(60001); }),
              HasSubstr("reconnect_wait_max"));
}

}  // namespace
