/// @file lighting.h
/// How light falls in the scene: one large lamp with soft shadows, and the light that all walls throw back.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHTING_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHTING_H

#include "simulator/ers7/scene/scene.h"
#include "simulator/ers7/scene/surface_colors.h"

namespace simulated_ers7 {

/// How far from its position, in metres, a body changes the light on other surfaces; never less than its own reach.
double lightReach(const Body& body);

/// Light that comes from a place of a surface towards a viewer.
/// @param direction of the viewer's ray, of length 1
Color lightFrom(const Scene& scene, const SceneHit& hit, const Appearance& appearance,
                const Eigen::Vector3d& direction);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_LIGHTING_H
