/// @file possible_values.h
/// The values that a robot's joints and sensors can have, with room for noise. No working robot sends any other value.
///
/// The tables of robot_model.h give the ranges. How much further a measurement can be and still be right is our choice.
#ifndef AIBO_DRIVER_CLIENT_POSSIBLE_VALUES_H
#define AIBO_DRIVER_CLIENT_POSSIBLE_VALUES_H

#include <string>

#include "aibo_client/colors.h"

namespace aibo_client {

/// A range of values. Both ends belong to it.
struct ValueRange {
  double lowest;
  double highest;

  bool contains(double value) const { return lowest <= value && value <= highest; }
};

/// The possible positions of a joint, in rad. They are the range in which it can be moved by hand and 0.2 rad (11
/// degrees) more, for potentiometers that are a bit off. A joint that is not in the tables, or that of an unknown
/// design, can be anywhere within two turns.
/// @param design the robot's design; empty if it is not known
/// @param id the joint's id
ValueRange possiblePositions(const std::string& design, int id);

/// Duties of a motor, in shares of full power.
constexpr ValueRange kPossibleDuties = {-1, 1};

/// The possible velocities of a walk, in m/s to each side and in rad/s. A foot moves at 0.7 m/s at most, because a leg
/// is 0.14 m long and turns at the highest speed of its joints. When the robot turns, a foot moves around a circle of
/// 0.1 m.
constexpr ValueRange kPossibleWalks = {-1, 1};
constexpr ValueRange kPossibleTurns = {-10, 10};

/// The possible values of a sensor, in the units of SensorReading: twice its measuring range for distance, acceleration
/// and force; ten times for touch; -40 to 125 degrees Celsius; 0 to 1.05 for the charge; 0 or 1 for a switch. If a
/// sensor is not in the tables, or the design is not known, every value is possible.
ValueRange possibleReadings(const std::string& design, int id);

/// True if a camera can detect colours in a plane of this size. No plane is larger than a picture of double resolution.
bool isPossiblePlane(int width, int height);

/// True if a region does not contradict itself in a plane of this size: its box is in the plane, its pixels fit into
/// the box, and their centroid is in the box.
bool isPossible(const DetectedRegion& region, int width, int height);

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_POSSIBLE_VALUES_H
