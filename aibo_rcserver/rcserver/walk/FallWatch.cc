#include "rcserver/walk/FallWatch.h"

#include <math.h>
#include <stddef.h>

#include <algorithm>

namespace {

const double LEAST = 4;  // m/s^2; if the acceleration is less, nobody knows where up is

// The share of a report in the mean, which follows within 3 reports: 0.1 s. A mean is needed because a robot that lies
// and still walks is shaken by its legs.
const double NEW_SHARE = 0.3;

const double COSINE_60 = 0.5;
const double SINE_30 = 0.5;

}  // namespace

const unsigned FallWatch::PATIENCE;
const int FallWatch::STANDING_PAWS;

void FallWatch::Look(const Reading& reading, bool stands, unsigned frame) {
  mean_.forward += NEW_SHARE * (reading.forward - mean_.forward);
  mean_.left += NEW_SHARE * (reading.left - mean_.left);
  mean_.up += NEW_SHARE * (reading.up - mean_.up);
  std::copy(reading.paws, reading.paws + robot_model::NUMBER_OF_LEGS, mean_.paws);
  const Verdict verdict = Judge(mean_, stands);
  if (verdict != candidate_ && !(IsFallen(verdict) && IsFallen(candidate_))) {
    candidate_since_ = frame;
  }
  candidate_ = verdict;
  if (candidate_ != verdict_ && frame - candidate_since_ >= PATIENCE) {
    verdict_ = candidate_;
    since_ = candidate_since_;
  }
}

const char* FallWatch::Words(Verdict verdict) {
  // In the order of Verdict.
  static const char* const WORDS[] = {NULL, "the robot lies on its left side", "the robot lies on its right side",
                                      "the robot lies on its back",
                                      "the robot is carried: none of its paws touches the floor"};
  return WORDS[verdict];
}

FallWatch::Verdict FallWatch::Judge(const Reading& reading, bool stands) {
  const double size = sqrt(reading.forward * reading.forward + reading.left * reading.left + reading.up * reading.up);
  if (size >= LEAST && reading.up < COSINE_60 * size) {
    const bool on_side = reading.up > -COSINE_60 * size || fabs(reading.left) > SINE_30 * size;
    return !on_side ? UPSIDE_DOWN : reading.left < 0 ? ON_LEFT_SIDE : ON_RIGHT_SIDE;
  }
  const int touching = static_cast<int>(std::count(reading.paws, reading.paws + robot_model::NUMBER_OF_LEGS, true));
  paws_work_ = stands && (paws_work_ || touching >= STANDING_PAWS);
  return paws_work_ && touching == 0 ? CARRIED : UPRIGHT;
}
