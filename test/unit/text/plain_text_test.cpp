#include "text/plain_text.h"

#include <gmock/gmock.h>

#include "text/sentence.h"

namespace aibo_driver::text {
namespace {

TEST(PlainText, KeepsWhatIsReadAndItsLines) {
  EXPECT_EQ(plainText("Ger\xC3\xA4t\n30 \xE2\x82\xAC"), "Ger\xC3\xA4t\n30 \xE2\x82\xAC");
  for (const char* character : {"~", "\xC2\xA1", "\xDF\xBF", "\xE0\xA0\x80", "\xEF\xBF\xBD", "\xF0\x9F\x90\xB6",
                                "\xF3\x80\x80\x80"}) {  // the first and the last ones of 1 to 4 bytes
    EXPECT_EQ(plainText(character), character);
    EXPECT_EQ(charactersOf(std::string(character) + "a"), (std::vector<std::string>{character, "a"}));
  }
}

TEST(PlainText, HasNothingThatATerminalObeys) {
  EXPECT_EQ(plainText("a\x1b[2Jb\rc\x07"), "a?[2Jb?c?");
  EXPECT_EQ(plainText("\xC2\x9B"), "??");  // CSI in one character
  EXPECT_EQ(plainText("\xE2\x80\xAE"
                      "a"),
            "???a");                       // U+202E turns the direction of writing
  EXPECT_EQ(plainText("\xE2\x80"), "??");  // the beginning of a character
}

TEST(PlainText, ALineIsShortAndOne) {
  EXPECT_EQ(plainLine("a\nb\x1b[2J"), "a?b?[2J");
  EXPECT_EQ(plainLine("abcdef", 3), "abc...");
  EXPECT_EQ(plainLine("\xC3\xA4\xC3\xA4", 3), "\xC3\xA4?...") << "half a character is none";
  EXPECT_LT(plainLine(std::string(100'000'000, 'x')).size(), 100U);
}

TEST(PlainText, ASentenceHasOneEnd) {
  EXPECT_EQ(sentence("it is limp"), "it is limp.");
  EXPECT_EQ(sentence("it is limp."), "it is limp.");
  EXPECT_EQ(sentence("Is it limp?"), "Is it limp?");
  EXPECT_EQ(sentence(""), ".");
}

TEST(PlainText, ThreeOfAMillionAreShown) {
  FirstThree names;
  EXPECT_TRUE(names.empty());
  EXPECT_EQ(names.text(), "");
  names.add("tail\x07");
  EXPECT_EQ(names.text(), "tail?");
  for (int i = 1; i < 1'000'000; ++i) {
    names.add("joint" + std::to_string(i));
    if (i == 3) {
      EXPECT_EQ(names.text("; "), "tail?; joint1; joint2 and 1 more");
    }
  }
  EXPECT_EQ(names.text(), "tail?, joint1, joint2 and 999997 more");
  EXPECT_EQ(names.count(), 1'000'000U);
}

}  // namespace
}  // namespace aibo_driver::text
