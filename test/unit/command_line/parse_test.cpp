#include "command_line/parse.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>

#include "aibo_client/exceptions.h"
#include "support/refusal.h"

namespace aibo_driver::command_line {
namespace {

class Parse : public ::testing::Test {
 protected:
  Parse() { ::setenv("AIBO_HOST", "from_environment", 1); }
  ~Parse() override { ::unsetenv("AIBO_HOST"); }
};

TEST_F(Parse, OptionsMayBeAnywhere) {
  using Words = std::vector<std::string>;
  for (const Words& words :
       {Words{"--timeout", "6", "--port", "4", "--host", "robot", "--json", "move", "mouth=-3deg", "--duration", "2"},
        Words{"move", "--duration", "2", "--port=4", "mouth=-3deg", "--host=robot", "--json", "--timeout", "6"}}) {
    const CommandLine line = parse(words);
    EXPECT_EQ(line.command->name, "move");
    EXPECT_TRUE(line.arguments.has("json"));
    EXPECT_EQ(line.arguments.robot.timeout, std::chrono::seconds(6));
    EXPECT_EQ(line.arguments.robot.port, 4);
    EXPECT_EQ(line.arguments.robot.host, "robot");
    EXPECT_THAT(line.arguments.words, testing::ElementsAre("mouth=-3deg"));
    EXPECT_EQ(line.arguments.get("duration"), "2");
  }
  EXPECT_EQ(parse({"joints", "--port", "4"}).arguments.robot.port, 4);
  EXPECT_EQ(parse({"joints"}).arguments.robot.port, 54321);
  EXPECT_EQ(parse({"joints"}).arguments.robot.timeout, std::chrono::seconds(5));
  for (const char* option : {"--host", "--port", "--timeout"}) {
    EXPECT_EQ(parse({option, "1", "sensors"}).command->name, "sensors") << option;
    EXPECT_EQ(parse({std::string(option) + "=1", "sensors"}).command->name, "sensors") << option;
    EXPECT_EQ(parse({"sensors", option, "1"}).command->name, "sensors") << option;
    EXPECT_THROW(parse({option}), aibo_client::InvalidArgumentException) << option;
  }
}

TEST_F(Parse, TheEnvironmentNamesTheRobotUnlessAnOptionDoes) {
  EXPECT_EQ(parse({"joints"}).arguments.robot.host, "from_environment");
  EXPECT_TRUE(parse({"joints"}).arguments.robot.host_is_given);
  EXPECT_EQ(parse({"joints", "--host", "from_option"}).arguments.robot.host, "from_option");
  ::setenv("AIBO_HOST", "", 1);
  EXPECT_FALSE(parse({"joints"}).arguments.robot.host_is_given);
  ::unsetenv("AIBO_HOST");
  EXPECT_FALSE(parse({"joints"}).arguments.robot.host_is_given);
}

TEST_F(Parse, RefusesWhatNoCommandHas) {
  using Words = std::vector<std::string>;
  for (const Words& words :
       {Words{}, Words{"fly"}, Words{"joints", "extra"}, Words{"move"}, Words{"joints", "--timeout", "soon"},
        Words{"joints", "--timeout", "0"}, Words{"joints", "--port", "0"}, Words{"joints", "--port", "65536"},
        Words{"joints", "--por", "1"}, Words{"joints", "--host"}, Words{"play", "--times"}, Words{"play", "a", "b"},
        Words{"upload", "a", "b", "c"}, Words{"walk", "a", "b", "c", "d"}}) {
    EXPECT_THROW(parse(words), aibo_client::InvalidArgumentException) << ::testing::PrintToString(words);
  }
  for (const auto& [words, reason] :
       {std::pair{Words{"upload"}, "usage: aibo upload FILE [NAME] (`aibo help upload` has examples)"},
        {Words{"joints", "--duration", "1"},
         "unrecognised option '--duration' (`aibo help` lists commands and options)"}}) {
    EXPECT_EQ(test_support::refusalOf<aibo_client::InvalidArgumentException>([&words = words] { parse(words); }),
              reason);
  }
  EXPECT_EQ(parse({"upload", "a", "b"}).arguments.words.size(), 2U);
  EXPECT_EQ(parse({"say", "a", "b", "c", "d"}).arguments.words.size(), 4U);
}

TEST_F(Parse, HelpAndVersionNeedNoArguments) {
  EXPECT_TRUE(parse({"--help"}).help);
  EXPECT_TRUE(parse({"--version"}).version);
  EXPECT_TRUE(parse({"move", "-h"}).help);
  EXPECT_EQ(parse({"move", "--help"}).command->name, "move");
}

}  // namespace
}  // namespace aibo_driver::command_line
