// RCSERVER.CFG: its settings, its problems, and the addresses that may connect.
#include <gmock/gmock.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rcserver/ReportLimit.h"
#include "rcserver/settings/AllowedAddresses.h"
#include "rcserver/settings/Settings.h"
#include "rcserver_fixture.h"

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
  void Report(int line, const char* text) override { all.emplace_back(line, text); }
  std::vector<std::pair<int, std::string>> all;
};

struct Read {
  Settings settings;
  std::vector<std::pair<int, std::string>> problems;
};

Read read(std::string text) {
  Read result;
  Problems problems;
  text.push_back('\n');  // fmemopen() does not accept an empty file
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

TEST(Settings, EachSettingIsSetByItsName) {
  EXPECT_TRUE(read("ALLOW_UPLOAD=yes").settings.allow_upload);
  EXPECT_TRUE(read("ALLOW_DELETE=yes").settings.allow_delete);
  EXPECT_TRUE(read("ALLOW_SHUT_DOWN=yes").settings.allow_shut_down);
  EXPECT_TRUE(read("ALLOW_REBOOT=yes").settings.allow_reboot);
  EXPECT_EQ(read("SILENT_CLIENT_SECONDS=3600").settings.silent_client_seconds, 3600U);
  EXPECT_FALSE(read("ALLOWED_ADDRESSES=192.168.1.2").settings.allowed_addresses.Allow(0x01020304));
}

TEST(Settings, SpacesCommentsCaseLineEndsAndByteOrderMarkDoNotMatter) {
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

TEST(Settings, DistributedFileAllowsNothingDangerousAndHasNoProblems) {
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
  std::string problem;
};

class BrokenLines : public ::testing::TestWithParam<BrokenLine> {};

TEST_P(BrokenLines, AreReportedAndNothingIsAllowed) {
  const Read result = read(
      "ALLOW_REBOOT=yes\nALLOWED_ADDRESSES=192.168.1.20\nMOTORS_AT_BOOT=yes\nPOWER_MONITOR=no\n"
      "SILENT_CLIENT_SECONDS=20\n" +
      GetParam().line + "\nnonsense\nALLOW_DELETE=yes");
  EXPECT_THAT(result.problems, ElementsAre(Pair(6, HasSubstr(GetParam().problem)), Pair(7, HasSubstr("NAME=VALUE"))));
  EXPECT_FALSE(result.settings.allow_upload || result.settings.allow_reboot || result.settings.motors_at_boot);
  EXPECT_FALSE(result.settings.allow_delete) << "what follows changes nothing";
  EXPECT_FALSE(result.settings.allow_sound);
  EXPECT_TRUE(result.settings.power_monitor);
  EXPECT_EQ(result.settings.silent_client_seconds, 10U);
  EXPECT_FALSE(result.settings.allowed_addresses.Allow(0xc0a80114));
  EXPECT_TRUE(result.settings.allowed_addresses.Allow(kLoopback));
}

INSTANTIATE_TEST_SUITE_P(
    Lines, BrokenLines,
    ::testing::Values(BrokenLine{"ALLOW_UPLOAD", "it is not NAME=VALUE"}, BrokenLine{"ALLOW UPLOAD=yes", "NAME=VALUE"},
                      BrokenLine{"=yes", "no such setting"}, BrokenLine{"ALLOW_UPLOADS=yes", "no such setting"},
                      BrokenLine{"ALLOW_UPLOA=yes", "no such setting"},
                      BrokenLine{"ALLOW_UPLOAD=", "it is neither yes nor no, so nothing is allowed: \"ALLOW_UPLOAD=\""},
                      BrokenLine{"ALLOW_UPLOAD=1", "neither yes nor no"},
                      BrokenLine{"ALLOW_UPLOAD=yes, sir", "neither yes nor no"},
                      BrokenLine{"ALLOW_REBOOT=yes", "it appears a second time"},
                      BrokenLine{"ALLOWED_ADRESSES=192.168.1.20", "no such setting"},
                      BrokenLine{"ALLOWED_ADDRESSES 192.168.1.20", "NAME=VALUE"},
                      BrokenLine{"ALLOW_UPLOAD=" + std::string(300, 'x'), "neither yes nor no"},
                      BrokenLine{std::string(300, 'x'), "NAME=VALUE"},
                      BrokenLine{"ALLOW_UPLOAD=yes" + std::string(100 * MAX_SETTINGS_LINE_SIZE, ' ') + "x",
                                 "control character"},
                      BrokenLine{std::string("ALLOW_UPLOAD=yes\0", 17), "control character"}));

TEST(Settings, SecondsOfSilenceAreAWholeNumber) {
  for (const char* seconds : {"0", "3601", "-5", "5s", "99999999999999999999"}) {
    EXPECT_THAT(read(std::string("SILENT_CLIENT_SECONDS=") + seconds).problems,
                ElementsAre(Pair(1, HasSubstr("1 to 3600"))));
  }
}

TEST(Settings, WrongListOfAddressesAllowsOnlyThisComputer) {
  const Read result = read("ALLOWED_ADDRESSES=192.168.1.20, 192.168.1");
  EXPECT_THAT(result.problems, ElementsAre(Pair(1, HasSubstr("not a list of addresses"))));
  EXPECT_FALSE(result.settings.allowed_addresses.Allow(0xc0a80114));
  EXPECT_TRUE(result.settings.allowed_addresses.Allow(kLoopback));
}

class LineEnds : public ::testing::TestWithParam<std::string> {};

TEST_P(LineEnds, EndLinesAndComments) {
  const std::string& end = GetParam();
  const Read result = read("# mine" + end + "ALLOWED_ADDRESSES=192.168.1.20" + end + end + "ALLOW_UPLOAD=yes");
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_THAT(read("# mine" + end + end + "nonsense").problems, ElementsAre(Pair(3, HasSubstr("NAME=VALUE"))));
  EXPECT_TRUE(result.settings.allowed_addresses.Allow(0xc0a80114));
  EXPECT_FALSE(result.settings.allowed_addresses.Allow(kLoopback));
  EXPECT_TRUE(result.settings.allow_upload);
}

INSTANTIATE_TEST_SUITE_P(Systems, LineEnds, ::testing::Values("\n", "\r\n", "\r"));

// They may have been meant to end lines: then what follows a # is no comment.
TEST(Settings, CharactersThatMayEndALineDoNotHideAddresses) {
  const std::string nel_in_latin1 = "\x85";
  const std::string nel = "\xc2\x85";
  const std::string line_separator = "\xe2\x80\xa8";
  for (const std::string& end :
       {std::string(1, '\0'), std::string("\x01"), std::string("\v"), std::string("\f"), std::string("\x1a"),
        std::string("\x1b"), std::string("\x7f"), nel_in_latin1, nel, line_separator, std::string("\xff")}) {
    const Read result = read("# mine" + end + "ALLOWED_ADDRESSES=192.168.1.20" + end);
    EXPECT_THAT(result.problems, ElementsAre(Pair(1, HasSubstr("not ASCII or is a control character"))));
    EXPECT_FALSE(result.settings.allowed_addresses.Allow(0x7f000002));
  }
  EXPECT_THAT(read("# by Mueller\tALLOWED_ADDRESSES").problems, IsEmpty());
}

// ---------------------------------------------------------------------------------------------------------- addresses

TEST(AllowedAddresses, ContainAddressesAndRanges) {
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

TEST(AllowedAddresses, AcceptRangesOfAllBitsAndOfNone) {
  AllowedAddresses addresses;
  ASSERT_EQ(addresses.Read("1.2.3.4/32"), nullptr);
  EXPECT_TRUE(addresses.Allow(0x01020304));
  EXPECT_FALSE(addresses.Allow(0x01020305));
  ASSERT_EQ(addresses.Read("1.2.3.4/0"), nullptr);
  EXPECT_TRUE(addresses.Allow(0xffffffff));
}

TEST(AllowedAddresses, WrongListIsRefusedAndChangesNothing) {
  AllowedAddresses addresses;
  ASSERT_EQ(addresses.Read("1.2.3.4"), nullptr);
  for (const char* list : {"",
                           ",",
                           "1.2.3",
                           "1.2.3.4.5",
                           "1.2.3.256",
                           "1.2.3.4/",
                           "1.2.3.4/33",
                           "1.2.3.4/-1",
                           "1.2.3.4 5.6.7.8",
                           "1.2.3.4,",
                           ",1.2.3.4",
                           "1.2.3.4,ANY",
                           "localhost",
                           "1..3.4",
                           "01.2.3.4567",
                           "1.2.3.0004",
                           "1.2.3.4294967300",
                           "0x1.2.3.4",
                           "1.2.3.4/24/24",
                           "1. 2.3.4",
                           "::1"}) {
    EXPECT_NE(addresses.Read(list), nullptr) << list;
  }
  EXPECT_TRUE(addresses.Allow(0x01020304));
  EXPECT_FALSE(addresses.Allow(0x01020305));
}

TEST(AllowedAddresses, ArePrintedAsTheyAreRead) {
  AllowedAddresses addresses;
  EXPECT_TRUE(addresses.IsAny());
  EXPECT_EQ(addresses.NumberOfEntries(), 0);
  ASSERT_EQ(addresses.Read("192.168.1.20, 255.255.255.255/31, 10.1.2.3/8, 1.2.3.4/0"), nullptr);
  EXPECT_FALSE(addresses.IsAny());
  std::vector<std::string> printed;
  for (int i = 0; i < addresses.NumberOfEntries(); ++i) {
    char text[AllowedAddresses::ENTRY_TEXT_SIZE];
    addresses.PrintEntry(i, text);
    printed.emplace_back(text);
  }
  EXPECT_THAT(printed, ElementsAre("192.168.1.20", "255.255.255.254/31", "10.0.0.0/8", "0.0.0.0/0"));
}

TEST(AllowedAddresses, HaveRoomForUpTo32Entries) {
  std::string list = "10.0.0.0";
  for (int i = 1; i < AllowedAddresses::MAX_RANGES; ++i) {
    list += ",10.0.0." + std::to_string(i);
  }
  AllowedAddresses addresses;
  EXPECT_EQ(addresses.Read(list.c_str()), nullptr);
  EXPECT_TRUE(addresses.Allow(0x0a000000 + AllowedAddresses::MAX_RANGES - 1));
  EXPECT_STREQ(addresses.Read((list + ",10.0.1.0").c_str()), "it has more than 32 entries");
}

// ------------------------------------------------------------------------------------------------------ on the robot

class SettingsOnTheRobotTest : public FakeRobotFixture {};

TEST_F(SettingsOnTheRobotTest, WrongLineIsNamedOnTheConsole) {
  startWith("\nALLOW_REBOOT=maybe\n");
  EXPECT_THAT(
      console_.str(),
      HasSubstr("RCServer: OPEN-R/MW/CONF/RCSERVER.CFG, line 2: it is neither yes nor no, so nothing is allowed"));
}

TEST_F(SettingsOnTheRobotTest, WithoutTheFileTheRobotServesAndReportsWhatIsNotAllowed) {
  std::filesystem::remove(stick_.path(SETTINGS_FILE));
  start();
  EXPECT_THAT(console_.str(), HasSubstr("no OPEN-R/MW/CONF/RCSERVER.CFG on the memory stick"));
  connectServed();
}

TEST_F(SettingsOnTheRobotTest, UnreadableFileAllowsOnlyThisComputerAndIsReported) {
  const std::filesystem::path file = stick_.path(SETTINGS_FILE);
  std::filesystem::remove(file);
  std::filesystem::create_symlink(file, file);
  start();
  EXPECT_THAT(console_.str(), HasSubstr("CFG cannot be read; only 127.0.0.1 may connect"));
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  console_.str("");
  start();
  EXPECT_THAT(console_.str(), AllOf(HasSubstr("line 1: it cannot be read"), HasSubstr("only 127.0.0.1 may connect")));
}

TEST_F(SettingsOnTheRobotTest, ConsoleNamesAtEachStartWhoMayConnect) {
  startWith("ALLOWED_ADDRESSES=any");
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: any address may connect\n"));
  console_.str("");
  startWith("ALLOWED_ADDRESSES=192.168.1.20, 10.0.0.0/8");
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: only 192.168.1.20 may connect\nRCServer: and 10.0.0.0/8 may"));
  EXPECT_THAT(console_.str(), Not(HasSubstr("any address")));
  startWith("ALLOWED_ADDRESSES=192.168.1");
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: only 127.0.0.1 may connect\n"));
  std::filesystem::remove(stick_.path(SETTINGS_FILE));
  start();
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: any address may connect\n"));
}

class LookAlikes : public SettingsOnTheRobotTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(LookAlikes, AllowOnlyThisComputerAndAreNamedOnTheConsole) {
  const std::string name = std::string(SETTINGS_FOLDER) + "/" + GetParam();
  stick_.write(name, "ALLOWED_ADDRESSES=192.168.1.20");
  startWith("ALLOWED_ADDRESSES=any\nALLOW_UPLOAD=yes");
  EXPECT_THAT(console_.str(), AllOf(HasSubstr("another file, " + GetParam() + ", which is not read"),
                                    HasSubstr("only 127.0.0.1 may connect")));
  std::filesystem::remove(stick_.path(SETTINGS_FILE));
  start();
  EXPECT_THAT(console_.str(), HasSubstr("only 127.0.0.1 may connect"));
  std::filesystem::remove(stick_.path(name));
  start();
  EXPECT_THAT(console_.str(), HasSubstr("any address may connect"));
}

INSTANTIATE_TEST_SUITE_P(Names, LookAlikes,
                         ::testing::Values("RCSERVER.CFG.txt", "rcserver.cfg~", "RCSERVER.TXT", "RCSERV~1.TXT"));

TEST_F(SettingsOnTheRobotTest, LookAlikeWithAnUnprintableNameIsReportedWithoutIt) {
  stick_.write(std::string(SETTINGS_FOLDER) + "/RCSERVER\x1b[2J", "");
  start();
  EXPECT_THAT(console_.str(), AllOf(HasSubstr("another file, RCSERVER..."), Not(HasSubstr("\x1b"))));
}

TEST_F(SettingsOnTheRobotTest, ClientWithoutAnAllowedAddressIsTurnedAwayAtOnce) {
  startWith("ALLOWED_ADDRESSES=192.168.1.0/24");
  auto client = connect();
  EXPECT_TRUE(awaitEnd(*client));
  EXPECT_FALSE(client->next());
  EXPECT_THAT(console_.str(), HasSubstr("is turned away: ALLOWED_ADDRESSES in RCSERVER.CFG does not name it"));
  EXPECT_THAT(console_.str(), Not(HasSubstr("is connected")));
}

TEST_F(SettingsOnTheRobotTest, ClientWithAnAllowedAddressIsServed) {
  startWith("ALLOWED_ADDRESSES=192.168.1.0/24, 127.0.0.1");
  connectServed();
}

TEST_F(SettingsOnTheRobotTest, ClientsTurnedAwayDoNotFloodTheConsole) {
  startWith("ALLOWED_ADDRESSES=192.168.1.0/24");
  passFrames(132);  // the line of the client before is allowed again
  for (unsigned i = 0; i < ReportLimit::BURST; ++i) {
    auto stranger = connect();
    ASSERT_TRUE(awaitEnd(*stranger));
  }
  const auto said_to_a_stranger = [this] {
    console_.str("");
    auto stranger = connect();
    EXPECT_TRUE(awaitEnd(*stranger));
    return console_.str();
  };
  for (int i = 0; i < 2; ++i) {
    EXPECT_THAT(said_to_a_stranger(), Not(HasSubstr("is turned away")));
    passFrames(250);  // two lines more are allowed
    EXPECT_THAT(said_to_a_stranger(),
                AllOf(HasSubstr("RCServer: 1 lines about clients were left out"), HasSubstr("is turned away")));
  }
}

TEST_F(SettingsOnTheRobotTest, SilentClientLosesItsPlaceAfterTheTimeInTheSettings) {
  startWith("SILENT_CLIENT_SECONDS=2");
  auto silent = connectServed();
  passFrames(240);
  auto early = connect();
  passFrames(4);
  EXPECT_TRUE(early->ended());
  passFrames(20);
  auto late = connectServed();
  EXPECT_TRUE(awaitEnd(*silent));
}

}  // namespace
