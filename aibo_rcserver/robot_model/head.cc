#include "robot_model/head.h"

#include <math.h>

#include <algorithm>

#include "robot_model/robot_model.h"

namespace robot_model {

namespace {

// A place counts as in the middle of the picture if the error is below this angle, a tenth of a pixel.
const double MIDDLE = 0.0005;

// The search for the neck's angle begins with steps of this size, and continues with smaller ones around the best
// angle.
const double FIRST_STEP = 0.005;
const double LAST_STEP = 0.00001;

struct Limits {
  double lowest;
  double highest;

  double Clamp(double angle) const { return std::min(std::max(angle, lowest), highest); }
};

double radian(int microradian) {
  return microradian * 1e-6;
}

Limits limitsOf(const char* joint) {
  const RobotModel& model = *findRobotModel("ERS-7");
  const Joint& found = model.joints[findJointByName(model, joint)];
  const Limits limits = {radian(found.lowest), radian(found.highest)};
  return limits;
}

// They depend on the neck, because the head keeps out of its way. The mouth is closed.
Limits limitsOfTilt(double neck_tilt) {
  const RobotModel& model = *findRobotModel("ERS-7");
  int posture[MAX_JOINTS] = {0};
  posture[findJointByName(model, "neck_tilt")] = static_cast<int>(floor(neck_tilt * 1e6 + 0.5));
  Limits limits = limitsOf("head_tilt");
  limits.lowest = radian(lowestPosition(model, findJointByName(model, "head_tilt"), posture));
  return limits;
}

// A place relative to the point where the head's axes meet. x and z are in the plane of the neck, z along the neck.
Point fromHead(const Point& place, double neck_tilt) {
  const double forward = place.x - NECK_FORWARD;
  const double up = place.z - NECK_UP;
  const Point result = {forward * cos(neck_tilt) + up * sin(neck_tilt), place.y,
                        up * cos(neck_tilt) - forward * sin(neck_tilt) - NECK_LENGTH};
  return result;
}

// The best pan and tilt for this angle of the neck.
HeadAngles aim(const Point& place, double neck_tilt) {
  const Point way = fromHead(place, neck_tilt);
  HeadAngles angles;
  angles.neck_tilt = neck_tilt;
  angles.head_pan = limitsOf("head_pan").Clamp(atan2(way.y, way.x));
  const double ahead = way.x * cos(angles.head_pan) + way.y * sin(angles.head_pan);
  const double distance = std::max(sqrt(ahead * ahead + way.z * way.z), fabs(CAMERA_UP));
  angles.head_tilt = limitsOfTilt(neck_tilt).Clamp(atan2(way.z, ahead) - asin(CAMERA_UP / distance));
  return angles;
}

}  // namespace

Point findInBody(const Point& in_head, const HeadAngles& angles) {
  const double ahead = in_head.x * cos(angles.head_tilt) - in_head.z * sin(angles.head_tilt);
  const double up = in_head.x * sin(angles.head_tilt) + in_head.z * cos(angles.head_tilt) + NECK_LENGTH;
  const double x = ahead * cos(angles.head_pan) - in_head.y * sin(angles.head_pan);
  const Point place = {NECK_FORWARD + x * cos(angles.neck_tilt) - up * sin(angles.neck_tilt),
                       ahead * sin(angles.head_pan) + in_head.y * cos(angles.head_pan),
                       NECK_UP + x * sin(angles.neck_tilt) + up * cos(angles.neck_tilt)};
  return place;
}

double findViewError(const Point& place, const HeadAngles& angles) {
  const Point way = fromHead(place, angles.neck_tilt);
  const double ahead = way.x * cos(angles.head_pan) + way.y * sin(angles.head_pan);
  const double left = way.y * cos(angles.head_pan) - way.x * sin(angles.head_pan);
  const double forward = ahead * cos(angles.head_tilt) + way.z * sin(angles.head_tilt) - CAMERA_FORWARD;
  const double up = way.z * cos(angles.head_tilt) - ahead * sin(angles.head_tilt) - CAMERA_UP;
  return atan2(sqrt(left * left + up * up), forward);
}

double findHeadAngles(const Point& place, HeadAngles* angles) {
  const Limits neck = limitsOf("neck_tilt");
  double error = 4;  // more than any angle
  double from = neck.highest;
  double to = neck.lowest;
  for (double step = FIRST_STEP; step > LAST_STEP && error > MIDDLE; step /= 10) {
    for (double tried = from; tried >= to && error > MIDDLE; tried -= step) {
      const HeadAngles candidate = aim(place, tried);
      const double candidate_error = findViewError(place, candidate);
      if (candidate_error < error) {
        error = candidate_error;
        *angles = candidate;
      }
    }
    from = neck.Clamp(angles->neck_tilt + step);
    to = neck.Clamp(angles->neck_tilt - step);
  }
  return error;
}

}  // namespace robot_model
