/// @file light.h
/// How the surfaces of the scene look, and the light that they send to a viewer. One large lamp gives soft shadows, and
/// all walls throw light back.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHT_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHT_H

#include <Eigen/Core>

#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {

/// Red, green and blue light; linear, 1 = what white paper in full light sends back.
using Color = Eigen::Array3d;

/// What a place of a surface does with light.
struct Appearance {
  Color albedo;      ///< share of the light that comes back, 0..1
  double gloss = 0;  ///< strength of the highlight, 0 (cloth) .. 1 (varnish)
};

/// How the place that was hit looks, as the mean over what one pixel covers there. That mean is calculated, not
/// sampled: lines stay clean however far away they are.
/// @param footprint how far the pixel reaches along x, y and z of the room, in metres
Appearance appearanceOf(const SceneHit& hit, const Eigen::Vector3d& footprint);

/// How far from its position, in metres, a body changes the light on other surfaces; never less than its own reach.
double lightReach(const Body& body);

/// Light that comes from a place of a surface towards a viewer.
/// @param direction of the viewer's ray, of length 1
Color lightFrom(const Scene& scene, const SceneHit& hit, const Appearance& appearance,
                const Eigen::Vector3d& direction);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHT_H
