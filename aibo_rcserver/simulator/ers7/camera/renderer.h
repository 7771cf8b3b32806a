/// @file renderer.h
/// Draws the scene as an ideal camera sees it.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_RENDERER_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_RENDERER_H

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "simulator/ers7/camera/ycrcb_image.h"
#include "simulator/ers7/scene/light.h"
#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {

/// Linear light for each pixel of layer H, row by row from the upper left.
using LightImage = std::vector<Color>;

/// The luminance's fine detail in each pixel, relative to its light: 0 for an even pixel.
using DetailImage = std::vector<FineDetail>;

/// Casts a ray through every pixel, and four rays at the edges of surfaces to smooth them. Where the light on floor and
/// walls hardly changes, only every fourth pixel of every fourth row is calculated. Only the bodies near a pixel are
/// considered.
///
/// While the camera is still, only the surroundings of moving bodies are drawn again. This gives the same picture in a
/// fraction of the time. The class is not thread-safe.
class Renderer {
 public:
  /// @param scene must outlive the renderer
  explicit Renderer(const Scene& scene);

  /// @param camera the camera's pose (head_kinematics.h), inside the room
  /// @return the picture, valid until the next call
  const LightImage& render(const Eigen::Isometry3d& camera);

  /// The fine detail of the last picture. Detail comes from the edges of surfaces.
  const DetailImage& detail() const { return detail_; }

 private:
  /// The surface at the centre of a pixel, used to find edges.
  struct Seen {
    Surface surface;
    Eigen::Vector3d normal;
    Illumination light;

    /// True if a surface with this normal looks like the same face.
    bool isAlso(Surface other_surface, const Eigen::Vector3d& other_normal) const {
      constexpr double kSameFace = 0.8;  // cosine between normals
      return surface == other_surface && normal.dot(other_normal) >= kSameFace;
    }
  };

  /// A part of the picture: columns left..right-1, rows top..bottom-1.
  struct Window {
    int left;
    int top;
    int right;
    int bottom;
  };

  struct Near {
    BodySet visible;
    BodySet changing_light;
  };

  class Eye;

  void findBodies(const Eigen::Isometry3d& camera);
  void draw(const Eigen::Isometry3d& camera, const Window& window);
  void drawBlock(const Eye& eye, int left, int top);
  void smoothEdges(const Eye& eye, const Window& window);
  std::array<Color, 4> lightOfParts(const Eye& eye, int x, int y) const;
  void findEdges(const Window& window);
  static Window united(const Window& one, const Window& other);
  static Window wholeBlocks(const Window& window);
  static Window windowAround(const Eigen::Isometry3d& camera, const Eigen::Vector3d& center, double radius);

  const Scene& scene_;
  LightImage picture_;
  DetailImage detail_;
  std::vector<Seen> seen_;
  std::vector<char> is_edge_;  ///< a neighbouring pixel shows another face
  std::vector<Near> near_;
  std::optional<Eigen::Isometry3d> drawn_from_;   ///< the camera's pose in picture_
  std::vector<Eigen::Vector3d> drawn_positions_;  ///< the scene's bodies in picture_
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_RENDERER_H
