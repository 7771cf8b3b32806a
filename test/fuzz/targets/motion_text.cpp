// The readable form of motions: any text. What is accepted makes a motion file that is accepted.
#include <sstream>
#include <stdexcept>

#include "fuzz_input.h"
#include "motion_tool/mtn_writer.h"
#include "motion_tool/text_form.h"
#include "mtn/motion.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream text(FuzzInput(data, size).takeText(size));
  std::string bytes;
  try {
    bytes = motion_tool::encodeMtn(motion_tool::parseTextForm(text));
  } catch (const std::runtime_error&) {
    return 0;
  }
  mtn::Motion motion;
  require(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()), "what is made is a motion");
  return 0;
}
