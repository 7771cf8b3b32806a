/// @file names.h
/// The names of the joints, sensors, LEDs and postures of the robots, such as "head_pan", "battery", "face_1" and
/// "sit". Requests and telemetry have their RCServer identifiers instead; docs/protocol.md lists both.
///
/// The functions for parts take the design of the robot (RobotInfo::design), because some identifiers mean different
/// parts on different robots. If the design is empty, as for a version 1 server, the ERS-7 is searched first, then the
/// ERS-210.
///
/// @code
/// const int pan = aibo_client::idOfJoint("head_pan");
/// robot.commandJoints({{pan, 0.5}}, 1s);
/// robot.commandLeds({{aibo_client::idOfLed("face_1"), 255}});
/// @endcode
#ifndef AIBO_CLIENT_NAMES_H
#define AIBO_CLIENT_NAMES_H

#include <string>

#include "aibo_client/walk.h"

namespace aibo_client {

/// The identifier of a joint.
/// @throw InvalidArgumentException no joint has this name; the message lists all names
int idOfJoint(const std::string& name, const std::string& design = "");

/// The identifier of a sensor.
/// @throw InvalidArgumentException no sensor has this name; the message lists all names
int idOfSensor(const std::string& name, const std::string& design = "");

/// The identifier of an LED.
/// @throw InvalidArgumentException no LED has this name; the message lists all names
int idOfLed(const std::string& name, const std::string& design = "");

/// The name of a joint, or "joint 99" if no joint has this identifier.
std::string nameOfJoint(int id, const std::string& design = "");

/// The name of a sensor, or "sensor 99" if no sensor has this identifier.
std::string nameOfSensor(int id, const std::string& design = "");

/// The name of an LED, or "LED 99" if no LED has this identifier.
std::string nameOfLed(int id, const std::string& design = "");

/// The name of a posture: "stand", "sit" or "rest".
std::string nameOfPosture(Posture posture);

}  // namespace aibo_client

#endif  // AIBO_CLIENT_NAMES_H
