/// @file OUnits.h
/// OPEN-R counts in millionths of a radian, a metre, a degree Celsius...
#ifndef OPENR_OUNITS_H
#define OPENR_OUNITS_H

#include <Types.h>

typedef slongword Length;           ///< micrometres
typedef slongword Mass;             ///< milligrams
typedef slongword Angle;            ///< microradians
typedef slongword Temperature;      ///< millionths of a degree Celsius
typedef slongword Velocity;         ///< micrometres per second
typedef slongword Acceleration;     ///< micrometres per second squared
typedef slongword AngularVelocity;  ///< microradians per second
typedef slongword Force;            ///< micronewtons
typedef slongword Percentage;       ///< millionths of a per cent

const slongword oradiansPI = 3141592;
const slongword oradiansPI_2 = 1570796;
const slongword oradiansPI_4 = 785398;

/// Converts to millionths, truncated towards 0.
inline slongword micro(double value) {
  return static_cast<slongword>(value * 1e6);
}

inline double radians(double deg) {
  return deg * (3.14159265358979323846 / 180.0);
}

inline double degrees(double rad) {
  return rad * (180.0 / 3.14159265358979323846);
}

/// Converts from degrees to microradians, the unit of joints.
inline slongword oradians(double deg) {
  return micro(radians(deg));
}

#endif  // OPENR_OUNITS_H
