#include "tools/ball_finder.h"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace aibo_driver::ball {
namespace {

constexpr double kFocalLength = 192.0 / 208.0;  // for the ERS-7's camera, as a multiple of the picture's width

// A patch of detected pixels. The members are its edges in the picture.
struct Patch {
  int left;
  int right;  // the first column beyond the patch
  int top;
  int bottom;
  int pixels = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }

  // True for a patch with the shape of a ball: a disc fills 0.79 of its box, and a ball that touches the bone does not.
  bool isRound() const {
    return width() < 1.5 * height() && height() < 1.5 * width() && pixels > 0.6 * width() * height();
  }
};

// The patches of a mask.
class Patches {
 public:
  explicit Patches(const sensor_msgs::Image& mask)
      : width_(static_cast<int>(mask.width)), height_(static_cast<int>(mask.height)) {
    is_detected_.reserve(mask.width * mask.height);
    for (std::size_t y = 0; y < mask.height; ++y) {
      for (std::size_t x = 0; x < mask.width; ++x) {
        const unsigned char* rgb = &mask.data[y * mask.step + 3 * x];
        is_detected_.push_back(rgb[0] != 0 || rgb[1] != 0 || rgb[2] != 0);
      }
    }
  }

  // Finds the largest round patch.
  std::optional<Patch> findRound() {
    constexpr int kFewestPixels = 7;
    std::optional<Patch> found;
    for (std::size_t place = 0; place < is_detected_.size(); ++place) {
      if (is_detected_[place]) {
        const Patch patch = takePatch(place);
        if (patch.pixels >= kFewestPixels && patch.isRound() && (!found || patch.pixels > found->pixels)) {
          found = patch;
        }
      }
    }
    return found;
  }

 private:
  // Removes and returns the patch that contains this pixel.
  Patch takePatch(std::size_t place) {
    Patch patch{width_, 0, height_, 0};
    std::vector<std::size_t> to_visit;
    const auto visit = [&](int x, int y) {
      const auto next = static_cast<std::size_t>(y * width_ + x);
      if (x >= 0 && x < width_ && y >= 0 && y < height_ && is_detected_[next]) {
        is_detected_[next] = false;
        to_visit.push_back(next);
      }
    };
    visit(static_cast<int>(place) % width_, static_cast<int>(place) / width_);
    while (!to_visit.empty()) {
      const int x = static_cast<int>(to_visit.back()) % width_;
      const int y = static_cast<int>(to_visit.back()) / width_;
      to_visit.pop_back();
      patch.left = std::min(patch.left, x);
      patch.right = std::max(patch.right, x + 1);
      patch.top = std::min(patch.top, y);
      patch.bottom = std::max(patch.bottom, y + 1);
      ++patch.pixels;
      visit(x - 1, y);
      visit(x + 1, y);
      visit(x, y - 1);
      visit(x, y + 1);
    }
    return patch;
  }

  int width_;
  int height_;
  std::vector<bool> is_detected_;
};

}  // namespace

std::optional<Ball> findBall(const sensor_msgs::Image& mask) {
  if (mask.encoding != sensor_msgs::image_encodings::RGB8 || mask.step < 3 * mask.width ||
      mask.data.size() < std::size_t{mask.step} * mask.height) {
    return std::nullopt;
  }
  const std::optional<Patch> patch = Patches(mask).findRound();
  if (!patch) {
    return std::nullopt;
  }
  const double width = mask.width;
  const double height = mask.height;
  const double focal_length = kFocalLength * width;
  return Ball{(width - (patch->left + patch->right)) / (2 * focal_length),
              (height - (patch->top + patch->bottom)) / (2 * focal_length),
              kBallRadius * 2 * focal_length / std::max(patch->width(), patch->height())};
}

}  // namespace aibo_driver::ball
