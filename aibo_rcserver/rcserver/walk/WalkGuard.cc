#include "rcserver/walk/WalkGuard.h"

#include <math.h>
#include <stddef.h>

#include <algorithm>

#include "robot_model/robot_model.h"

using protocol::version2::Velocity;
using namespace robot_model;

namespace {

const double FRAME = FRAME_MILLISECONDS * 1e-3;  // s

// Both are from Tekkotsu's kinematic table of the ERS-7. The chest sensor looks down by 30 degrees.
const Point CHEST = {0.109136, 0, -0.003384};
const Point CHEST_LOOKS = {0.866025, 0, -0.5};
const Point NEAR = {0.0769, 0.0028, -0.0146};
const Point FAR = {0.0769, -0.0080, -0.0146};

// A sensor that measures more than this sees nothing (robot_model.h: 0.9, 0.5 and 1.5 m).
const double MOST_CHEST = 0.88;
const double MOST_NEAR = 0.48;
const double MOST_FAR = 1.45;

// At 200 mm/s a walking robot leans by 11 degrees at most (docs/walking.md). So the way to the floor becomes up to 1.5
// times as long, and no shorter than 0.78 times.
const double EDGE_FACTOR = 1.5;
const double OBSTACLE_FACTOR = 0.75;

// How many reports in a row must agree. In 3 reports, at least two measurements of a sensor agree: it measures every 40
// or 48 ms, and reports come every 32 ms.
const int REPORTS = 3;

// The time in s from a change in the room until the legs react to it: 48 ms for the sensor, 96 for the reports, 64 for
// the commands ahead, and 24 for the servos.
const double DELAY = 0.23;

// The time in s that a robot which is told to stop would go on at full speed: the delay, and half of the time that it
// takes to slow down, because it is half as fast on average.
const double TIME_TO_STOP = DELAY + 0.5 / SPEED_CHANGE;

const double HALF_WIDTH = 0.11;  // half of the width of the body with its legs
const double HIGHEST_OBSTACLE = 0.15;
const double LEAST_CLEARANCE = 0.05;
const double NOTHING_AHEAD = 10;
const double LEAST_SPEED = 0.02;  // m/s; a slower robot is stopped

// How far a foot steps from its place, and how far it may step off ground that the robot has walked over.
const double LONGEST_STEP = 0.04;
const double MOST_OFF_GROUND = 0.04;
const double NEAREST_TO_EDGE = 0.05;

// A new pose is remembered after the robot has walked this far, or turned by this much.
const double WAY_BETWEEN_POSES = 0.02;
const double TURN_BETWEEN_POSES = 0.5;
const double WAY_BETWEEN_EDGES = 0.02;

// If the sideways part of a velocity is more than this share of its forward part, no sensor looks where the robot
// walks.
const double MOST_SIDEWAYS = 0.2;

// When a paw touches the floor: the first and the last time, in seconds after its foot is commanded to be there.
const double FIRST_TOUCH = 0.10;
const double LAST_TOUCH = 0.13;

// A paw is believed when it has had the floor under it in this many steps in a row.
const int STEPS_TO_BELIEVE = 4;

const int NO_PAW = -1;

const char NO_FLOOR[] = "the floor ends ahead: turn, or walk back";
const char OBSTACLE[] = "something is in the way ahead: turn, or walk back";
const char KNOWN_EDGE[] = "the floor ends there";
const char UNSEEN[] = "it cannot see there: it walks back and sideways only where it has just walked";
const char* const PAWS_WITHOUT_FLOOR[NUMBER_OF_LEGS] = {"the left front paw finds no floor: go back the way it came",
                                                        "the left hind paw finds no floor: go back the way it came",
                                                        "the right front paw finds no floor: go back the way it came",
                                                        "the right hind paw finds no floor: go back the way it came"};

double Square(double value) {
  return value * value;
}

}  // namespace

const int WalkGuard::MOST_POSES;
const int WalkGuard::MOST_EDGES;
const int WalkGuard::CORNERS;

WalkGuard::WalkGuard(const Gait& gait) : gait_(gait) {
  const Velocity none = {0, 0, 0};
  LegAngles legs[NUMBER_OF_LEGS];
  gait_.FindPosture(0, none, 0, legs);
  const Point front = findFoot(LEFT_FRONT_LEG, legs[LEFT_FRONT_LEG]);
  const Point hind = findFoot(LEFT_HIND_LEG, legs[LEFT_HIND_LEG]);
  front_corner_.x = front.x + LONGEST_STEP;
  front_corner_.y = front.y + FOOT_RADIUS;
  hind_corner_.x = hind.x - LONGEST_STEP;
  hind_corner_.y = hind.y + FOOT_RADIUS;
  Forget();
}

void WalkGuard::Forget() {
  pose_.x = pose_.y = 0;
  pose_.TurnTo(0);
  poses_.Clear();
  edges_.Clear();
  reports_without_floor_ = 0;
  reports_with_obstacle_ = 0;
  paw_without_floor_ = NO_PAW;
  std::fill(paws_, paws_ + NUMBER_OF_LEGS, Paw());
  poses_.Add(pose_);
}

void WalkGuard::HaveWalked(const Velocity& walked, const Velocity& commanded, unsigned frames) {
  const double seconds = FRAME * frames;
  const Place step = {seconds * walked.forward, seconds * walked.left};
  const Place place = Outside(pose_, step);
  pose_.x = place.x;
  pose_.y = place.y;
  pose_.TurnTo(pose_.yaw + seconds * walked.turn);
  const Pose& last = poses_.At(poses_.Size() - 1);
  if (!IsBlind(commanded) && (hypot(pose_.x - last.x, pose_.y - last.y) >= WAY_BETWEEN_POSES ||
                              fabs(pose_.yaw - last.yaw) >= TURN_BETWEEN_POSES)) {
    poses_.Add(pose_);
  }
}

void WalkGuard::Look(const Reading& reading, const LegAngles* legs, double phase, const StepParameters* step) {
  const Floor floor = FloorUnder(legs);
  LookAtFloor(reading.chest, floor);
  LookAhead(reading, floor);
  FeelFloor(reading, legs, phase, step);
}

const char* WalkGuard::Objection(const Velocity& velocity) const {
  if (paw_without_floor_ != NO_PAW) {
    return PAWS_WITHOUT_FLOOR[paw_without_floor_];
  }
  if (velocity.forward > 0 && reports_without_floor_ >= REPORTS) {
    return NO_FLOOR;
  }
  if (velocity.forward > 0 && HighestForward() < LEAST_SPEED) {
    return OBSTACLE;
  }
  const Pose then = After(velocity);
  if (ComesToEdge(then)) {
    return KNOWN_EDGE;
  }
  return IsBlind(velocity) && LeavesGround(then) ? UNSEEN : NULL;
}

// The robot reaches the obstacle only after the delay and the way that it needs to slow down.
double WalkGuard::HighestForward() const {
  if (reports_with_obstacle_ < REPORTS) {
    return NOTHING_AHEAD;
  }
  const double braking = SPEED_CHANGE * gait_.Parameters().highest.forward;
  const double way = obstacle_ - reach_ - LEAST_CLEARANCE;
  return way <= 0 ? 0 : sqrt(Square(braking * DELAY) + 2 * braking * way) - braking * DELAY;
}

// The floor under the lower front and hind foot. Feet in the air are higher, and two diagonal feet are on the floor.
WalkGuard::Floor WalkGuard::FloorUnder(const LegAngles* legs) {
  Point front = {0, 0, 0};
  Point hind = {0, 0, 0};
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    const Leg leg = static_cast<Leg>(i);
    const Point foot = findFoot(leg, legs[i]);
    Point& lowest = isFront(leg) ? front : hind;
    if (foot.z < lowest.z) {
      lowest = foot;
    }
  }
  const double slope = front.x > hind.x ? (front.z - hind.z) / (front.x - hind.x) : 0;
  const Floor floor = {front.z - FOOT_RADIUS - slope * front.x, slope};
  return floor;
}

// The distance of the floor along a ray; NOTHING_AHEAD at most.
double WalkGuard::Floor::AlongRay(const Point& origin, const Point& direction) const {
  const double above = origin.z - height - slope * origin.x;
  const double down = slope * direction.x - direction.z;
  return down * NOTHING_AHEAD > above ? above / down : NOTHING_AHEAD;
}

void WalkGuard::LookAtFloor(double distance, const Floor& floor) {
  const double expected = floor.AlongRay(CHEST, CHEST_LOOKS);
  const double least = EDGE_FACTOR * expected;
  if (distance <= least || least > MOST_CHEST) {
    reports_without_floor_ = 0;
    return;
  }
  ++reports_without_floor_;
  if (reports_without_floor_ >= REPORTS) {
    const Place ahead = {CHEST.x + expected * CHEST_LOOKS.x, 0};
    AddEdge(Outside(pose_, ahead));
  }
}

void WalkGuard::LookAhead(const Reading& reading, const Floor& floor) {
  obstacle_ = NOTHING_AHEAD;
  if (reading.chest > 0 && reading.chest < OBSTACLE_FACTOR * floor.AlongRay(CHEST, CHEST_LOOKS)) {
    obstacle_ = CHEST.x + reading.chest * CHEST_LOOKS.x;
  }
  const Point tip = {NEAR.x + 1, NEAR.y, NEAR.z};
  const Point origin = findInBody(NEAR, reading.head);
  const Point end = findInBody(tip, reading.head);
  const Point looks = {end.x - origin.x, end.y - origin.y, end.z - origin.z};
  const double to_floor = floor.AlongRay(origin, looks);
  if (reading.near < MOST_NEAR) {
    obstacle_ = std::min(obstacle_, WayTo(origin, looks, reading.near, to_floor));
  }
  if (reading.far < MOST_FAR) {
    obstacle_ = std::min(obstacle_, WayTo(findInBody(FAR, reading.head), looks, reading.far, to_floor));
  }
  reach_ = std::max(origin.x, CHEST.x);
  reports_with_obstacle_ = obstacle_ < NOTHING_AHEAD ? reports_with_obstacle_ + 1 : 0;
}

// How far ahead of the shoulders the end of a ray is; NOTHING_AHEAD if it is not in the robot's way.
double WalkGuard::WayTo(const Point& origin, const Point& direction, double distance, double floor) const {
  const double x = origin.x + distance * direction.x;
  const double y = origin.y + distance * direction.y;
  const double z = origin.z + distance * direction.z;
  const bool is_in_way =
      distance > 0 && distance < OBSTACLE_FACTOR * floor && fabs(y) < HALF_WIDTH && z < HIGHEST_OBSTACLE;
  return is_in_way ? x : NOTHING_AHEAD;
}

void WalkGuard::FeelFloor(const Reading& reading, const LegAngles* legs, double phase, const StepParameters* step) {
  if (step == NULL) {
    paw_without_floor_ = NO_PAW;
  }
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    const Leg leg = static_cast<Leg>(i);
    Paw& paw = paws_[i];
    if (step == NULL || !IsLongOnFloor(*step, leg, phase)) {
      paw.steps_felt = paw.has_touched ? paw.steps_felt + 1 : paw.reports_in_air > 0 ? 0 : paw.steps_felt;
      paw.has_touched = false;
      continue;
    }
    paw.has_touched = paw.has_touched || reading.paws[i];
    paw.reports_in_air = paw.has_touched ? 0 : paw.reports_in_air + 1;
    if (paw.reports_in_air == REPORTS && paw.steps_felt >= STEPS_TO_BELIEVE) {
      paw_without_floor_ = i;
      const Point foot = findFoot(leg, legs[i]);
      const Place place = {foot.x, foot.y};
      AddEdge(Outside(pose_, place));
    }
  }
}

// True if the foot has been on the floor for so long that its paw must be pressed.
bool WalkGuard::IsLongOnFloor(const StepParameters& step, Leg leg, double phase) {
  const double first = phase + 1 - FIRST_TOUCH / step.period;
  const double last = phase + 1 - LAST_TOUCH / step.period;
  return Gait::IsOnFloor(step, leg, first - floor(first)) && Gait::IsOnFloor(step, leg, last - floor(last));
}

// True if the robot would walk where no sensor looks, as with each velocity backward.
bool WalkGuard::IsBlind(const Velocity& velocity) {
  return fabs(velocity.left) > MOST_SIDEWAYS * velocity.forward;
}

void WalkGuard::Pose::TurnTo(double angle) {
  yaw = angle;
  cosine = cos(angle);
  sine = sin(angle);
}

// The pose in which the robot stops if it is told to stop now.
WalkGuard::Pose WalkGuard::After(const Velocity& velocity) const {
  const double turn = velocity.turn * TIME_TO_STOP;
  Pose pose = pose_;
  pose.TurnTo(pose_.yaw + turn / 2);
  const Place way = {velocity.forward * TIME_TO_STOP, velocity.left * TIME_TO_STOP};
  const Place place = Outside(pose, way);
  pose.x = place.x;
  pose.y = place.y;
  pose.TurnTo(pose_.yaw + turn);
  return pose;
}

// True if the robot comes to an edge. A robot that is near one may walk away from it.
bool WalkGuard::ComesToEdge(const Pose& then) const {
  for (int i = 0; i < edges_.Size(); ++i) {
    const double way = ToFeet(then, edges_.At(i));
    if (way < NEAREST_TO_EDGE && way < ToFeet(pose_, edges_.At(i))) {
      return true;
    }
  }
  return false;
}

// True if a foot leaves the known ground. A foot that is off this ground may come back.
bool WalkGuard::LeavesGround(const Pose& then) const {
  for (int i = 0; i < CORNERS; ++i) {
    const double off = ToGround(Corner(then, i));
    if (off > MOST_OFF_GROUND && off > ToGround(Corner(pose_, i))) {
      return true;
    }
  }
  return false;
}

// The distance of a place from the nearest spot where the feet have been.
double WalkGuard::ToGround(const Place& place) const {
  double nearest = NOTHING_AHEAD;
  for (int i = 0; i < poses_.Size(); ++i) {
    nearest = std::min(nearest, ToFeet(poses_.At(i), place));
  }
  return nearest;
}

// The distance of a place from the rectangle of the feet; negative inside.
double WalkGuard::ToFeet(const Pose& pose, const Place& place) const {
  const double x = place.x - pose.x;
  const double y = place.y - pose.y;
  const double ahead = x * pose.cosine + y * pose.sine;
  const double off_ahead = std::max(ahead - front_corner_.x, hind_corner_.x - ahead);
  const double off_aside = fabs(y * pose.cosine - x * pose.sine) - front_corner_.y;
  return off_ahead > 0 && off_aside > 0 ? hypot(off_ahead, off_aside) : std::max(off_ahead, off_aside);
}

WalkGuard::Place WalkGuard::Corner(const Pose& pose, int corner) const {
  Place inside = corner < 2 ? front_corner_ : hind_corner_;
  inside.y = corner % 2 == 0 ? inside.y : -inside.y;
  return Outside(pose, inside);
}

// Converts from the body's frame to the frame in which the robot remembers.
WalkGuard::Place WalkGuard::Outside(const Pose& pose, const Place& inside) {
  const Place outside = {pose.x + inside.x * pose.cosine - inside.y * pose.sine,
                         pose.y + inside.x * pose.sine + inside.y * pose.cosine};
  return outside;
}

void WalkGuard::AddEdge(const Place& place) {
  for (int i = 0; i < edges_.Size(); ++i) {
    if (hypot(place.x - edges_.At(i).x, place.y - edges_.At(i).y) < WAY_BETWEEN_EDGES) {
      return;
    }
  }
  edges_.Add(place);
}
