#include "protocol/angles.h"

namespace protocol {

namespace {

const double MICRORADIANS_PER_CENTIDEGREE = 3.14159265358979323846 / 180.0 / 100.0 * 1e6;

const int SMALLEST_CENTIDEGREES = -32768;
const int LARGEST_CENTIDEGREES = 32767;

int roundToNearest(double value) {
  return static_cast<int>(value < 0 ? value - 0.5 : value + 0.5);
}

}  // namespace

int microradiansFromCentidegrees(short centidegrees) {
  return roundToNearest(centidegrees * MICRORADIANS_PER_CENTIDEGREE);
}

short centidegreesFromMicroradians(int microradians) {
  const int centidegrees = roundToNearest(microradians / MICRORADIANS_PER_CENTIDEGREE);
  if (centidegrees < SMALLEST_CENTIDEGREES) {
    return SMALLEST_CENTIDEGREES;
  }
  return static_cast<short>(centidegrees > LARGEST_CENTIDEGREES ? LARGEST_CENTIDEGREES : centidegrees);
}

}  // namespace protocol
