#include "protocol/hello.h"

#include <gmock/gmock.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;
using ::testing::NotNull;
using ::testing::StrEq;

Hello exampleHello() {
  Hello hello{};
  std::strcpy(hello.robot, "ERS-7");
  std::strcpy(hello.server, "aibo_rcserver 0.1.0");
  hello.frame_number = 4294967295U;
  std::strcpy(hello.capabilities, "H F W J V T");
  hello.joint_count = 2;
  hello.joints[0] = {1, -1308997, 0, 3185226};
  hello.joints[1] = {2, -1535890, 1535890, 10057460};
  return hello;
}

std::string encode(const Hello& hello) {
  Bytes bytes(MAX_HELLO_SIZE);
  return std::string(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(encodeHello(hello, bytes.data())));
}

const char* decode(const std::string& text, Hello* hello) {
  const Bytes bytes = bytesOf(text);
  return decodeHello(bytes.data(), bytes.size(), hello);
}

const char* verdict(const std::string& text) {
  Hello hello{};
  return decode(text, &hello);
}

// The example with one piece replaced.
std::string with(const std::string& piece, const std::string& replacement) {
  std::string text = kHello;
  return text.replace(text.find(piece), piece.size(), replacement);
}

TEST(Hello, IsLinesOfKeyAndValue) {
  EXPECT_EQ(encode(exampleHello()), kHello);
}

TEST(Hello, IsReadBack) {
  Hello hello{};
  ASSERT_THAT(decode(kHello, &hello), IsNull());
  EXPECT_THAT(hello.robot, StrEq("ERS-7"));
  EXPECT_THAT(hello.server, StrEq("aibo_rcserver 0.1.0"));
  EXPECT_EQ(hello.frame_number, 4294967295U);
  EXPECT_THAT(hello.capabilities, StrEq("H F W J V T"));
  ASSERT_EQ(hello.joint_count, 2);
  EXPECT_EQ(hello.joints[1].id, 2);
  EXPECT_EQ(hello.joints[1].lower, -1535890);
  EXPECT_EQ(hello.joints[1].upper, 1535890);
  EXPECT_EQ(hello.joints[1].speed, 10057460);
}

TEST(Hello, OfTheLargestSizeFits) {
  Hello hello{};
  for (char* text : {hello.robot, hello.server, hello.capabilities}) {
    std::memset(text, 'a', MAX_HELLO_TEXT_SIZE);
  }
  hello.frame_number = UINT_MAX;
  hello.joint_count = MAX_JOINTS;
  for (size_t i = 0; i < MAX_JOINTS; ++i) {
    hello.joints[i] = {static_cast<unsigned char>(255 - i), -INT_MAX, INT_MAX, INT_MAX};
  }
  hello.walk = {32.767, 32.767, 32.767, 32.767};
  Hello again{};
  ASSERT_THAT(decode(encode(hello), &again), IsNull());
  EXPECT_EQ(encode(again), encode(hello));
  EXPECT_EQ(again.joint_count, MAX_JOINTS);
}

TEST(Hello, HasTheLimitsOfTheWalkOfARobotThatWalks) {
  const std::string text = std::string(kHello) + "walk_limits=150:100:60:1200\n";
  Hello hello = exampleHello();
  hello.walk = {0.15, 0.1, 0.06, 1.2};
  EXPECT_EQ(encode(hello), text);

  Hello again{};
  ASSERT_THAT(decode(text, &again), IsNull());
  EXPECT_DOUBLE_EQ(again.walk.forward, 0.15);
  EXPECT_DOUBLE_EQ(again.walk.back, 0.1);
  EXPECT_DOUBLE_EQ(again.walk.left, 0.06);
  EXPECT_DOUBLE_EQ(again.walk.turn, 1.2);

  ASSERT_THAT(decode(kHello, &again), IsNull());
  for (const double limit : {again.walk.forward, again.walk.back, again.walk.left, again.walk.turn}) {
    EXPECT_EQ(limit, 0);
  }
}

TEST(Hello, HasTheLimitsOfARobotThatWalksInOneDirectionOnly) {
  Hello hello = exampleHello();
  for (const auto& [walk, limits] : std::vector<std::pair<WalkLimits, std::string>>{{{0.15, 0, 0, 0}, "150:0:0:0"},
                                                                                    {{0, 0.1, 0, 0}, "0:100:0:0"},
                                                                                    {{0, 0, 0.06, 0}, "0:0:60:0"},
                                                                                    {{0, 0, 0, 1.2}, "0:0:0:1200"}}) {
    hello.walk = walk;
    EXPECT_EQ(encode(hello), kHello + ("walk_limits=" + limits + "\n"));
  }
}

TEST(Hello, IsRefusedWithMalformedLimitsOfTheWalk) {
  for (const char* limits : {"", "150", "150:100:60", "150:100:60:1200:1", "-1:100:60:1200", "32768:100:60:1200",
                             "150:100:60:", "150:100:60:1200 "}) {
    EXPECT_THAT(verdict(kHello + ("walk_limits=" + std::string(limits) + "\n")), HasSubstr("forward:back:left:turn"))
        << limits;
  }
}

TEST(Hello, MayBeOfARobotWithoutJoints) {
  Hello hello{};
  ASSERT_THAT(decode("robot=\nserver=\nframe_number=0\ncapabilities=\nlimits=\n", &hello), IsNull());
  EXPECT_EQ(hello.joint_count, 0);
  EXPECT_THAT(hello.robot, StrEq(""));
}

TEST(Hello, MayHaveItsLinesInAnyOrderAndOthersBetweenThem) {
  Hello hello{};
  ASSERT_THAT(decode("wlan=100 %\nlimits=\ncapabilities=H\nframe_number=8\nserver=s=1\nrobot=ERS-210\nnew=\n", &hello),
              IsNull());
  EXPECT_THAT(hello.robot, StrEq("ERS-210"));
  EXPECT_THAT(hello.server, StrEq("s=1"));
  EXPECT_EQ(hello.frame_number, 8U);
}

TEST(Hello, IsRefusedWhenBytesAreMissing) {
  const std::string text = kHello;
  for (size_t size = 0; size < text.size(); ++size) {
    EXPECT_THAT(verdict(text.substr(0, size)), NotNull()) << size;
  }
}

TEST(Hello, IsRefusedWithoutAnyOneOfItsLines) {
  for (const char* key : {"robot=", "server=", "frame_number=", "capabilities=", "limits="}) {
    EXPECT_THAT(verdict(with(key, "x=")), HasSubstr("lacks")) << key;
  }
}

TEST(Hello, IsRefusedWithALineTwice) {
  EXPECT_THAT(verdict(std::string(kHello) + "robot=ERS-210\n"), HasSubstr("twice"));
}

TEST(Hello, IsRefusedWithALineThatIsNotKeyAndValue) {
  EXPECT_THAT(verdict(with("robot=ERS-7\n", "robot=ERS-7\n\n")), HasSubstr("key=value"));
  EXPECT_THAT(verdict(with("robot=ERS-7\n", "robot=ERS-7\nnews\n")), HasSubstr("key=value"));
  EXPECT_THAT(verdict(with("robot=ERS-7\n", "robot=ERS-7\n=x\n")), HasSubstr("key=value"));
}

TEST(Hello, IsRefusedWithATextThatWouldSpoilALog) {
  EXPECT_THAT(verdict(with("ERS-7", "\x1b[2J")), HasSubstr("control"));
  EXPECT_THAT(verdict(with("ERS-7", std::string(1, '\0'))), HasSubstr("control"));
  EXPECT_THAT(verdict(with("ERS-7", "\xff")), HasSubstr("UTF-8"));
}

TEST(Hello, IsRefusedWithATextThatIsTooLong) {
  EXPECT_THAT(verdict(with("ERS-7", std::string(127, 'a'))), IsNull());
  EXPECT_THAT(verdict(with("ERS-7", std::string(128, 'a'))), HasSubstr("longer"));
}

TEST(Hello, IsRefusedWithAMalformedFrameNumber) {
  for (const char* number : {"", "-1", "1.5", "0x10", " 1", "4294967296", "99999999999999999999"}) {
    EXPECT_THAT(verdict(with("4294967295", number)), HasSubstr("frame number")) << number;
  }
}

TEST(Hello, MayHaveAJointThatCannotMove) {
  EXPECT_THAT(verdict(with("1:-1308997:0:3185226", "0:7:7:0")), IsNull());
}

TEST(Hello, IsRefusedWithMalformedLimits) {
  for (const char* limits : {"1", "1:0:1", "1:0:1:2:3", "256:0:1:2", "-1:0:1:2", "1:1:0:2", "1:0:1:-2", "1::1:2",
                             "1:0:1:2  2:0:1:2", "1:-:1:2", "1:0:2147483648:2"}) {
    EXPECT_THAT(verdict(with("1:-1308997:0:3185226", limits)), HasSubstr("id:lower:upper:speed")) << limits;
  }
}

TEST(Hello, IsRefusedWithMoreJointsThanAnyRobotHas) {
  std::string limits;
  for (int id = 100; id < 131; ++id) {
    limits += std::to_string(id) + ":0:1:2 ";
  }
  EXPECT_THAT(verdict(with("1:-1308997:0:3185226 ", limits)), IsNull());
  EXPECT_THAT(verdict(with("1:-1308997:0:3185226 ", limits + "131:0:1:2 ")), HasSubstr("more joints"));
}

TEST(Hello, IsRefusedWithTheLimitsOfAJointTwice) {
  EXPECT_THAT(verdict(with(" 2:", " 1:")), HasSubstr("twice"));
}

TEST(Hello, ListsTheServersCapabilities) {
  const Hello hello = exampleHello();
  EXPECT_TRUE(hasCapability(hello, "H"));
  EXPECT_TRUE(hasCapability(hello, "T"));
  EXPECT_FALSE(hasCapability(hello, "L"));
  EXPECT_FALSE(hasCapability(hello, "H F"));
  EXPECT_FALSE(hasCapability(hello, ""));
  EXPECT_FALSE(hasCapability(Hello{}, "H"));
}

}  // namespace
}  // namespace version2
}  // namespace protocol
