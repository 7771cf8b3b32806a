/// @file surface_colors.h
/// How the surfaces of the scene look before light falls on them.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SURFACE_COLORS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SURFACE_COLORS_H

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

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SURFACE_COLORS_H
