#include "tools/light_markers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lights {
namespace {

using visualization_msgs::Marker;

struct Color {
  float red;
  float green;
  float blue;
};

constexpr Color kWhite{1.0F, 1.0F, 0.95F};
constexpr Color kRed{1.0F, 0.1F, 0.1F};
constexpr Color kGreen{0.2F, 1.0F, 0.3F};
constexpr Color kBlue{0.2F, 0.5F, 1.0F};
constexpr Color kOrange{1.0F, 0.6F, 0.1F};
constexpr Color kTouched{0.7F, 1.0F, 0.0F};
constexpr Color kModeB{1.0F, 0.35F, 0.75F};

// The faintest marker, because every LED that shines at all must be visible.
constexpr float kFaintest = 0.3F;
constexpr float kTouchOpacity = 0.7F;

// A box, in metres. It covers a part of the model to show that this part shines or is touched.
struct Place {
  const char* name;
  const char* link;
  double x, y, z;  // the box's centre, in the link
  double length, width, height;
  int shape;
  Color color;
};

// The parts in urdf/ers7.urdf: the strips of light on the back, the pads with the touch sensors, the chin and the feet.
// Beside each strip is its white LED.
const Place kPlaces[] = {
    {"back_front_color", "base_link", 0.030, 0, 0.0475, 0.006, 0.016, 0.005, Marker::CUBE, kBlue},
    {"back_front_white", "base_link", 0.038, 0, 0.0470, 0.005, 0.016, 0.004, Marker::CUBE, kWhite},
    {"back_middle_color", "base_link", -0.004, 0, 0.0470, 0.006, 0.016, 0.005, Marker::CUBE, kOrange},
    {"back_middle_white", "base_link", 0.004, 0, 0.0465, 0.005, 0.016, 0.004, Marker::CUBE, kWhite},
    {"back_rear_color", "base_link", -0.038, 0, 0.0470, 0.006, 0.016, 0.005, Marker::CUBE, kRed},
    {"back_rear_white", "base_link", -0.030, 0, 0.0465, 0.005, 0.016, 0.004, Marker::CUBE, kWhite},
    {"head_color", "head_tilt_link", 0.001, 0, 0.0570, 0.006, 0.009, 0.004, Marker::CUBE, kOrange},
    {"head_white", "head_tilt_link", -0.006, 0, 0.0570, 0.005, 0.009, 0.004, Marker::CUBE, kWhite},
    {"mode_red", "head_tilt_link", -0.036, 0.010, 0.0470, 0.008, 0.008, 0.008, Marker::SPHERE, kRed},
    {"mode_green", "head_tilt_link", -0.036, 0, 0.0470, 0.008, 0.008, 0.008, Marker::SPHERE, kGreen},
    {"mode_blue", "head_tilt_link", -0.036, -0.010, 0.0470, 0.008, 0.008, 0.008, Marker::SPHERE, kBlue},
    {"wireless", "head_tilt_link", -0.047, 0, 0.0300, 0.008, 0.008, 0.008, Marker::SPHERE, kBlue},
    {"touch back_front", "base_link", 0.030, 0, 0.0450, 0.032, 0.028, 0.006, Marker::CUBE, kTouched},
    {"touch back_middle", "base_link", -0.004, 0, 0.0445, 0.032, 0.028, 0.006, Marker::CUBE, kTouched},
    {"touch back_rear", "base_link", -0.038, 0, 0.0445, 0.032, 0.028, 0.006, Marker::CUBE, kTouched},
    {"touch head", "head_tilt_link", -0.002, 0, 0.0550, 0.024, 0.014, 0.006, Marker::CUBE, kTouched},
    {"touch chin", "mouth_link", 0.020, 0, -0.0130, 0.040, 0.028, 0.006, Marker::CUBE, kTouched},
    {"touch paw_left_front", "left_front_foot_link", 0, 0, 0, 0.032, 0.032, 0.032, Marker::SPHERE, kTouched},
    {"touch paw_left_hind", "left_hind_foot_link", 0, 0, 0, 0.032, 0.032, 0.032, Marker::SPHERE, kTouched},
    {"touch paw_right_front", "right_front_foot_link", 0, 0, 0, 0.032, 0.032, 0.032, Marker::SPHERE, kTouched},
    {"touch paw_right_hind", "right_hind_foot_link", 0, 0, 0, 0.032, 0.032, 0.032, Marker::SPHERE, kTouched},
};

// Where an LED of the face is, seen from the middle of the dark ball, in degrees to the left and upwards.
struct FacePlace {
  int number;
  double left;
  double up;
};

constexpr FacePlace kFace[] = {{1, 68, 2},   {2, -68, 2}, {3, 62, 22},  {4, -62, 22}, {5, 34, 32},
                               {6, -34, 32}, {7, 58, 44}, {8, -58, 44}, {9, 26, 54},  {10, -26, 54},
                               {11, 0, 72},  {12, 0, 42}, {13, 50, 66}, {14, -50, 66}};

void paint(Marker& marker, const Color& color) {
  marker.color.r = color.red;
  marker.color.g = color.green;
  marker.color.b = color.blue;
}

Marker makeMarker(const Place& place, const std::string& frame_prefix) {
  Marker marker;
  marker.header.frame_id = frame_prefix.empty() ? place.link : frame_prefix + "/" + place.link;
  marker.ns = "lights";
  marker.type = place.shape;
  marker.action = Marker::DELETE;
  marker.frame_locked = 1u;
  marker.pose.position.x = place.x;
  marker.pose.position.y = place.y;
  marker.pose.position.z = place.z;
  marker.pose.orientation.w = 1;
  marker.scale.x = place.length;
  marker.scale.y = place.width;
  marker.scale.z = place.height;
  paint(marker, place.color);
  return marker;
}

// A place on the surface of the ball, whose centre is in the middle between the two centres in the model.
Place onFace(const FacePlace& place) {
  constexpr double kRadius = 0.0355;
  constexpr double kSize = 0.009;
  constexpr double kDegree = M_PI / 180;
  const double ahead = kRadius * std::cos(place.up * kDegree);
  const double y = ahead * std::sin(place.left * kDegree);
  return {"",
          "head_tilt_link",
          0.031 + ahead * std::cos(place.left * kDegree),
          y + std::copysign(std::min(std::abs(y), 0.005), y),
          0.009 + kRadius * std::sin(place.up * kDegree),
          kSize,
          kSize,
          kSize,
          Marker::SPHERE,
          kWhite};
}

}  // namespace

LightMarkers::LightMarkers(const std::string& frame_prefix) {
  const auto add = [this, &frame_prefix](const std::string& name, const Place& place) {
    Marker marker = makeMarker(place, frame_prefix);
    marker.id = static_cast<int>(names_.size());
    names_.push_back(name);
    markers_.markers.push_back(marker);
  };
  for (const Place& place : kPlaces) {
    add(place.name, place);
  }
  for (const FacePlace& place : kFace) {
    add("face_" + std::to_string(place.number), onFace(place));
  }
}

bool LightMarkers::setLeds(const aibo_driver::LedStates& leds) {
  bool has_changed = false;
  const std::size_t count = std::min({leds.names.size(), leds.intensities.size(), leds.modes.size()});
  for (std::size_t i = 0; i < count; ++i) {
    // This comparison is false for NaN, which means unknown.
    const bool shines = leds.intensities[i] > 0;
    const float opacity = shines ? kFaintest + (1 - kFaintest) * std::min(leds.intensities[i], 1.0F) : 0;
    has_changed |= set(leds.names[i], opacity, leds.modes[i] == aibo_driver::LedStates::MODE_B);
  }
  return has_changed;
}

bool LightMarkers::setTouch(const aibo_driver::Touch& touch) {
  bool has_changed = false;
  const auto set_pressed = [this, &has_changed](const std::string& name, bool is_pressed) {
    has_changed |= set("touch " + name, is_pressed ? kTouchOpacity : 0, false);
  };
  set_pressed("back_front", touch.back_front != 0);
  set_pressed("back_middle", touch.back_middle != 0);
  set_pressed("back_rear", touch.back_rear != 0);
  set_pressed("head", touch.head != 0);
  set_pressed("chin", touch.chin != 0);
  set_pressed("paw_left_front", touch.paw_left_front != 0);
  set_pressed("paw_left_hind", touch.paw_left_hind != 0);
  set_pressed("paw_right_front", touch.paw_right_front != 0);
  set_pressed("paw_right_hind", touch.paw_right_hind != 0);
  return has_changed;
}

// Only LEDs of the face have a mode B.
bool LightMarkers::set(const std::string& name, float opacity, bool is_mode_b) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) {
    return false;
  }
  Marker& marker = markers_.markers[static_cast<std::size_t>(found - names_.begin())];
  const Marker before = marker;
  marker.action = opacity > 0 ? Marker::ADD : Marker::DELETE;
  marker.color.a = opacity;
  if (opacity > 0 && name.rfind("face_", 0) == 0) {
    paint(marker, is_mode_b ? kModeB : kWhite);
  }
  return marker.action != before.action || marker.color != before.color;
}

}  // namespace lights
