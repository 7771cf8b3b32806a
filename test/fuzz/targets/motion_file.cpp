// The reader of motion files: any bytes. Accepted files are read completely, printed and checked.
#include <sstream>
#include <stdexcept>

#include "fuzz_input.h"
#include "motion_tool/motion_tool.h"
#include "mtn/motion.h"

namespace {

void readEverything(const mtn::Motion& motion) {
  for (int key_frame = 0; key_frame < motion.numberOfKeyFrames(); ++key_frame) {
    require(motion.milliseconds(key_frame) >= 0, "time does not go back");
    for (int joint = 0; joint < motion.numberOfJoints(); ++joint) {
      const int position = motion.position(key_frame, joint);
      require(position >= -mtn::MAX_POSITION && position <= mtn::MAX_POSITION, "a position is within its range");
    }
  }
}

// Texts in other character sets, or with `#` or blanks in them, do not survive; everything else does.
void printAndReadAgain(const mtn::Motion& motion) {
  std::istringstream text(motion_tool::printTextForm(motion));
  try {
    motion_tool::encodeMtn(motion_tool::parseTextForm(text));
  } catch (const std::runtime_error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  mtn::Motion motion;
  if (!motion.read(data, size)) {
    require(motion.problem()[0] != '\0' && motion.numberOfJoints() == 0, "a refusal has a reason");
    return 0;
  }
  readEverything(motion);
  printAndReadAgain(motion);
  if (const robot_model::RobotModel* robot = motion_tool::modelOf(motion.design())) {
    motion_tool::findObstacles(motion, *robot);
  }
  return 0;
}
