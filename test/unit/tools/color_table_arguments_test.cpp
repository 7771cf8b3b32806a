// What aibo_color_table says of arguments that it cannot use.

#include <gmock/gmock.h>

#include "support/process.h"
#include "support/safety_net.h"
#include "support/temporary_folder.h"
#include "support/test_pictures.h"

namespace {

TEST(ColorTableProgram, SaysWhichArgumentIsWrong) {
  const test_support::TemporaryFolder folder;
  const test_pictures::Bytes jpeg = test_pictures::make();
  folder.write("a.jpg", std::string(jpeg.begin(), jpeg.end()));
  const std::string picture = folder.path("a.jpg").string();
  folder.write("a.txt", "no picture");
  const std::string text = folder.path("a.txt").string();
  const std::string absent = folder.path("absent/b").string();
  const std::string region = "--region=0,0,8,8";
  const struct {
    std::vector<std::string> arguments;
    const char* problem;
  } rows[] = {
      {{picture}, "the option '--region' is required but missing"},
      {{region}, "the option '--picture' is required but missing"},
      {{picture, "--region=0,0,8"}, "--region is '0,0,8'; it has to be LEFT,TOP,WIDTH,HEIGHT in pixels"},
      {{picture, "--region=-1,0,8,8"}, "the region -1,0,8,8 is not within the picture, which has 208x160 pixels"},
      {{picture, region, "--margin=128"}, "--margin is 128; it must be 0..127"},
      {{picture, region, "--name=" + std::string(65, 'a')}, "a name of 1 to 64 bytes, without control characters"},
      {{picture, region, "--output=" + absent}, "absent: No such file or directory"},
      {{absent, region}, "there is no such file"},
      {{text, region}, "a.txt' is not a picture of the robot's camera: not a JPEG"},
  };
  for (const auto& row : rows) {
    std::vector<std::string> command{AIBO_COLOR_TABLE};
    command.insert(command.end(), row.arguments.begin(), row.arguments.end());
    test_support::Process program(command);
    EXPECT_EQ(program.waitForExit(test_support::kSafetyNet), 1) << row.problem;
    EXPECT_THAT(program.output(), testing::HasSubstr(row.problem));
  }
}

}  // namespace
