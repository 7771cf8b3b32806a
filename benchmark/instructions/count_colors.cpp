// Counts the detected colours of a plane as the robot does, to count instructions.
//
//   count_colors PLANE ROUNDS    does so ROUNDS times; PLANE is empty, ball (a disc of 20 pixels, on one channel), or
//                                worst (a chessboard of seven channels); each as of an ERS-7, with the packed plane
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "rcserver/camera/ColorCounter.h"

namespace {

constexpr unsigned kWidth = 104;
constexpr unsigned kHeight = 80;

unsigned char pixelOf(const std::string& plane, int x, int y) {
  if (plane == "worst") {
    return (x + y) % 2 == 0 ? 0x7f : 0;
  }
  const bool is_ball = (x - 52) * (x - 52) + (y - 40) * (y - 40) < 100;
  return plane == "ball" && is_ball ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "count_colors PLANE ROUNDS\n");
    return 2;
  }
  std::vector<unsigned char> pixels;
  for (unsigned i = 0; i < kWidth * kHeight; ++i) {
    pixels.push_back(pixelOf(argv[1], static_cast<int>(i % kWidth), static_cast<int>(i / kWidth)));
  }
  const ColorPlane plane = {pixels.data(), kWidth, kHeight, kWidth};
  std::vector<unsigned char> packed(MAX_PACKED_PLANE_SIZE);
  protocol::version2::ColorRegions regions;
  std::size_t bytes = 0;
  for (int round = std::atoi(argv[2]); round > 0; --round) {
    countColors(plane, 0x7f, &regions);
    bytes = packPlane(plane, packed.data());
  }
  std::printf("%zu bytes\n", bytes);
  return 0;
}
