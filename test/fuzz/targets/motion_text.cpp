// The text form of motions: any text. An accepted text makes an accepted motion file.
#include <stdexcept>

#include "fuzz_input.h"
#include "motion_tool/motion_tool.h"
#include "mtn/motion.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = FuzzInput(data, size).takeText(size);
  std::string bytes;
  try {
    bytes = motion_tool::encodeMtn(motion_tool::parseTextForm(text));
  } catch (const std::runtime_error&) {
    return 0;
  }
  mtn::Motion motion;
  require(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()),
          "a written motion can be read");
  return 0;
}
