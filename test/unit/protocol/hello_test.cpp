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

// The same value with these lines, and with the limits of a walk.
TEST(Hello, IsLinesOfKeyAndValueInAnyOrder) {
  const std::pair<WalkLimits, std::string> rows[] = {{{0, 0, 0, 0}, ""},
                                                     {{0.15, 0.1, 0.06, 1.2}, "walk_limits=150:100:60:1200\n"},
                                                     {{0.15, 0, 0, 0}, "walk_limits=150:0:0:0\n"},
                                                     {{0, 0, 0, 1.2}, "walk_limits=0:0:0:1200\n"}};
  for (const auto& [walk, line] : rows) {
    Hello hello{};
    std::strcpy(hello.robot, "ERS-7");
    std::strcpy(hello.server, "aibo_rcserver 0.1.0");
    hello.frame_number = 4294967295U;
    std::strcpy(hello.capabilities, "H F W J V T");
    hello.joint_count = 2;
    hello.joints[0] = {1, -1308997, 0, 3185226};
    hello.joints[1] = {2, -1535890, 1535890, 10057460};
    hello.walk = walk;
    EXPECT_EQ(encode(hello), kHello + line);
    Hello again{};
    ASSERT_THAT(decode(kHello + line, &again), IsNull());
    EXPECT_EQ(encode(again), kHello + line);
    ASSERT_THAT(decode("new=1\n" + line + kHello, &again), IsNull());
    EXPECT_EQ(encode(again), kHello + line);
  }
}

TEST(Hello, IsReadOrRefusedByItsLines) {
  std::string joints;
  for (int id = 100; id < 131; ++id) {
    joints += std::to_string(id) + ":0:1:2 ";
  }
  const std::string first = "1:-1308997:0:3185226";
  const std::string walk = "walk_limits=";
  struct Row {
    std::string text;
    const char* problem;  // NULL if it is read
  };
  std::vector<Row> rows = {
      {"robot=\nserver=\nframe_number=0\ncapabilities=\nlimits=\n", nullptr},
      {with("robot=", "x="), "lacks"},
      {with("server=", "x="), "lacks"},
      {with("frame_number=", "x="), "lacks"},
      {with("capabilities=", "x="), "lacks"},
      {with("limits=", "x="), "lacks"},
      {std::string(kHello) + "robot=ERS-210\n", "twice"},
      {with("ERS-7\n", "ERS-7\n\n"), "key=value"},
      {with("ERS-7\n", "ERS-7\nnews\n"), "key=value"},
      {with("ERS-7\n", "ERS-7\n=x\n"), "key=value"},
      {with("ERS-7", "\x1b[2J"), "control"},
      {with("ERS-7", std::string(1, '\0')), "control"},
      {with("ERS-7", "\xff"), "UTF-8"},
      {with("ERS-7", std::string(127, 'a')), nullptr},
      {with("ERS-7", std::string(128, 'a')), "longer"},
      {with(first, "0:7:7:0"), nullptr},
      {with(first + " ", joints), nullptr},
      {with(first + " ", joints + "131:0:1:2 "), "more joints"},
      {with(" 2:", " 1:"), "twice"},
  };
  for (const char* number : {"", "-1", "1.5", "0x10", " 1", "4294967296", "99999999999999999999"}) {
    rows.push_back({with("4294967295", number), "frame number"});
  }
  for (const char* limits : {"1", "1:0:1", "1:0:1:2:3", "256:0:1:2", "-1:0:1:2", "1:1:0:2", "1:0:1:-2", "1::1:2",
                             "1:0:1:2  2:0:1:2", "1:-:1:2", "1:0:2147483648:2"}) {
    rows.push_back({with(first, limits), "id:lower:upper:speed"});
  }
  for (const char* limits : {"", "150", "150:100:60", "150:100:60:1200:1", "-1:100:60:1200", "32768:100:60:1200",
                             "150:100:60:", "150:100:60:1200 "}) {
    rows.push_back({kHello + walk + limits + "\n", "forward:back:left:turn"});
  }
  for (size_t size = 0; size < sizeof(kHello) - 1; ++size) {
    rows.push_back({std::string(kHello, size), ""});
  }
  for (const Row& row : rows) {
    const char* const problem = verdict(row.text);
    EXPECT_EQ(problem == nullptr, row.problem == nullptr) << row.text;
    EXPECT_THAT(problem == nullptr ? "" : problem, HasSubstr(row.problem == nullptr ? "" : row.problem)) << row.text;
  }
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

}  // namespace
}  // namespace version2
}  // namespace protocol
