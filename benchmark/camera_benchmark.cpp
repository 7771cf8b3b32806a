// The time that the simulated camera takes for a picture of its room.
#include <benchmark/benchmark.h>

#include <cmath>

#include "simulator/ers7/camera/scene_view.h"

using namespace simulated_ers7;

namespace {

constexpr double kSecondsPerPicture = 0.03347;

/// A robot that stands and looks at the rolling ball.
void headStill(benchmark::State& state) {
  Scene scene;
  SceneView view(scene, 1);
  longword image = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(view.picture({}, image * kSecondsPerPicture, image, {}));
    ++image;
  }
}
BENCHMARK(headStill)->Unit(benchmark::kMillisecond);

/// A robot that turns its head a little, so that everything that it sees at first moves in every picture.
void headMoving(benchmark::State& state) {
  Scene scene;
  SceneView view(scene, 1);
  longword image = 0;
  for (auto _ : state) {
    const double seconds = image * kSecondsPerPicture;
    CameraPose pose;
    pose.head.head_pan = 0.2 * std::sin(2 * seconds);
    benchmark::DoNotOptimize(view.picture(pose, seconds, image, {}));
    ++image;
  }
}
BENCHMARK(headMoving)->Unit(benchmark::kMillisecond);

/// A robot that walks up to the ball and back again.
void walking(benchmark::State& state) {
  Scene scene;
  SceneView view(scene, 1);
  longword image = 0;
  for (auto _ : state) {
    const double seconds = image * kSecondsPerPicture;
    CameraPose pose;
    pose.body = Eigen::Translation3d(0.3 - 0.3 * std::cos(0.5 * seconds), 0.1 * std::sin(0.3 * seconds),
                                     kStandingHeight + 0.003 * std::sin(15 * seconds)) *
                Eigen::AngleAxisd(0.2 * std::sin(0.4 * seconds), Eigen::Vector3d::UnitZ());
    benchmark::DoNotOptimize(view.picture(pose, seconds, image, {}));
    ++image;
  }
}
BENCHMARK(walking)->Unit(benchmark::kMillisecond)->MinTime(4);

}  // namespace

BENCHMARK_MAIN();
