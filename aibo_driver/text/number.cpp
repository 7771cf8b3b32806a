#include "text/number.h"

#include <cmath>
#include <cstdio>

namespace aibo_driver::text {

std::string decimal(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, std::abs(value) < 1e15 ? "%.*f" : "%.*g", digits, value);
  return text;
}

}  // namespace aibo_driver::text
