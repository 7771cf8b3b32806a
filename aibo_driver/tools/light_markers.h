/// @file light_markers.h
#ifndef AIBO_DRIVER_TOOLS_LIGHT_MARKERS_H
#define AIBO_DRIVER_TOOLS_LIGHT_MARKERS_H

#include <aibo_driver/LedStates.h>
#include <aibo_driver/Touch.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

namespace lights {

/// Shows in rviz which LEDs of an ERS-7 shine and what touches it. The markers are on the links of the robot's model.
///
/// The LEDs of the back and the touch sensors are where urdf/ers7.urdf has them. No source says where each LED of the
/// face and the head is, so they are placed by a scheme: in pairs on the face, from bottom to top. LEDs of the face
/// have another colour in mode B, which is not the real one.
class LightMarkers {
 public:
  /// @param frame_prefix the prefix of the links' frames, such as "left"; may be empty
  explicit LightMarkers(const std::string& frame_prefix);

  /// @return true if markers() has changed; setTouch() returns the same
  bool setLeds(const aibo_driver::LedStates& leds);
  bool setTouch(const aibo_driver::Touch& touch);

  /// All markers, each with its own id. Markers of parts that shine or are touched are added, and the others are
  /// removed. The markers move with their links.
  const visualization_msgs::MarkerArray& markers() const { return markers_; }

 private:
  bool set(const std::string& name, float opacity, bool is_mode_b);

  std::vector<std::string> names_;
  visualization_msgs::MarkerArray markers_;  ///< in the order of the names
};

}  // namespace lights

#endif  // AIBO_DRIVER_TOOLS_LIGHT_MARKERS_H
