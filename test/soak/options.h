/// @file options.h
#ifndef TEST_SOAK_OPTIONS_H
#define TEST_SOAK_OPTIONS_H

#include <string>

namespace soak {

/// Of both soaks.
struct Options {
  double minutes = 60;
  unsigned seed = 1;
  std::string folder;   ///< existing folder for logs
  std::string program;  ///< this one, which OrderSoak starts again as each of its users
};

}  // namespace soak

#endif  // TEST_SOAK_OPTIONS_H
