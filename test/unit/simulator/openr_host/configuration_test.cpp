// The configuration files of a memory stick.
#include <gmock/gmock.h>

#include "simulator/openr_host/memory_stick.h"
#include "support/refusal.h"
#include "support/temporary_folder.h"

namespace openr_host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

template <typename Function>
std::string problemOf(const Function& function) {
  return test_support::refusalOf<std::exception>([&] { function(); });
}

std::vector<std::string> objects(const std::string& text, const std::string& design = "ERS-7") {
  std::istringstream stream(text);
  std::vector<std::string> names;
  for (const auto& object : readObjectConfiguration(stream, "OBJECT.CFG", design)) {
    names.push_back(object.name);
  }
  return names;
}

std::string objectError(const std::string& text) {
  return problemOf([&] { objects(text); });
}

TEST(ObjectConfigurationTest, HasOneObjectALineHoweverItIsWritten) {
  for (const char* text :
       {"/MS/OPEN-R/MW/OBJS/A.BIN\n/MS/OPEN-R/MW/OBJS/RCSERVER.BIN\n",
        "# all\r\n\r\n  /MS/OPEN-R/MW/OBJS/A.BIN  # this\r\n#/MS/X\r\n/MS/OPEN-R/MW/OBJS/RCSERVER.BIN",
        "/ms/open-r/mw/objs/a.bin\n/MS/Open-R/mw/OBJS/RcServer.bin"}) {
    EXPECT_THAT(objects(text), ElementsAre("A.BIN", "RCSERVER.BIN")) << text;
  }
}

TEST(ObjectConfigurationTest, LinesAfterAModelAreForThatModelOnly) {
  const std::string text =
      "/MS/OPEN-R/MW/OBJS/ALL.BIN\n[ERS-7]\n/MS/OPEN-R/MW/OBJS/SEVEN.BIN\n/MS/OPEN-R/MW/OBJS/BOTH.BIN\n"
      "[ ERS-210 ]\n/MS/OPEN-R/MW/OBJS/BOTH.BIN\n";
  EXPECT_THAT(objects(text, "ERS-7"), ElementsAre("ALL.BIN", "SEVEN.BIN", "BOTH.BIN"));
  EXPECT_THAT(objects(text, "ERS-210"), ElementsAre("ALL.BIN", "BOTH.BIN"));
}

TEST(ObjectConfigurationTest, NamesFileAndLineOfAWrongLine) {
  EXPECT_THAT(objectError("/MS/OPEN-R/MW/OBJS/A.BIN\n\n/MS/OPEN-R/MW/OBJS/a.bin\n"),
              AllOf(StartsWith("OBJECT.CFG:3: "), HasSubstr("A.BIN")));
  EXPECT_THAT(objectError("# one\n\n[ERS-7]\n/MS/OPEN-R/MW/OBJS/A.BIN\nRCSERVER.BIN\n"),
              AllOf(StartsWith("OBJECT.CFG:5: "), HasSubstr("'RCSERVER.BIN'")));
  for (const char* broken : {"[ERS-7", "[ERS-7] x", "]", "/MS/OPEN-R/MW/OBJS/.BIN", "/MS/OPEN-R/MW/OBJS/A.TXT",
                             "/MS/OPEN-R/MW/OBJS/LONGERNAME.BIN", "/MS/OPEN-R/MW/OBJS/../A.BIN",
                             "/MS/OPEN-R/MW/CONF/A.BIN", "/MS/OPEN-R/MW/OBJS/A B.BIN"}) {
    EXPECT_THAT(objectError(broken), StartsWith("OBJECT.CFG:1: ")) << broken;
  }
}

const std::vector<std::string> kServices = {"Robot.Image.Picture.S", "Robot.Sensor.Value.S", "Other.Image.Picture.S",
                                            "Server.Image.Picture.O", "Viewer.Image.Picture.O"};

std::vector<std::string> connections(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> pairs;
  for (const auto& connection : readConnectionConfiguration(stream, "CONNECT.CFG", "ERS-7", kServices)) {
    pairs.push_back(connection.subject.text() + " " + connection.observer.text());
  }
  return pairs;
}

std::string connectionError(const std::string& text) {
  return problemOf([&] { connections(text); });
}

TEST(ConnectionConfigurationTest, ReadsSubjectAndObserverWithAnyWhiteSpaceBetween) {
  EXPECT_THAT(
      connections("# the camera\r\nRobot.Image.Picture.S\tServer.Image.Picture.O # here\r\n\r\n"
                  "Robot.Image.Picture.S\n   Viewer.Image.Picture.O\nOther.Image.Picture.S Viewer.Image.Picture.O"),
      ElementsAre("Robot.Image.Picture.S Server.Image.Picture.O", "Robot.Image.Picture.S Viewer.Image.Picture.O",
                  "Other.Image.Picture.S Viewer.Image.Picture.O"));
  EXPECT_TRUE(connections("").empty());
}

TEST(ConnectionConfigurationTest, NamesFileAndLineOfAWrongLineAndWhatIsWrong) {
  const std::string good = "Robot.Image.Picture.S Server.Image.Picture.O\n";
  const std::pair<std::string, std::string> rows[] = {
      {good + "Robot.Image.Picture.S Server.Imago.Picture.O", "CONNECT.CFG:2: .*Server.Imago.Picture.O"},
      {"\nRobot.Sensor.Value.S\nServer.Image.Picture.O", "CONNECT.CFG:3: .*data types differ"},
      {"Robot.Image.Picture.S\n" + good, "CONNECT.CFG:1: .*no observer"},
      {"\n\nRobot.Image.Picture.S", "CONNECT.CFG:3: .*no observer"},
      {"Server.Image.Picture.O Robot.Image.Picture.S", "CONNECT.CFG:1: .*no subject"},
      {good + "\nRobot.Image.Picture.S\nServer.Image.Picture.O\n", "CONNECT.CFG:3: .*second time"},
      {"Robot.Image", "CONNECT.CFG:1: expected a service"},
      {"Robot.Image.Picture.X", "CONNECT.CFG:1: expected a service"},
      {"Robot..Picture.S", "CONNECT.CFG:1: expected a service"},
      {"Robot.I-mage.Picture.S", "CONNECT.CFG:1: expected a service"},
  };
  for (const auto& [text, problem] : rows) {
    EXPECT_THAT(connectionError(text), testing::ContainsRegex(problem)) << text;
  }
}

std::map<std::string, std::string> designFiles(const std::string& text) {
  std::istringstream stream(text);
  return readDesignDatabase(stream, "DESIGNDB.CFG", "ERS-7");
}

// Programmer's Guide, 4.2.3.
TEST(DesignDatabaseTest, FindsTheFileOfAKeywordForTheModel) {
  EXPECT_THAT(designFiles("#\n# files\n#\nALL /MS/OPEN-R/MW/CONF/ALL.TXT\r\n[ERS-210]\nSOUND /MS/OLD.WAV\n"
                          "[ERS-7]\nSOUND \t /ms/OPEN-R/MW/DATA/P/SEVEN.WAV # loud\n"),
              ElementsAre(std::make_pair("ALL", "OPEN-R/MW/CONF/ALL.TXT"),
                          std::make_pair("SOUND", "OPEN-R/MW/DATA/P/SEVEN.WAV")));
}

TEST(DesignDatabaseTest, NamesFileAndLineOfAMalformedLine) {
  for (const char* broken : {"SOUND", "SOUND OPEN-R/X.WAV", "SOUND /MS/", "SOUND /MS/X.WAV /MS/Y.WAV"}) {
    EXPECT_THAT(problemOf([&] { designFiles("\n" + std::string(broken)); }), StartsWith("DESIGNDB.CFG:2: ")) << broken;
  }
  EXPECT_THAT(problemOf([&] { designFiles("A /MS/X\nA /MS/Y\n"); }), StartsWith("DESIGNDB.CFG:2: a second A"));
}

// TextInAFile has what editors write.
TEST(MemoryStickTest, HasConfigurationFilesOfAnyEditor) {
  const test_support::TemporaryFolder stick;
  stick.write("OBJECT.CFG", "\xef\xbb\xbf# \xfc\x1a\x85\r\n/MS/OPEN-R/MW/OBJS/A.BIN # f\xc3\xbcr\r\n\x1a");
  EXPECT_EQ(objectError(openConfiguration(stick.path("OBJECT.CFG")).str()), "");
}

}  // namespace
}  // namespace openr_host
