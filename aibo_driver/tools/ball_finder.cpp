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

// The detected pixels of a mask.
std::vector<bool> pixelsOf(const sensor_msgs::Image& mask) {
  std::vector<bool> detected;
  detected.reserve(mask.width * mask.height);
  for (std::size_t y = 0; y < mask.height; ++y) {
    for (std::size_t x = 0; x < mask.width; ++x) {
      const unsigned char* rgb = &mask.data[y * mask.step + 3 * x];
      detected.push_back(rgb[0] != 0 || rgb[1] != 0 || rgb[2] != 0);
    }
  }
  return detected;
}

// Removes and returns the patch that contains a pixel.
Patch takePatch(std::vector<bool>& detected, int width, std::size_t place) {
  const int height = static_cast<int>(detected.size()) / width;
  Patch patch{width, 0, height, 0};
  std::vector<std::size_t> to_visit;
  const auto visit = [&](int x, int y) {
    const auto next = static_cast<std::size_t>(y * width + x);
    if (x >= 0 && x < width && y >= 0 && y < height && detected[next]) {
      detected[next] = false;
      to_visit.push_back(next);
    }
  };
  visit(static_cast<int>(place) % width, static_cast<int>(place) / width);
  while (!to_visit.empty()) {
    const int x = static_cast<int>(to_visit.back()) % width;
    const int y = static_cast<int>(to_visit.back()) / width;
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

// Finds the largest round patch.
std::optional<Patch> findRound(std::vector<bool> detected, int width) {
  constexpr int kFewestPixels = 7;
  std::optional<Patch> found;
  for (std::size_t place = 0; place < detected.size(); ++place) {
    if (detected[place]) {
      const Patch patch = takePatch(detected, width, place);
      if (patch.pixels >= kFewestPixels && patch.isRound() && (!found || patch.pixels > found->pixels)) {
        found = patch;
      }
    }
  }
  return found;
}

}  // namespace

std::optional<Ball> findBall(const sensor_msgs::Image& mask) {
  if (mask.encoding != sensor_msgs::image_encodings::RGB8 || mask.step < 3 * mask.width ||
      mask.data.size() < std::size_t{mask.step} * mask.height) {
    return std::nullopt;
  }
  const std::optional<Patch> patch = findRound(pixelsOf(mask), static_cast<int>(mask.width));
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
