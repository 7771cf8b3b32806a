/// @file light.h
/// How surfaces look, and the light that they send to a viewer. A single large lamp gives soft shadows, and all walls
/// reflect light.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHT_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHT_H

#include <Eigen/Core>

#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {

/// A colour: red, green and blue, linear; 1 is white paper in full light.
using Color = Eigen::Array3d;

struct Appearance {
  Color albedo;      ///< reflected share of the light, 0..1
  double gloss = 0;  ///< strength of the highlight: 0 is cloth, 1 is varnish
};

/// The mean appearance over the area of a pixel. The appearance is integrated, not sampled, so that lines are free of
/// aliasing at any distance.
/// @param footprint size of the pixel along x, y and z of the room, in metres
Appearance appearanceOf(const SceneHit& hit, const Eigen::Vector3d& footprint);

/// Distance up to which a body changes the light on other surfaces, in metres; at least its reach().
double lightReach(const Body& body);

struct Illumination {
  double lamp;      ///< share of the lamp's light, as if straight from above
  double openness;  ///< share of the light from all around
};

/// @param near the bodies that may change the light; others are beyond their lightReach()
Illumination illuminationOf(const Scene& scene, const SceneHit& hit, BodySet near = kAllBodies);

/// The light from a surface to a viewer.
/// @param direction of the viewer's ray, of length 1
Color lightFrom(const SceneHit& hit, const Appearance& appearance, const Illumination& illumination,
                const Eigen::Vector3d& direction);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHT_H
