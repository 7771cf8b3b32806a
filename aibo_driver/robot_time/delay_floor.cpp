#include "robot_time/delay_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace aibo_driver::robot_time {

void DelayFloor::add(double sent, double lateness) {
  const auto second = static_cast<std::int64_t>(std::floor(sent));
  const auto inserted = earliest_.insert({second, Point{sent, lateness}});
  Point& earliest = inserted.first->second;
  if (!inserted.second && lateness >= earliest.lateness) {
    return;
  }
  earliest = {sent, lateness};
  const std::int64_t newest = earliest_.rbegin()->first;
  earliest_.erase(earliest_.begin(), earliest_.lower_bound(newest - static_cast<std::int64_t>(kWindow)));
  fit();
}

void DelayFloor::fit() {
  double sum = 0;
  for (const auto& entry : earliest_) {
    sum += entry.second.sent;
  }
  origin_sent_ = sum / static_cast<double>(earliest_.size());
  drift_ = std::clamp(driftThrough(origin_sent_), -kHighestDrift, kHighestDrift);
  origin_ = std::numeric_limits<double>::max();
  for (const auto& entry : earliest_) {
    origin_ = std::min(origin_, entry.second.lateness - drift_ * (entry.second.sent - origin_sent_));
  }
}

// The slope of the lower convex hull's edge over the middle. Of all lines below the points, the line along this edge
// has the least sum of distances to them. A single point has no slope, so the drift does not change.
double DelayFloor::driftThrough(double middle) const {
  std::vector<Point> hull;
  const auto slope = [](const Point& from, const Point& to) {
    return (to.lateness - from.lateness) / (to.sent - from.sent);
  };
  for (const auto& entry : earliest_) {
    const Point& point = entry.second;
    while (hull.size() >= 2 && slope(hull[hull.size() - 2], hull.back()) >= slope(hull.back(), point)) {
      hull.pop_back();
    }
    hull.push_back(point);
  }
  for (std::size_t i = 1; i < hull.size(); ++i) {
    if (hull[i].sent >= middle) {
      return slope(hull[i - 1], hull[i]);
    }
  }
  return drift_;
}

}  // namespace aibo_driver::robot_time
