#include "simulator/ers7/scene/light.h"

#include <algorithm>
#include <cmath>

#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;

// The direction from the centre of the carpet to the lamp, which is above, to the left of and behind the robot.
const Vector3d kToLamp = Vector3d(-0.42, 0.50, 0.76).normalized();
const Color kLampLight(0.96, 0.91, 0.82);
// Ambient light: cool from above, warm and weak from the floor.
const Color kLightFromAbove(0.56, 0.58, 0.62);
const Color kLightFromBelow(0.34, 0.35, 0.30);

/// Tangent of half the lamp's visual angle, which makes shadows soft.
constexpr double kLampSize = 0.16;

/// The share of the lamp's light that passes `body`, from the ray's closest approach in penumbra widths.
double lampBeside(const Body& body, const Vector3d& point) {
  constexpr double kShortestStep = 0.006;
  const Vector3d to_body = body.position() - point;
  const double along = to_body.dot(kToLamp);
  const double reach = body.reach() + kLampSize * std::max(along, 0.0);
  if ((to_body - along * kToLamp).squaredNorm() > reach * reach) {
    return 1;
  }
  const double end = std::min(along + reach, (body.top() - point.z()) / kToLamp.z() + kLampSize * body.reach());
  const Vector3d start = body.pointToBody(point);
  const Vector3d to_lamp = body.turnToBody(kToLamp);
  double clearance = 1;
  double travelled = std::max(kShortestStep, along - reach);
  while (travelled < end && clearance > -1) {
    const double distance = body.distanceInBody(start + travelled * to_lamp);
    clearance = std::min(clearance, distance / (kLampSize * travelled));
    travelled += std::max(distance, kShortestStep);
  }
  const double share = std::clamp((clearance + 1) / 2, 0.0, 1.0);
  return share * share * (3 - 2 * share);
}

/// The share of ambient light that passes `body`; this darkens places where things touch. The function samples points
/// along the normal, and compares their distances to the body and the surface.
double opennessBeside(const Body& body, const Vector3d& point, const Vector3d& normal) {
  constexpr double kSteps[] = {0.010, 0.022, 0.045};
  constexpr double kFarthest = 2 * 0.045;
  const double outer = body.reach() + kFarthest;
  if ((body.position() - point).squaredNorm() > outer * outer) {
    return 1;
  }
  const Vector3d start = body.pointToBody(point);
  if (body.distanceInBody(start) > kFarthest) {
    return 1;
  }
  const Vector3d outwards = body.turnToBody(normal);
  double hidden = 0;
  for (const double step : kSteps) {
    const double distance = body.distanceInBody(start + step * outwards);
    hidden += std::clamp((step - distance) / step, 0.0, 1.0) / 3;
  }
  return 1 - 0.85 * hidden;
}

/// The share of ambient light that floor and walls let through. Corners are darker.
double opennessOfRoom(const Vector3d& point, const Vector3d& normal) {
  constexpr double kDepth = 0.45;
  constexpr double kFalloff = 0.08;
  double openness = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = point[axis] - kLowestCorner[axis];
    const double above = kHighestCorner[axis] - point[axis];
    const double nearness = kDepth * kFalloff / (kFalloff + std::min(below, above));
    openness *= 1 - nearness * (1 - std::abs(normal[axis]));
  }
  return openness;
}

double highlight(const Vector3d& normal, const Vector3d& direction) {
  const Vector3d mirrored = direction - 2 * direction.dot(normal) * normal;
  const double shine = std::max(0.0, mirrored.dot(kToLamp));
  const double shine_4 = shine * shine * shine * shine;
  const double shine_16 = shine_4 * shine_4 * shine_4 * shine_4;
  return shine_16 * shine_16;
}

}  // namespace

double lightReach(const Body& body) {
  constexpr double kLengthOfShadow = 2.6;  // a multiple of reach(); farther shadows are invisible
  return kLengthOfShadow * body.reach();
}

Illumination illuminationOf(const Scene& scene, const SceneHit& hit, BodySet near) {
  Illumination light = {std::max(0.0, hit.normal.dot(kToLamp)), opennessOfRoom(hit.point, hit.normal)};
  for (std::size_t i = 0; near >> i != 0 && i < scene.bodies().size(); ++i) {
    if ((near >> i & 1) == 0) {
      continue;
    }
    const Body& body = scene.bodies()[i];
    const double far = lightReach(body);
    if ((body.position() - hit.point).squaredNorm() > far * far) {
      continue;
    }
    if (light.lamp > 0) {
      light.lamp *= lampBeside(body, hit.point + 0.002 * hit.normal);
    }
    light.openness *= opennessBeside(body, hit.point, hit.normal);
  }
  return light;
}

Color lightFrom(const SceneHit& hit, const Appearance& appearance, const Illumination& illumination,
                const Vector3d& direction) {
  const double upwards = 0.5 + 0.5 * hit.normal.z();
  const Color ambient = illumination.openness * (upwards * kLightFromAbove + (1 - upwards) * kLightFromBelow);
  Color light = appearance.albedo * (ambient + illumination.lamp * kLampLight);
  if (appearance.gloss > 0) {
    light += appearance.gloss * illumination.lamp * highlight(hit.normal, direction) * kLampLight;
  }
  return light;
}

}  // namespace simulated_ers7
