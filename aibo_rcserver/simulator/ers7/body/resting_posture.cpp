#include "simulator/ers7/body/resting_posture.h"

#include <cmath>
#include <map>

namespace simulated_ers7 {
namespace {

const std::map<std::string, int> kDegrees = {
    {"neck_tilt", -25},
    {"head_pan", 0},
    {"head_tilt", 10},
    {"mouth", -4},
    {"left_front_rotator", -23},
    {"left_front_elevator", 0},
    {"left_front_knee", 44},
    {"left_hind_rotator", 26},
    {"left_hind_elevator", 0},
    {"left_hind_knee", 57},
    {"right_front_rotator", -23},
    {"right_front_elevator", 0},
    {"right_front_knee", 44},
    {"right_hind_rotator", 26},
    {"right_hind_elevator", 0},
    {"right_hind_knee", 57},
    {"tail_pan", 0},
    {"tail_tilt", 30},
};

}  // namespace

int restingPosition(const std::string& joint) {
  return static_cast<int>(std::lround(kDegrees.at(joint) * std::acos(-1.0) / 180 * 1e6));
}

HeadAngles restingHead() {
  HeadAngles angles;
  angles.neck_tilt = restingPosition("neck_tilt") / 1e6;
  angles.head_pan = restingPosition("head_pan") / 1e6;
  angles.head_tilt = restingPosition("head_tilt") / 1e6;
  return angles;
}

}  // namespace simulated_ers7
