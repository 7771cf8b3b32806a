// The decoders of the hello, in which a version 2 server describes itself, and of the introduction of a client that
// comes back: any bytes.
#include "protocol/hello.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "fuzz_input.h"
#include "protocol/introduction.h"

namespace version2 = protocol::version2;

namespace {

void decodeIntroduction(const std::uint8_t* data, std::size_t size) {
  char token[version2::TOKEN_SIZE + 1];
  if (version2::decodeIntroduction(data, size, token)) {
    std::array<unsigned char, version2::INTRODUCTION_SIZE> again;
    version2::encodeIntroduction(token, again.data());
    require(std::equal(again.begin(), again.end(), data), "an accepted introduction has only one form");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  decodeIntroduction(data, size);
  version2::Hello hello;
  if (version2::decodeHello(data, size, &hello) != nullptr) {
    return 0;
  }
  require(hello.joint_count <= protocol::version2::MAX_JOINTS, "the joints fit");
  version2::hasCapability(hello, "J");
  static Bytes again(version2::MAX_HELLO_SIZE);
  const std::size_t again_size = version2::encodeHello(hello, again.data());
  require(again_size <= again.size(), "a hello is not larger than its maximum");
  version2::Hello same;
  require(version2::decodeHello(again.data(), again_size, &same) == nullptr, "an encoded hello is accepted");
  require(*hello.token == '\0' || version2::isToken(hello.token), "a token is empty or has its digits");
  require(std::strcmp(hello.robot, same.robot) == 0 && std::strcmp(hello.token, same.token) == 0 &&
              std::strcmp(hello.capabilities, same.capabilities) == 0 && hello.frame_number == same.frame_number &&
              hello.joint_count == same.joint_count && hello.walk.forward == same.walk.forward &&
              hello.walk.turn == same.walk.turn,
          "an encoded hello is the same");
  return 0;
}
