#include "protocol/utf8.h"

#include <gmock/gmock.h>

#include <string>

namespace protocol {
namespace {

bool isPlain(const std::string& text) {
  return isPlainText(text.data(), text.size());
}

TEST(PlainText, IsAnyCharacterOfOneToFourBytes) {
  for (const char* text :
       {"", " ~", "caf\xc3\xa9", "\xc2\xa0", "\xdf\xbf", "\xe0\xa0\x80", "\xe2\x82\xac", "\xed\x9f\xbf", "\xee\x80\x80",
        "\xf0\x90\x80\x80", "\xf0\x9f\x90\xb6", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(isPlain(text)) << text;
  }
}

TEST(PlainText, HasNoControlCharacters) {
  for (const char* text : {"\n", "\t", "\x1b", "a\r", "\x1f", "\x7f", "\xc2\x80", "\xc2\x9f"}) {
    EXPECT_FALSE(isPlain(text));
  }
  EXPECT_FALSE(isPlain(std::string(1, '\0')));
}

TEST(PlainText, HasNoBytesThatAreNotUtf8) {
  for (const char* text :
       {"\x80", "\xbf", "\xfe", "\xff", "\xf8\x88\x80\x80\x80", "\xc3(", "\xe2\x82(", "\xf0\x9f\x90("}) {
    EXPECT_FALSE(isPlain(text)) << text;
  }
}

TEST(PlainText, HasNoCharacterCutOff) {
  for (const std::string character : {"\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x90\xb6"}) {
    for (size_t size = 1; size < character.size(); ++size) {
      EXPECT_FALSE(isPlain("a" + character.substr(0, size)));
    }
  }
}

TEST(PlainText, HasNoOverlongFormsSurrogatesOrCodesBeyondUnicode) {
  for (const char* text : {"\xc0\xaf", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf", "\xed\xa0\x80", "\xed\xbf\xbf",
                           "\xf4\x90\x80\x80", "\xf7\xbf\xbf\xbf"}) {
    EXPECT_FALSE(isPlain(text)) << text;
  }
}

TEST(PlainText, IsCutBetweenCharacters) {
  const std::string text =
      "a\xe2\x82\xac"
      "b";
  const size_t expected[] = {0, 1, 1, 1, 4, 5, 5};
  for (size_t limit = 0; limit < 7; ++limit) {
    EXPECT_EQ(sizeOfWholeCharacters(text.data(), text.size(), limit), expected[limit]) << limit;
  }
}

}  // namespace
}  // namespace protocol
