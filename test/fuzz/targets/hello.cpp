// The decoder of the hello, in which a version 2 server describes itself: any bytes.
#include "protocol/hello.h"

#include <cstring>

#include "fuzz_input.h"

namespace version2 = protocol::version2;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  version2::Hello hello;
  if (version2::decodeHello(data, size, &hello) != nullptr) {
    return 0;
  }
  require(hello.joint_count <= protocol::version2::MAX_JOINTS, "the joints fit");
  static Bytes again(version2::MAX_HELLO_SIZE);
  const std::size_t again_size = version2::encodeHello(hello, again.data());
  require(again_size <= again.size(), "a hello is not larger than its maximum");
  version2::Hello same;
  require(version2::decodeHello(again.data(), again_size, &same) == nullptr, "an encoded hello is accepted");
  require(std::strcmp(hello.robot, same.robot) == 0 && std::strcmp(hello.capabilities, same.capabilities) == 0 &&
              hello.frame_number == same.frame_number && hello.joint_count == same.joint_count &&
              hello.walk.forward == same.walk.forward && hello.walk.turn == same.walk.turn,
          "an encoded hello is the same");
  return 0;
}
