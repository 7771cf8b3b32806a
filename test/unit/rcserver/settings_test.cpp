// RCSERVER.CFG: what it sets, what is wrong with it, and who may connect.
#include <gmock/gmock.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fake_robot.h"
#include "rcserver/settings/AllowedAddresses.h"
#include "rcserver/settings/LineReader.h"
#include "rcserver/settings/Settings.h"
#include "rcserver_fixture.h"
#include "support/memory_stick.h"

namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pair;

constexpr unsigned kLoopback = 0x7f000001;

class Problems : public SettingsProblems {
 public:
  void Tell(int line, const char* text) override { all.emplace_back(line, text); }
  std::vector<std::pair<int, std::string>> all;
};

struct Read {
  Settings settings;
  std::vector<std::pair<int, std::string>> problems;
};

Read read(std::string text) {
  Read result;
  Problems problems;
  text.push_back('\n');  // fmemopen() takes no empty file
  std::FILE* file = fmemopen(text.data(), text.size(), "rb");
  readSettings(file, &result.settings, problems);
  std::fclose(file);
  result.problems = problems.all;
  return result;
}

// ------------------------------------------------------------------------------------------------------- the settings

TEST(Settings, NothingDangerousIsAllowedUnlessTheFileSaysSo) {
  const Settings settings = read("").settings;
  EXPECT_FALSE(settings.allow_upload);
  EXPECT_FALSE(settings.allow_delete);
  EXPECT_FALSE(settings.allow_shut_down);
  EXPECT_FALSE(settings.allow_reboot);
  EXPECT_EQ(settings.silent_client_seconds, 10U);
  EXPECT_TRUE(settings.allowed_addresses.Allow(0x01020304));
}

TEST(Settings, EachIsSetByItsName) {
  EXPECT_TRUE(read("ALLOW_UPLOAD=yes").settings.allow_upload);
  EXPECT_TRUE(read("ALLOW_DELETE=yes").settings.allow_delete);
  EXPECT_TRUE(read("ALLOW_SHUT_DOWN=yes").settings.allow_shut_down);
  EXPECT_TRUE(read("ALLOW_REBOOT=yes").settings.allow_reboot);
  EXPECT_EQ(read("SILENT_CLIENT_SECONDS=3600").settings.silent_client_seconds, 3600U);
  EXPECT_FALSE(read("ALLOWED_ADDRESSES=192.168.1.2").settings.allowed_addresses.Allow(0x01020304));
}

TEST(Settings, SpacesCommentsCapitalsLineEndsAndAMarkInFrontDoNotMatter) {
  const Read result = read(
      "\xef\xbb\xbf# written on another system\r\n"
      "\r\n"
      "  allow_upload = Yes \t# both of us\r\n"
      "ALLOW_DELETE=no#yes\r\n"
      "Silent_Client_Seconds\t=\t7\r\n");
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_TRUE(result.settings.allow_upload);
  EXPECT_FALSE(result.settings.allow_delete);
  EXPECT_EQ(result.settings.silent_client_seconds, 7U);
  EXPECT_TRUE(read("\xef\xbb\xbf"
                   "ALLOW_UPLOAD=yes")
                  .settings.allow_upload);
}

TEST(Settings, FileThatGoesWithTheServerAllowsNothingDangerousAndIsWithoutFault) {
  std::FILE* file = std::fopen((std::string(MEMORY_STICK) + "/" + SETTINGS_FILE).c_str(), "rb");
  ASSERT_NE(file, nullptr);
  Settings settings;
  Problems problems;
  readSettings(file, &settings, problems);
  std::fclose(file);
  EXPECT_THAT(problems.all, IsEmpty());
  EXPECT_FALSE(settings.allow_upload || settings.allow_delete || settings.allow_shut_down || settings.allow_reboot);
  EXPECT_TRUE(settings.allowed_addresses.Allow(0x01020304));
}

struct BrokenLine {
  std::string line;
  std::string told;
};

class BrokenLines : public ::testing::TestWithParam<BrokenLine> {};

TEST_P(BrokenLines, AreNamedAndTheSafeValueHolds) {
  const Read result = read("# comment\n" + GetParam().line + "\nALLOW_REBOOT=yes");
  ASSERT_FALSE(result.problems.empty());
  EXPECT_THAT(result.problems.front(), Pair(2, HasSubstr(GetParam().told))) << GetParam().line;
  EXPECT_FALSE(result.settings.allow_upload);
  EXPECT_EQ(result.settings.silent_client_seconds, 10U);
  EXPECT_TRUE(result.settings.allow_reboot) << "lines after it count";
}

INSTANTIATE_TEST_SUITE_P(
    Lines, BrokenLines,
    ::testing::Values(BrokenLine{"ALLOW_UPLOAD", "it is no NAME=VALUE"}, BrokenLine{"ALLOW UPLOAD=yes", "NAME=VALUE"},
                      BrokenLine{"=yes", "no such setting"}, BrokenLine{"ALLOW_UPLOADS=yes", "no such setting"},
                      BrokenLine{"ALLOW_UPLOA=yes", "no such setting"},
                      BrokenLine{"ALLOW_UPLOAD=", "ALLOW_UPLOAD= is neither yes nor no; it is no"},
                      BrokenLine{"ALLOW_UPLOAD=1", "neither yes nor no"},
                      BrokenLine{"ALLOW_UPLOAD=yes, sir", "neither yes nor no"},
                      BrokenLine{"SILENT_CLIENT_SECONDS=0", "1 to 3600; it is 10"},
                      BrokenLine{"SILENT_CLIENT_SECONDS=3601", "1 to 3600"},
                      BrokenLine{"SILENT_CLIENT_SECONDS=-5", "1 to 3600"},
                      BrokenLine{"SILENT_CLIENT_SECONDS=5s", "1 to 3600"},
                      BrokenLine{"SILENT_CLIENT_SECONDS=99999999999999999999", "1 to 3600"},
                      BrokenLine{"ALLOW_UPLOAD=" + std::string(300, 'x'), "neither yes nor no"},
                      BrokenLine{std::string(300, 'x'), "NAME=VALUE"},
                      BrokenLine{"ALLOW_UPLOAD=yes" + std::string(LineReader::MAX_LINE_SIZE, ' ') + "x", "no text"},
                      BrokenLine{std::string("ALLOW_UPLOAD=yes\0", 17), "no text"}));

TEST(Settings, NameThatIsThereTwiceIsNotAllowed) {
  const Read result = read("ALLOW_UPLOAD=yes\nALLOW_UPLOAD=yes");
  EXPECT_THAT(result.problems, ElementsAre(Pair(2, HasSubstr("for the second time; it is no"))));
  EXPECT_FALSE(result.settings.allow_upload);
}

TEST(Settings, BrokenListOfAddressesLetsNobodyIn) {
  const Read result = read("ALLOWED_ADDRESSES=192.168.1.20, 192.168.1");
  EXPECT_THAT(result.problems, ElementsAre(Pair(1, HasSubstr("nobody but 127.0.0.1 may connect"))));
  EXPECT_FALSE(result.settings.allowed_addresses.Allow(0xc0a80114));
  EXPECT_TRUE(result.settings.allowed_addresses.Allow(kLoopback));
}

class MisspeltAddresses : public ::testing::TestWithParam<std::string> {};

TEST_P(MisspeltAddresses, LetNobodyIn) {
  const Read result = read("ALLOW_REBOOT=yes\n" + GetParam() + "\nnonsense\n");
  EXPECT_THAT(result.problems,
              ElementsAre(Pair(2, HasSubstr("is passed over")), Pair(3, HasSubstr("is passed over")),
                          Pair(2, "was it ALLOWED_ADDRESSES? That is not set; nobody but 127.0.0.1 may connect")));
  EXPECT_FALSE(result.settings.allowed_addresses.Allow(0xc0a80114));
  EXPECT_TRUE(result.settings.allowed_addresses.Allow(kLoopback));
}

INSTANTIATE_TEST_SUITE_P(Lines, MisspeltAddresses,
                         ::testing::Values("ALLOWED_ADDRESSES 192.168.1.20", "ALLOWED_ADRESSES=192.168.1.20",
                                           "ALLOWED_ADDRESSES=192.168.1.20," + std::string(1024, ' ') +
                                               "192.168.1.21"));

TEST(Settings, LineThatIsPassedOverChangesNoAddressesThatAreSet) {
  const Read result = read("nonsense\nALLOWED_ADDRESSES=192.168.1.20");
  EXPECT_THAT(result.problems, ElementsAre(Pair(1, HasSubstr("is passed over"))));
  EXPECT_TRUE(result.settings.allowed_addresses.Allow(0xc0a80114));
  EXPECT_FALSE(result.settings.allowed_addresses.Allow(kLoopback));
}

// ---------------------------------------------------------------------------------------------------------- addresses

TEST(AllowedAddresses, AreAddressesAndRanges) {
  AllowedAddresses addresses;
  ASSERT_EQ(addresses.Read("192.168.1.20 ,\t10.0.0.7/8,172.16.5.0/31"), nullptr);
  EXPECT_TRUE(addresses.Allow(0xc0a80114));
  EXPECT_FALSE(addresses.Allow(0xc0a80115));
  EXPECT_TRUE(addresses.Allow(0x0affffff));
  EXPECT_FALSE(addresses.Allow(0x0b000000));
  EXPECT_TRUE(addresses.Allow(0xac100501));
  EXPECT_FALSE(addresses.Allow(0xac100502));
  EXPECT_FALSE(addresses.Allow(kLoopback)) << "what a list does not name";
}

TEST(AllowedAddresses, AllBitsAndNoBits) {
  AllowedAddresses addresses;
  ASSERT_EQ(addresses.Read("1.2.3.4/32"), nullptr);
  EXPECT_TRUE(addresses.Allow(0x01020304));
  EXPECT_FALSE(addresses.Allow(0x01020305));
  ASSERT_EQ(addresses.Read("1.2.3.4/0"), nullptr);
  EXPECT_TRUE(addresses.Allow(0xffffffff));
}

TEST(AllowedAddresses, WhatIsNoListIsRefusedAndChangesNothing) {
  AllowedAddresses addresses;
  ASSERT_EQ(addresses.Read("1.2.3.4"), nullptr);
  for (const char* list : {"", ",", "1.2.3", "1.2.3.4.5", "1.2.3.256", "1.2.3.4/", "1.2.3.4/33", "1.2.3.4/-1",
                           "1.2.3.4 5.6.7.8", "1.2.3.4,", ",1.2.3.4", "1.2.3.4,ANY", "localhost", "1..3.4",
                           "01.2.3.4567", "0x1.2.3.4", "1.2.3.4/24/24", "1. 2.3.4", "::1"}) {
    EXPECT_NE(addresses.Read(list), nullptr) << list;
  }
  EXPECT_TRUE(addresses.Allow(0x01020304));
  EXPECT_FALSE(addresses.Allow(0x01020305));
}

TEST(AllowedAddresses, HaveRoomForSoManyAndNoMore) {
  std::string list = "10.0.0.0";
  for (int i = 1; i < AllowedAddresses::MAX_RANGES; ++i) {
    list += ",10.0.0." + std::to_string(i);
  }
  AllowedAddresses addresses;
  EXPECT_EQ(addresses.Read(list.c_str()), nullptr);
  EXPECT_TRUE(addresses.Allow(0x0a000000 + AllowedAddresses::MAX_RANGES - 1));
  EXPECT_STREQ(addresses.Read((list + ",10.0.1.0").c_str()), "has more than 32 entries");
}

// ------------------------------------------------------------------------------------------------------ on the robot

class SettingsOnTheRobotTest : public RCServerFixture {
 protected:
  SettingsOnTheRobotTest() { host_.memory_stick = stick_.path().c_str(); }

  void bootWith(const std::string& settings) {
    stick_.write(SETTINGS_FILE, settings);
    boot(robot_);
  }

  test_support::MemoryStick stick_;
  FakeRobot robot_;
};

TEST_F(SettingsOnTheRobotTest, BrokenLineIsNamedOnTheConsole) {
  bootWith("\nALLOW_REBOOT=maybe\n");
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: OPEN-R/MW/CONF/RCSERVER.CFG, line 2: ALLOW_REBOOT=MAYBE"));
}

TEST_F(SettingsOnTheRobotTest, WithoutTheFileTheRobotServesAndSaysWhatIsNotAllowed) {
  std::filesystem::remove(stick_.path(SETTINGS_FILE));
  boot(robot_);
  EXPECT_THAT(console_.str(), HasSubstr("no OPEN-R/MW/CONF/RCSERVER.CFG on the memory stick"));
  connectServed();
}

TEST_F(SettingsOnTheRobotTest, FileThatCannotBeReadLetsNobodyInAndTheConsoleSaysSo) {
  const std::filesystem::path file = stick_.path(SETTINGS_FILE);
  std::filesystem::remove(file);
  std::filesystem::create_symlink(file, file);
  boot(robot_);
  EXPECT_THAT(console_.str(), HasSubstr("CFG cannot be read; nobody but 127.0.0.1 may connect"));
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  console_.str("");
  boot(robot_);
  EXPECT_THAT(console_.str(), AllOf(HasSubstr("line 1: it cannot be read"), HasSubstr("nobody but 127.0.0.1")));
}

TEST_F(SettingsOnTheRobotTest, ClientWhoseAddressIsNotAllowedIsTurnedAwayAtOnce) {
  bootWith("ALLOWED_ADDRESSES=192.168.1.0/24");
  auto client = connect();
  EXPECT_TRUE(awaitEnd(*client));
  EXPECT_FALSE(client->next());
  EXPECT_THAT(console_.str(), HasSubstr("is turned away: ALLOWED_ADDRESSES in RCSERVER.CFG does not name it"));
  EXPECT_THAT(console_.str(), Not(HasSubstr("is connected")));
}

TEST_F(SettingsOnTheRobotTest, ClientWhoseAddressIsAllowedIsServed) {
  bootWith("ALLOWED_ADDRESSES=192.168.1.0/24, 127.0.0.1");
  connectServed();
}

TEST_F(SettingsOnTheRobotTest, HoweverManyStrangersComeTheConsoleTellsOfThemOnceASecond) {
  bootWith("ALLOWED_ADDRESSES=192.168.1.0/24");
  for (int i = 0; i < 5; ++i) {
    auto stranger = connect();
    ASSERT_TRUE(awaitEnd(*stranger));
  }
  passFrames(130);
  console_.str("");
  auto stranger = connect();
  ASSERT_TRUE(awaitEnd(*stranger));
  EXPECT_THAT(console_.str(), AllOf(HasSubstr("is turned away"), HasSubstr("4 more have been turned away")));
}

TEST_F(SettingsOnTheRobotTest, SilentClientLosesItsPlaceAfterTheTimeInTheFile) {
  bootWith("SILENT_CLIENT_SECONDS=2");
  auto silent = connectServed();
  passFrames(240);
  auto early = connect();
  EXPECT_TRUE(awaitEnd(*early));
  passFrames(20);
  auto late = connectServed();
  EXPECT_TRUE(awaitEnd(*silent));
}

}  // namespace
