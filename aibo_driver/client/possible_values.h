/// @file possible_values.h
/// Which values a robot's joints and sensors can have, with room for noise: whatever is outside did not come from a
/// working robot. A design that is not known, as with version 1 of the protocol, is taken for any robot in the tables.
///
/// The numbers of robot_model.h say how far things go; how far beyond that a measurement can still be right is our own
/// choice.
#ifndef AIBO_DRIVER_CLIENT_POSSIBLE_VALUES_H
#define AIBO_DRIVER_CLIENT_POSSIBLE_VALUES_H

#include <string>

#include "aibo_driver/colors.h"

namespace aibo_driver {

/// Both ends are possible, too.
struct ValueRange {
  double lowest;
  double highest;

  bool contains(double value) const { return lowest <= value && value <= highest; }
};

/// Positions of a joint, in rad: the range in which it can be moved by hand, and 0.2 rad (11 degrees) more, for
/// potentiometers that are a bit off. A joint that is not in the tables can be anywhere within two turns.
/// @param design of the robot; empty if it is not known
/// @param id of the joint
ValueRange possiblePositions(const std::string& design, int id);

/// How far a joint can seem to move in a time, in rad: at three times its highest speed, because somebody may move it
/// by hand or it may fall, and 0.05 rad (3 degrees) more for noise.
/// @param seconds not negative
double longestMove(const std::string& design, int id, double seconds);

/// Duties of a motor, in shares of full power.
constexpr ValueRange kPossibleDuties = {-1, 1};

/// Velocities of a walk, in m/s to each side and in rad/s. A foot moves at 0.7 m/s at most: a leg of 0.14 m that turns
/// at the highest speed of its joints. Turning, it moves around a circle of 0.1 m.
constexpr ValueRange kPossibleWalks = {-1, 1};
constexpr ValueRange kPossibleTurns = {-10, 10};

/// Values of a sensor, in the units of SensorReading: twice its measuring range for distance, acceleration and force,
/// ten times for touch, -40 to 125 degrees Celsius, 0 to 1.05 for the charge, 0 or 1 for a switch. Of a sensor that is
/// not in the tables, everything is possible.
ValueRange possibleReadings(const std::string& design, int id);

/// True if a camera can detect colours in a plane of this size: it is not larger than a picture of double resolution.
bool isPossiblePlane(int width, int height);

/// True if a region of a plane of this size does not contradict itself: its box is in the plane, its pixels fit into
/// the box and their centroid is in it.
bool isPossible(const DetectedRegion& region, int width, int height);

/// The name of a joint for messages: "left_front_knee", or "joint 99" if it is not in the tables.
std::string nameOfJoint(const std::string& design, int id);
/// The same for a sensor.
std::string nameOfSensor(const std::string& design, int id);

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_POSSIBLE_VALUES_H
