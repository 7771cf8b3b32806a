#include "client/argument_checks.h"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "aibo_client/rcserver_client.h"
#include "client/calls.h"
#include "support/refusal.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using testing::HasSubstr;

namespace {

std::string complaintOf(const std::function<void()>& check) {
  return test_support::refusalOf<InvalidArgumentException>(check);
}

TEST(ArgumentChecksTest, TargetsAreChecked) {
  const struct {
    std::vector<JointTarget> targets;
    int duration;
    std::string complaint;
  } rows[] = {
      {{}, 0, "the number of joints is 0"},
      {std::vector<JointTarget>(33), 0, "the number of joints is 33"},
      {{{0, 0}}, 0, "the id of a joint is 0"},  // it would be all joints
      {{{256, 0}}, 0, "the id of a joint is 256"},
      {{{3, 0}, {3, 1}}, 0, "the joint 3 is given twice"},
      {{{3, std::nan("")}}, 0, "joint 3: its position is"},
      {{{3, -INFINITY}}, 0, "joint 3: its position is"},
      {{{3, 7}}, 0, "joint 3: its position is 7.0"},
      {{{3, 0}}, -1, "duration is -1 ms"},
      {{{3, 0}}, 65536, "duration is 65536 ms"},
  };
  EXPECT_NO_THROW(checkJointTargets({{1, 0}, {255, -6.28}}, milliseconds(65535)));
  for (const auto& row : rows) {
    EXPECT_THAT(complaintOf([&] { checkJointTargets(row.targets, milliseconds(row.duration)); }),
                HasSubstr(row.complaint));
  }
}

TEST(ArgumentChecksTest, SpeedLimitsAndLedsAreChecked) {
  EXPECT_NO_THROW(checkJointSpeedLimits({{1, 0.001}, {2, 100}}));
  for (const double speed : {0.0, -1.0, 101.0, std::nan("")}) {
    EXPECT_THROW(checkJointSpeedLimits({{1, speed}}), InvalidArgumentException) << speed;
  }
  EXPECT_THROW(checkJointSpeedLimits({{1, 1}, {1, 2}}), InvalidArgumentException);
  EXPECT_NO_THROW(checkLedCommands({{1, 0}, {255, 255}}));
  for (const std::vector<LedCommand>& leds :
       {std::vector<LedCommand>(), {{0, 1}}, {{1, 1}, {1, 2}}, {{1, -1}}, {{1, 256}}}) {
    EXPECT_THROW(checkLedCommands(leds), InvalidArgumentException);
  }
}

TEST(ArgumentChecksTest, EachSegmentOfAColorTableIsChecked) {
  ColorTable table;
  EXPECT_NO_THROW(checkColorTable(table));
  for (std::optional<ColorRange>& segment : table.segments) {
    segment = ColorRange{0, 256, 0, 0};
    EXPECT_THROW(checkColorTable(table), InvalidArgumentException);
    segment.reset();
  }
  const std::string where = " of segment 2 of the colour table is ";
  const std::pair<ColorRange, std::string> rows[] = {
      {{0, 255, 0, 255}, ""},
      {{7, 7, 9, 9}, ""},
      {{8, 7, 0, 9}, "the lowest Cr" + where + "8, but has to be 0..7"},
      {{-1, 7, 0, 9}, "the lowest Cr" + where + "-1, but has to be 0..7"},
      {{0, 7, 10, 9}, "the lowest Cb" + where + "10, but has to be 0..9"},
      {{0, 7, 0, 256}, "the highest Cb" + where + "256, but has to be 0..255"},
  };
  for (const auto& [range, complaint] : rows) {
    table.segments[2] = range;
    EXPECT_EQ(complaint, complaintOf([&table] { checkColorTable(table); }));
  }
}

TEST(ArgumentChecksTest, NamesAreChecked) {
  EXPECT_EQ("NOD.MTN", callToPlay("nod.mtn").object);
  for (const std::string& name : {std::string("../NOD.MTN"), std::string("NOD"), std::string(), std::string(1, '\0')}) {
    EXPECT_THROW(callToPlay(name), InvalidArgumentException) << name;
  }
}

TEST(ArgumentChecksTest, AHostIsANameOrAnAddressAlone) {
  for (const char* good : {"aibo", "aibo.local", "192.168.1.5", "::1", "fe80::1%wlan0"}) {
    EXPECT_NO_THROW(checkHost(good)) << good;
  }
  for (const std::string host : {"robot:54321", "192.168.1.5:54321", "[::1]:54321", "[::1]", "::1:x", "http://robot",
                                 "robot/", "my robot", ""}) {
    EXPECT_THAT(complaintOf([&host] { checkHost(host); }), HasSubstr("host is '" + host + "', but has to be"));
  }
}

TEST(ArgumentChecksTest, AnIpv6AddressIsWrittenInBrackets) {
  EXPECT_EQ("[::1]:54321", addressText("::1", 54321));
  EXPECT_EQ("aibo:1", addressText("aibo", 1));
}

TEST(ArgumentChecksTest, ABadOptionIsNamedWithItsRange) {
  using Options = ClientOptions;
  const std::pair<std::function<void(Options&)>, std::string> rows[] = {
      {[](Options&) {}, ""},
      {[](Options& options) { options.host = ""; }, "host is '', but has to be the robot's name or address"},
      {[](Options& options) { options.port = 0; }, "port is 0, but has to be 1..65535"},
      {[](Options& options) { options.port = 65536; }, "port is 65536, but has to be 1..65535"},
      {[](Options& options) { options.jpeg_quality = 0; }, "jpeg_quality is 0, but has to be 1..100"},
      {[](Options& options) { options.jpeg_quality = 101; }, "jpeg_quality is 101, but has to be 1..100"},
      {[](Options& options) { options.protocol_version = 2; }, "protocol_version is 2, but has to be 0..1"},
      {[](Options& options) { options.connect_timeout = milliseconds(49); },
       "connect_timeout is 49 ms, but has to be 50..60000 ms"},
      {[](Options& options) { options.read_timeout = milliseconds(60001); },
       "read_timeout is 60001 ms, but has to be 50..60000 ms"},
      {[](Options& options) { options.reconnect_wait_min = milliseconds(9); },
       "reconnect_wait_min is 9 ms, but has to be 10..2000 ms"},
      {[](Options& options) { options.reconnect_wait_min = milliseconds(2001); },
       "reconnect_wait_min is 2001 ms, but has to be 10..2000 ms"},
      {[](Options& options) { options.reconnect_wait_max = milliseconds(60001); },
       "reconnect_wait_max is 60001 ms, but has to be 10..60000 ms"},
  };
  for (const auto& [change, expected] : rows) {
    ClientOptions options;
    change(options);
    const std::string complaint = complaintOf([&options] { RcServerClient(options, {}); });
    EXPECT_THAT(complaint, HasSubstr(expected));
    EXPECT_EQ(expected.empty(), complaint.empty()) << complaint;
  }
}

}  // namespace
