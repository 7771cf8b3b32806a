#include "protocol/motion_name.h"

#include <gmock/gmock.h>

#include <string>

#include "bytes.h"

namespace protocol {
namespace {

using ::testing::HasSubstr;

// The name as read, or what is wrong with it. The text lies in memory of just its size.
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

TEST(MotionName, IsEightCharactersAndMtn) {
  EXPECT_EQ(read("NOD.MTN"), "NOD.MTN");
  EXPECT_EQ(read("A.MTN"), "A.MTN");
  EXPECT_EQ(read("12345678.MTN"), "12345678.MTN");
  EXPECT_EQ(read("SIT_AN~1.MTN"), "SIT_AN~1.MTN");
  EXPECT_EQ(read("!#$%&'()-@.MTN").find("!#$"), std::string::npos);
  EXPECT_EQ(read("!#$%&'().MTN"), "!#$%&'().MTN");
  EXPECT_EQ(read("-@^_`{}~.MTN"), "-@^_`{}~.MTN");
}

TEST(MotionName, IsTheSameInSmallLetters) {
  EXPECT_EQ(read("walk_fwd.mtn"), "WALK_FWD.MTN");
  EXPECT_EQ(read("wAg.mTn"), "WAG.MTN");
}

TEST(MotionName, HasItsEnding) {
  for (const char* text : {"", "M", "MTN", "NOD", "NODMTN", "NOD.MT", "NOD.MTNX", "NOD.BIN", "NOD.MTN ", "NOD.MTN."}) {
    EXPECT_THAT(read(text), HasSubstr("does not end in .MTN")) << text;
  }
  EXPECT_THAT(read(std::string("NOD.MTN\0", 8)), HasSubstr("does not end in .MTN"));
}

TEST(MotionName, HasOneToEightCharactersBeforeIt) {
  EXPECT_THAT(read(".MTN"), HasSubstr("nothing before .MTN"));
  EXPECT_THAT(read("123456789.MTN"), HasSubstr("more than 8 characters"));
  EXPECT_THAT(read(std::string(100000, 'A') + ".MTN"), HasSubstr("more than 8 characters"));
}

TEST(MotionName, LeadsOutOfNoFolder) {
  for (const char* text :
       {"../A.MTN", "..\\A.MTN", "A/B.MTN", "/A.MTN", "\\A.MTN", "C:A.MTN", "..MTN", "...MTN", "A.B.MTN", "A.MTN.MTN",
        " .MTN", "A B.MTN", "*.MTN", "?.MTN", "\"A\".MTN", "A;B.MTN", "A|B.MTN", "<A>.MTN"}) {
    EXPECT_THAT(read(text), HasSubstr("other characters")) << text;
  }
}

TEST(MotionName, IsMadeOfNoOtherByte) {
  const std::string allowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789!#$%&'()-@^_`{}~";
  for (int byte = 0; byte < 256; ++byte) {
    const char character = static_cast<char>(byte);
    const bool is_name = read(std::string("A") + character + ".MTN").size() == 6;
    EXPECT_EQ(is_name, allowed.find(character) != std::string::npos) << byte;
  }
}

}  // namespace
}  // namespace protocol
