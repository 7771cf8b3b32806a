#include "rcserver/walk/FallWatch.h"

#include <math.h>
#include <stddef.h>

namespace {

const double LEAST = 4;  // m/s^2; with less, up is not known
const double COSINE_60 = 0.5;

}  // namespace

const unsigned FallWatch::PATIENCE;

void FallWatch::Look(const Reading& reading, bool stands, unsigned frame) {
  const Verdict verdict = Judge(reading, stands);
  if (verdict != candidate_) {
    candidate_ = verdict;
    candidate_since_ = frame;
  }
  if (candidate_ != verdict_ && frame - candidate_since_ >= PATIENCE) {
    verdict_ = candidate_;
    since_ = candidate_since_;
  }
}

const char* FallWatch::Words(Verdict verdict) {
  switch (verdict) {
    case ON_ITS_SIDE:
      return "the robot lies on its side";
    case UPSIDE_DOWN:
      return "the robot is upside down";
    case CARRIED:
      return "the robot is carried: none of its paws touches the floor";
    default:
      return NULL;
  }
}

FallWatch::Verdict FallWatch::Judge(const Reading& reading, bool stands) {
  const double size = sqrt(reading.forward * reading.forward + reading.left * reading.left + reading.up * reading.up);
  if (size >= LEAST && reading.up < COSINE_60 * size) {
    return reading.up < -COSINE_60 * size ? UPSIDE_DOWN : ON_ITS_SIDE;
  }
  paws_work_ = stands && (paws_work_ || reading.any_paw);
  return paws_work_ && !reading.any_paw ? CARRIED : UPRIGHT;
}
