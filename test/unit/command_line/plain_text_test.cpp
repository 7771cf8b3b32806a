#include "command_line/plain_text.h"

#include <gmock/gmock.h>

namespace aibo_driver::command_line {
namespace {

TEST(PlainText, KeepsWhatIsReadAndItsLines) {
  EXPECT_EQ(plainText("Ger\xC3\xA4t\n30 \xE2\x82\xAC"), "Ger\xC3\xA4t\n30 \xE2\x82\xAC");
}

TEST(PlainText, HasNothingThatATerminalObeys) {
  EXPECT_EQ(plainText("a\x1b[2Jb\rc\x07"), "a?[2Jb?c?");
  EXPECT_EQ(plainText("\xC2\x9B"), "??");  // CSI in one character
  EXPECT_EQ(plainText("\xE2\x80\xAE"
                      "a"),
            "???a");                       // U+202E turns the direction of writing
  EXPECT_EQ(plainText("\xE2\x80"), "??");  // the beginning of a character
}

}  // namespace
}  // namespace aibo_driver::command_line
