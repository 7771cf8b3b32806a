#include "protocol/angles.h"

#include <limits.h>

#include "protocol/rounding.h"

namespace protocol {

namespace {

const double MICRORADIANS_PER_CENTIDEGREE = 3.14159265358979323846 / 180.0 / 100.0 * 1e6;

}  // namespace

int microradiansFromCentidegrees(short centidegrees) {
  return roundInto(centidegrees * MICRORADIANS_PER_CENTIDEGREE, INT_MIN, INT_MAX);
}

short centidegreesFromMicroradians(int microradians) {
  return roundIntoShort(microradians / MICRORADIANS_PER_CENTIDEGREE);
}

}  // namespace protocol
