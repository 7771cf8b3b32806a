/// @file light.h
/// How the surfaces of the scene look, and the light that they send to a viewer. One large lamp gives soft shadows, and
/// all walls throw light back.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHT_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHT_H

#include <Eigen/Core>

#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {

/// Red, green and blue light; linear, 1 = white paper in full light.
using Color = Eigen::Array3d;

/// The appearance of a point on a surface.
struct Appearance {
  Color albedo;      ///< part of the light that is reflected, 0..1
  double gloss = 0;  ///< strength of the highlight, 0 (cloth) .. 1 (varnish)
};

/// The appearance where a ray hits, as the mean over the area of one pixel. The mean is calculated, not sampled, so
/// lines stay clean at any distance.
/// @param footprint size of the pixel along x, y and z of the room, in metres
Appearance appearanceOf(const SceneHit& hit, const Eigen::Vector3d& footprint);

/// The distance from a body, in metres, up to which it changes the light on other surfaces; at least its reach().
double lightReach(const Body& body);

/// How much light falls on a point of a surface.
struct Illumination {
  double lamp;      ///< part of the lamp's light, as if it came straight from above the surface
  double openness;  ///< part of the light from all around
};

/// @param near bodies that may change the light; others are further away than their lightReach()
Illumination illuminationOf(const Scene& scene, const SceneHit& hit, BodySet near = kAllBodies);

/// The light from a point on a surface towards a viewer.
/// @param direction of the viewer's ray, of length 1
Color lightFrom(const SceneHit& hit, const Appearance& appearance, const Illumination& illumination,
                const Eigen::Vector3d& direction);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHT_H
