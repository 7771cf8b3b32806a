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

/// Linear light per pixel of the H layer, row by row from the upper left.
using LightImage = std::vector<Color>;

/// Fine detail of luminance in a pixel's light, relative to it: 0 where the pixel is even.
using DetailImage = std::vector<FineDetail>;

/// Casts a ray through every pixel, and four rays at the edges of surfaces, to make them smooth. How much light falls
/// on floor and walls is calculated for every fourth pixel of every fourth row where it hardly changes in between, and
/// only the bodies close to a pixel are looked at.
///
/// Keeps the last picture: while the camera rests, only the surroundings of moving bodies are drawn again, which gives
/// the same picture in a fraction of the time. Not thread-safe.
class Renderer {
 public:
  /// @param scene must outlive the renderer
  explicit Renderer(const Scene& scene);

  /// @param camera pose of the camera in the room, as in head_kinematics.h; inside the room
  /// @return the picture, valid until the next call
  const LightImage& render(const Eigen::Isometry3d& camera);

  /// The fine detail of the last picture: of the edges of surfaces, whose parts are drawn one by one.
  const DetailImage& detail() const { return detail_; }

 private:
  /// What the centre of a pixel shows, to find edges.
  struct Seen {
    Surface surface;
    Eigen::Vector3d normal;
    Illumination light;

    /// Whether something else looks like the same face.
    bool isAlso(Surface other_surface, const Eigen::Vector3d& other_normal) const {
      constexpr double kSameFace = 0.8;  // cosine between normals
      return surface == other_surface && normal.dot(other_normal) >= kSameFace;
    }
  };

  /// Pixels left..right-1 in rows top..bottom-1.
  struct Window {
    int left;
    int top;
    int right;
    int bottom;
  };

  /// The bodies that matter to a pixel.
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
  std::vector<char> is_edge_;  ///< whether a pixel next to it shows another face
  std::vector<Near> near_;
  std::optional<Eigen::Isometry3d> drawn_from_;   ///< the camera's pose in picture_
  std::vector<Eigen::Vector3d> drawn_positions_;  ///< of the scene's bodies in picture_
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_RENDERER_H
