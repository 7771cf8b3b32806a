/// @file number.h
/// Numbers in sentences.
#ifndef AIBO_DRIVER_TEXT_NUMBER_H
#define AIBO_DRIVER_TEXT_NUMBER_H

#include <string>

namespace aibo_driver::text {

/// Writes a number, as in "0.25".
/// @param digits how many digits follow the point. A number beyond 1e15 has an exponent instead, because nobody reads
///     300 digits.
std::string decimal(double value, int digits);

}  // namespace aibo_driver::text

#endif  // AIBO_DRIVER_TEXT_NUMBER_H
