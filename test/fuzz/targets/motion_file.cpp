// The reader of motion files, and of archives of them: any bytes. Accepted files are read completely, printed, checked
// and fitted to a robot.
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz_input.h"
#include "motion_tool/archive.h"
#include "motion_tool/motion_tool.h"
#include "mtn/fitted_motion.h"
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

// Texts in other character sets, or with `#` or blanks in them, are changed; everything else stays.
void printAndReadAgain(const mtn::Motion& motion) {
  try {
    motion_tool::encodeMtn(motion_tool::parseTextForm(motion_tool::printTextForm(motion)));
  } catch (const std::runtime_error&) {
  }
}

// Every motion that is played is within the joints' limits and takes time.
void fitTo(const mtn::Motion& motion, const robot_model::RobotModel& robot) {
  mtn::FittedMotion fitted;
  if (!fitted.fit(motion, robot, true)) {
    require(fitted.problem()[0] != '\0' && fitted.numberOfKeyFrames() == 0, "a refusal has a reason");
    return;
  }
  const std::vector<int> speed_limits(robot_model::MAX_JOINTS, 125);  // the lowest that can be set
  for (int key_frame = 0; key_frame < fitted.numberOfKeyFrames(); ++key_frame) {
    int positions[robot_model::MAX_JOINTS];
    fitted.posture(key_frame, positions);
    for (int i = 0; i < fitted.numberOfJoints(); ++i) {
      const robot_model::Joint& joint = robot.joints[fitted.joint(i)];
      require(positions[i] >= joint.lowest && positions[i] <= joint.highest, "a position is within the joint's limits");
    }
    require(key_frame == 0 || fitted.milliseconds(key_frame, speed_limits.data()) > 0, "a step takes time");
  }
  char text[mtn::FittedMotion::MAX_DESCRIPTION_SIZE];
  fitted.describe(speed_limits.data(), text);
}

void readArchive(const std::string& bytes) {
  try {
    for (const motion_tool::ArchivedFile& file : motion_tool::readArchive(bytes)) {
      const std::string name = motion_tool::fileNameOf(file);
      require(name.find('/') == std::string::npos && name[0] != '.', "a name stays in its folder");
    }
  } catch (const std::runtime_error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  if (motion_tool::isArchive(bytes)) {
    readArchive(bytes);
    return 0;
  }
  mtn::Motion motion;
  if (!motion.read(data, size)) {
    require(motion.problem()[0] != '\0' && motion.numberOfJoints() == 0, "a refusal has a reason");
    return 0;
  }
  readEverything(motion);
  printAndReadAgain(motion);
  if (const robot_model::RobotModel* robot = motion_tool::robotOf(motion)) {
    fitTo(motion, *robot);
  }
  return 0;
}
