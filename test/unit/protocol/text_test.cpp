#include "protocol/text.h"

#include <gmock/gmock.h>

#include <string>

#include "layouts.h"

namespace protocol {
namespace {

using ::testing::HasSubstr;

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

TEST(PlainText, IsUtf8WithoutControlCharacters) {
  const char* const control[] = {"\n", "\t", "\x1b", "a\r", "\x1f", "\x7f", "\xc2\x80", "\xc2\x9f"};
  const char* const cut[] = {"\x80",  "\xbf",      "\xfe",         "\xff", "\xf8\x88\x80\x80\x80",
                             "\xc3(", "\xe2\x82(", "\xf0\x9f\x90("};
  const char* const none[] = {"\xc0\xaf",     "\xc1\xbf",     "\xe0\x9f\xbf",     "\xf0\x8f\xbf\xbf",
                              "\xed\xa0\x80", "\xed\xbf\xbf", "\xf4\x90\x80\x80", "\xf7\xbf\xbf\xbf"};
  for (int i = 0; i < 8; ++i) {
    EXPECT_FALSE(isPlain(control[i])) << control[i];
    EXPECT_FALSE(isPlain(cut[i])) << cut[i];
    EXPECT_FALSE(isPlain(none[i])) << none[i];
  }
  EXPECT_FALSE(isPlain(std::string(1, '\0')));
}

// Soft hyphen, Arabic letter mark, zero width space, right-to-left mark, line and paragraph separator, right-to-left
// override, word joiner, right-to-left isolate, variation selector, byte order mark, annotation, tag.
TEST(PlainText, HasNoCharactersThatChangeHowOthersAreShown) {
  for (const char* text :
       {"\xc2\xad", "\xd8\x9c", "\xe2\x80\x8b", "\xe2\x80\x8f", "\xe2\x80\xa8", "\xe2\x80\xa9", "\xe2\x80\xae",
        "\xe2\x81\xa0", "\xe2\x81\xa7", "\xef\xb8\x8f", "\xef\xbb\xbf", "\xef\xbf\xb9", "\xf3\xa0\x81\x81"}) {
    EXPECT_FALSE(isPlain(std::string("a") + text + "b")) << text;
  }
  for (const char* text : {"\xe2\x80\x8a", "\xe2\x80\x90", "\xe2\x80\xa7", "\xe2\x80\xaf", "\xe2\x81\xb0"}) {
    EXPECT_TRUE(isPlain(text)) << "their neighbours";
  }
}

TEST(PlainText, HasNoIncompleteCharacter) {
  for (const std::string character : {"\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x90\xb6"}) {
    for (size_t size = 1; size < character.size(); ++size) {
      EXPECT_FALSE(isPlain("a" + character.substr(0, size)));
      EXPECT_FALSE(isPlainText(character.data(), size)) << "what follows is not of the text";
    }
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

TEST(TextInAFile, IsWhatAnEditorShowsOfIt) {
  const std::string mark = "\xef\xbb\xbf";
  const std::string rows[][2] = {
      {"", ""},
      {mark, ""},
      {"\x1a", ""},
      {mark + "a b\r\n", "a b"},
      {"a\r\n\x1a", "a"},
      {"\n a\x1a\r\n\x1a\x1a", "\n a"},
      {"a\x1a"
       "b",
       "a\x1a"
       "b"},
      {mark + mark + "a", mark + "a"},
      {"\xef\xbb", "\xef\xbb"},
  };
  for (const auto& [file, text] : rows) {
    const Bytes bytes = bytesOf(file);  // memory of exactly its size
    const Text found = textInFile(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    EXPECT_EQ(std::string(found.begin, found.size), text) << file;
  }
}

// The name that was read, or what is wrong with it. The text lies in memory of exactly its size.
std::string read(const std::string& text) {
  const Bytes bytes = bytesOf(text);
  MotionName name = "untouched";
  const char* const problem = readMotionName(reinterpret_cast<const char*>(bytes.data()), bytes.size(), name);
  if (problem == nullptr) {
    return name;
  }
  EXPECT_STREQ(name, "untouched");
  return problem;
}

TEST(MotionName, IsUpToEightCharactersAndMtn) {
  for (const char* text : {"NOD.MTN", "A.MTN", "12345678.MTN", "SIT_AN~1.MTN", "!#$%&'().MTN", "-@^_`{}~.MTN"}) {
    EXPECT_EQ(read(text), text);
  }
  EXPECT_EQ(read("wAlk_fwd.mTn"), "WALK_FWD.MTN");
  for (const char* text : {"", "M", "MTN", "NOD", "NODMTN", "NOD.MT", "NOD.MTNX", "NOD.BIN", "NOD.MTN ", "NOD.MTN."}) {
    EXPECT_THAT(read(text), HasSubstr("does not end in .MTN")) << text;
  }
  EXPECT_THAT(read(std::string("NOD.MTN\0", 8)), HasSubstr("does not end in .MTN"));
  EXPECT_THAT(read(".MTN"), HasSubstr("nothing before its ending"));
  EXPECT_THAT(read("123456789.MTN"), HasSubstr("more than 8 characters"));
  EXPECT_THAT(read(std::string(100000, 'A') + ".MTN"), HasSubstr("more than 8 characters"));
}

// The rules are those of motions.
TEST(PictureName, IsUpToEightCharactersAndJpg) {
  PictureName name = "untouched";
  EXPECT_EQ(readPictureName("aibo0001.jpg", 12, name), nullptr);
  EXPECT_STREQ(name, "AIBO0001.JPG");
  for (const std::string text : {"", ".JPG", "NINECHARS.JPG", "NOD.MTN", "A.JPEG", "A/B.JPG", "..\\B.JPG", "A.B.JPG"}) {
    const char* const problem = readPictureName(text.data(), text.size(), name);
    ASSERT_NE(problem, nullptr) << text;
    EXPECT_THAT(problem, testing::HasSubstr("the name")) << text;
  }
  EXPECT_STREQ(name, "AIBO0001.JPG") << "unchanged";
}

bool isAllowedForNew(const std::string& text) {
  MotionName name;
  EXPECT_EQ(readMotionName(text.data(), text.size(), name), nullptr) << text;
  return problemOfNewMotionName(name) == nullptr;
}

TEST(MotionName, OfANewFileIsNeitherADeviceNorStandsForALongerName) {
  for (const char* text : {"CON.MTN", "con.mtn", "PRN.MTN", "AUX.MTN", "NUL.MTN", "CLOCK$.MTN", "COM0.MTN", "COM1.MTN",
                           "COM9.MTN", "LPT1.MTN", "WAG~1.MTN", "A~12.MTN", "SIT_AN~1.MTN", "~1.MTN"}) {
    EXPECT_FALSE(isAllowedForNew(text)) << text;
  }
  for (const char* text : {"CONE.MTN", "CO.MTN", "COM.MTN", "COMA.MTN", "COM-.MTN", "COM10.MTN", "WAG1.MTN", "LPT.MTN",
                           "NULL.MTN", "ICON.MTN", "1.MTN", "12345678.MTN", "~.MTN", "~A1.MTN", "WAG~.MTN", "A1.MTN"}) {
    EXPECT_TRUE(isAllowedForNew(text)) << text;
  }
}

TEST(MotionName, HasNoOtherCharacters) {
  const std::string allowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789!#$%&'()-@^_`{}~";
  for (int byte = 0; byte < 256; ++byte) {
    const char character = static_cast<char>(byte);
    const bool is_name = read(std::string("A") + character + ".MTN").size() == 6;
    EXPECT_EQ(is_name, allowed.find(character) != std::string::npos) << byte;
  }
}

}  // namespace
}  // namespace protocol
