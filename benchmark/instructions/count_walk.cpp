// Lets RCServer's joints stand or walk, to count instructions. Joints follow their commands, the floor is level, and
// the sensors report as often as a robot's.
//
//   count_walk SPEED SECONDS    walks forward at SPEED, in mm/s, with the guard; at 0 it only stands
#include <cstdio>
#include <cstdlib>

#include "rcserver/joints/JointControl.h"

namespace {

constexpr unsigned kFramesASecond = 125;
constexpr unsigned kFramesOfReport = 4;
constexpr unsigned kFramesOfSteering = 12;  // a client steers ten times a second
constexpr double kGravity = 9.8;            // m/s^2
// What the sensors measure on a level floor without anything on it.
const WalkGuard::Reading kLevelFloor = {0.223, 2, 2, {}, {true, true, true, true}};
constexpr FallWatch::Reading kUpright = {0, 0, kGravity, {true, true, true, true}};

void report(JointControl& joints, unsigned frame) {
  for (int joint = 0; joint < joints.NumberOfJoints(); ++joint) {
    const int position = joints.Planner().Position(joint);
    joints.Measured(joint, {position, position, 0}, frame, true);
  }
  joints.Measured(kUpright, frame);
  joints.Walking().HaveLooked(kLevelFloor);
}

void pass(JointControl& joints, unsigned* frame) {
  joints.NextFrame();
  if (++*frame % kFramesOfReport == 0) {
    report(joints, *frame);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "count_walk SPEED SECONDS\n");
    return 2;
  }
  JointControl joints(*robot_model::findRobotModel("ERS-7"));
  unsigned frame = 0;
  joints.Take(protocol::version2::POSTURE_STAND);
  while (joints.AreMoving()) {
    pass(joints, &frame);
  }
  const protocol::version2::Velocity velocity = {std::atoi(argv[1]) * 1e-3, 0, 0};
  const unsigned end = frame + kFramesASecond * static_cast<unsigned>(std::atoi(argv[2]));
  while (frame < end) {
    if (frame % kFramesOfSteering == 0) {
      joints.Steer(velocity, true);
    }
    pass(joints, &frame);
  }
  std::printf("%s\n", joints.Walking().IsActive() ? "walks" : "stands");
  return 0;
}
