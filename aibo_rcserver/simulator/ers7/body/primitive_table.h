/// @file primitive_table.h
/// The robot's primitives: their locators for OPENR::OpenPrimitive(), and which of them are open.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_PRIMITIVE_TABLE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_PRIMITIVE_TABLE_H

#include <OPENR/OPENR.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "robot_model/robot_model.h"

namespace simulated_ers7 {

constexpr OPrimitiveID kCameraPrimitive = 1;

constexpr OPrimitiveID jointPrimitive(std::size_t joint) {
  return static_cast<OPrimitiveID>(kCameraPrimitive + 1 + joint);
}

constexpr OPrimitiveID sensorPrimitive(std::size_t sensor) {
  return jointPrimitive(robot_model::MAX_JOINTS) + static_cast<OPrimitiveID>(sensor);
}
constexpr OPrimitiveID ledPrimitive(std::size_t led) {
  return sensorPrimitive(robot_model::MAX_SENSORS) + static_cast<OPrimitiveID>(led);
}
constexpr OPrimitiveID earPrimitive(std::size_t ear) {
  return ledPrimitive(robot_model::MAX_LEDS) + static_cast<OPrimitiveID>(ear);
}

/// The primitives of speaker and microphones.
constexpr OPrimitiveID kSpeakerPrimitive = earPrimitive(robot_model::MAX_EARS);
constexpr OPrimitiveID kMicrophonePrimitive = kSpeakerPrimitive + 1;

enum class PrimitiveKind { kCamera, kJoint, kSensor, kLed, kEar, kSound };

/// The device of a primitive's number.
struct Primitive {
  PrimitiveKind kind;
  std::size_t index;  ///< its index in the robot's table of this kind; 0 for the camera and sound
};

/// Opens primitives. Each always has the same number, and stays open until it was closed as often as it was opened.
class PrimitiveTable {
 public:
  explicit PrimitiveTable(const robot_model::RobotModel& model);

  /// @param locator as in Sony's Model Information: "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1"
  /// @param[out] id unchanged unless oSUCCESS is returned
  /// @return oNOT_FOUND if the robot has nothing there, oINVALID_ARG for null pointers
  OStatus open(const char* locator, OPrimitiveID* id);

  /// @param id oprimitiveID_UNDEF closes all open primitives
  /// @return oINVALID_PRIMITIVE_ID if the primitive is not open
  OStatus close(OPrimitiveID id);

  bool isOpen(OPrimitiveID id) const { return times_opened_.count(id) != 0; }

  /// The primitive with this number; empty if it is not open.
  std::optional<Primitive> find(OPrimitiveID id) const;

 private:
  void add(const char* locator, OPrimitiveID id, const Primitive& primitive);

  std::map<std::string, OPrimitiveID> ids_;  ///< key: the locator
  std::map<OPrimitiveID, Primitive> primitives_;
  std::map<OPrimitiveID, int> times_opened_;  ///< only open primitives
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_PRIMITIVE_TABLE_H
