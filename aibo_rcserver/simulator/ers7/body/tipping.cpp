#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/ers7/body/stance.h"

namespace simulated_ers7 {
namespace {

using Eigen::Vector2d;

/// Finds the slope with the least cost: the weight's height above the floor, plus the square of the change of slope
/// divided by 2 * reach. This is an implicit integration step, so it neither overshoots nor oscillates.
///
/// The height is the greatest of several linear functions of the slope, one for each support. So at the least cost,
/// one, two or three supports touch the floor, and these determine the slope.
class LeastCost {
 public:
  LeastCost(const Supports& supports, const Vector2d& weight, const Vector2d& before, double reach)
      : before_(before), reach_(reach), best_slope_(before) {
    for (std::size_t i = 0; i < supports.size(); ++i) {
      lever_[i] = supports[i].head<2>() - weight;
      height_[i] = -supports[i].z();
    }
    for (std::size_t i = 0; i < supports.size(); ++i) {
      consider(before_ - reach_ * lever_[i]);
      for (std::size_t j = i + 1; j < supports.size(); ++j) {
        considerBoth(i, j);
        for (std::size_t k = j + 1; k < supports.size(); ++k) {
          considerAll(i, j, k);
        }
      }
    }
  }

  const Vector2d& slope() const { return best_slope_; }

 private:
  void considerBoth(std::size_t i, std::size_t j) {
    const Vector2d lever = lever_[j] - lever_[i];
    const double length = lever.squaredNorm();
    if (length > 0) {
      const Vector2d slope = before_ - reach_ * lever_[i];
      const double share = (height_[j] - height_[i] + lever.dot(slope)) / (reach_ * length);
      consider(slope - reach_ * std::clamp(share, 0.0, 1.0) * lever);
    }
  }

  void considerAll(std::size_t i, std::size_t j, std::size_t k) {
    constexpr double kInLine = 1e-9;
    Eigen::Matrix2d levers;
    levers << (lever_[j] - lever_[i]).transpose(), (lever_[k] - lever_[i]).transpose();
    if (std::abs(levers.determinant()) > kInLine) {
      consider(levers.inverse() * Vector2d(height_[i] - height_[j], height_[i] - height_[k]));
    }
  }

  void consider(const Vector2d& slope) {
    double height = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < lever_.size(); ++i) {
      height = std::max(height, height_[i] + lever_[i].dot(slope));
    }
    const double cost = height + (slope - before_).squaredNorm() / (2 * reach_);
    if (cost < least_) {
      least_ = cost;
      best_slope_ = slope;
    }
  }

  Vector2d before_;
  double reach_;
  std::array<Vector2d, 2 * kLegs> lever_;
  std::array<double, 2 * kLegs> height_;
  double least_ = std::numeric_limits<double>::infinity();
  Vector2d best_slope_;
};

}  // namespace

Floor tip(const Supports& supports, const Rest& rest, const Vector2d& slope, double seconds) {
  return floorUnder(supports, LeastCost(supports, rest.weight, slope, kTippingSpeed * seconds).slope());
}

}  // namespace simulated_ers7
