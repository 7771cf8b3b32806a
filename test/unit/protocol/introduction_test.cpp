#include "protocol/introduction.h"

#include <gmock/gmock.h>

#include <string>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::StrEq;

constexpr char kToken[] = "0123456789abcdef";

Bytes introduction() {
  Bytes bytes(INTRODUCTION_SIZE);
  encodeIntroduction(kToken, bytes.data());
  return bytes;
}

bool isOne(const Bytes& bytes) {
  char token[TOKEN_SIZE + 1];
  return decodeIntroduction(bytes.data(), bytes.size(), token);
}

TEST(Introduction, IsTheRequestForVersion2AndAHelloWithTheToken) {
  EXPECT_EQ(introduction(), hex("58 02 48 00 00 01 00 00 00 16") + bytesOf("token=0123456789abcdef"));
  char token[TOKEN_SIZE + 1];
  const Bytes bytes = introduction() + bytesOf("more");
  ASSERT_TRUE(decodeIntroduction(bytes.data(), bytes.size(), token));
  EXPECT_THAT(token, StrEq(kToken));
}

TEST(Introduction, NothingElseIsOne) {
  for (size_t size = 0; size < INTRODUCTION_SIZE; ++size) {
    EXPECT_FALSE(isOne(firstOf(introduction(), size))) << size;
  }
  for (size_t i = 0; i < INTRODUCTION_SIZE - TOKEN_SIZE; ++i) {
    Bytes bytes = introduction();
    bytes[i] ^= 1;
    EXPECT_FALSE(isOne(bytes)) << i;
  }
}

TEST(Introduction, ATokenHasSixteenHexadecimalDigits) {
  EXPECT_TRUE(isToken(kToken));
  for (const char* text : {"", "0123456789abcde", "0123456789abcdef0", "0123456789ABCDEF", "0123456789abcde "}) {
    EXPECT_FALSE(isToken(text)) << text;
  }
}

Hello decoded(const std::string& line) {
  const Bytes bytes = bytesOf(kHello + line);
  Hello hello{};
  EXPECT_EQ(decodeHello(bytes.data(), bytes.size(), &hello), nullptr);
  return hello;
}

TEST(Introduction, TheHelloHasTheToken) {
  const Hello hello = decoded("token=0123456789abcdef\n");
  EXPECT_THAT(hello.token, StrEq(kToken));
  EXPECT_EQ(encoded(encodeHello, hello, MAX_HELLO_SIZE), bytesOf(std::string(kHello) + "token=0123456789abcdef\n"));
  EXPECT_THAT(decoded("").token, StrEq(""));
  EXPECT_THAT(decoded("token=\n").token, StrEq("")) << "of another kind";
  EXPECT_THAT(decoded("token=0123456789abcdeg\n").token, StrEq(""));
}

}  // namespace
}  // namespace version2
}  // namespace protocol
