#include "rcserver/walk/Gait.h"

#include <math.h>

#include <algorithm>

using protocol::version2::Velocity;
using namespace robot_model;

namespace {

const double WHOLE_TURN = 2 * 3.14159265358979323846;

// While the legs move in waves, sideways and turning velocities count this many times more. Found with the bench.
const double OTHERS_IN_WAVES = 2;

// m/s; the range of speeds in which the limits of the trot give way to those of the waves. Our choice.
const double NARROWING = 0.05;

// In s: how much more the feet lag when the body moves to the side than when it moves ahead. In m: how far ahead of the
// middle of the shoulders the movement to the side is measured. Found with the bench: the robot leans the least.
const double LAG_ASIDE = 0.09;
const double TURNS_AHEAD = 0.025;

// The position of a point that accelerates evenly for `easing`, moves on, and slows down evenly for `easing` at the
// end. Positions and times are shares of the whole.
// @param from the speed at both ends
double Eased(double time, double easing, double from) {
  const double top = (1 - easing * from) / (1 - easing);
  const double left = std::min(time, 1 - time);
  const double way = left < easing ? from * left + (top - from) * left * left / (2 * easing)
                                   : (from + top) / 2 * easing + top * (left - easing);
  return time < 0.5 ? way : 1 - way;
}

double Clamped(double share) {
  return std::min(std::max(share, 0.0), 1.0);
}

double Part(double value, double highest) {
  return fabs(value) / highest;
}

// Where a foot is on its line: 0.5 at the front end, -0.5 at the rear end.
// @param time since it has been at the front end, in parts of the period
double PlaceAt(const StepParameters& step, double time) {
  const double with_floor = step.duty + 2 * step.margin;
  time -= floor(time);
  if (time < with_floor) {
    return 0.5 - time / with_floor;
  }
  // The floor moves backward at this speed, in parts of the line and of the time that is left.
  const double speed = -(1 - with_floor) / with_floor;
  return Eased((time - with_floor) / (1 - with_floor), step.easing, speed) - 0.5;
}

// The middle of the foot's line, seen from the middle of the shoulders, with z up.
Point FootMiddle(const StepParameters& step, Leg leg) {
  const double outward = isFront(leg) ? step.front_outward : step.hind_outward;
  Point middle = findShoulder(leg);
  middle.x += isFront(leg) ? step.front_ahead : step.hind_ahead;
  middle.y += isLeft(leg) ? outward : -outward;
  middle.z = FOOT_RADIUS - step.height;
  return middle;
}

double Lift(const StepParameters& step, Leg leg, double part) {
  const double highest = isFront(leg) ? step.front_lift : step.hind_lift;
  return highest * Eased(2 * std::min(part, 1 - part), 2 * step.lift_easing, 0);
}

// @param cosine, sine those of the phase
double WaveAt(const double* factors, double cosine, double sine) {
  double value = factors[0];
  double c = cosine;
  double s = sine;
  for (int i = 1; i < 2 * LegWaves::HARMONICS; i += 2) {
    value += factors[i] * c + factors[i + 1] * s;
    const double next = c * cosine - s * sine;  // of the next multiple of the phase
    s = s * cosine + c * sine;
    c = next;
  }
  return value;
}

// Pointers to all numbers of a step.
double StepParameters::*const NUMBERS[] = {
    &StepParameters::period,        &StepParameters::duty,         &StepParameters::margin,
    &StepParameters::lag,           &StepParameters::height,       &StepParameters::front_lift,
    &StepParameters::hind_lift,     &StepParameters::front_ahead,  &StepParameters::hind_ahead,
    &StepParameters::front_outward, &StepParameters::hind_outward, &StepParameters::nose_down,
    &StepParameters::easing,        &StepParameters::lift_easing};

}  // namespace

// The numbers of a step are in the order of StepParameters, those of the waves in the order of WaveParameters.
GaitParameters::GaitParameters() {
  const StepParameters turning = {0.4279, 0.5032, 0.0161, 0.0280, 0.1171,  0.0143, 0.0150,
                                  0.0210, 0.0033, 0.0208, 0.0245, -0.0197, 0.1100, 0.0260};
  const StepParameters fast = {0.54,   0.5038, 0.0054, 0.0384, 0.1232,  0.0129, 0.0165,
                               0.0105, 0.0045, 0.0161, 0.0117, -0.0725, 0.1314, 0.0458};
  const StepParameters backing = {0.4733, 0.5195, 0.0063, 0.0299, 0.1105, 0.0139, 0.0153,
                                  0.0119, 0.0104, 0.0100, 0.0246, 0.0048, 0.1497, 0.0238};
  const WaveParameters in_waves = {0.546,
                                   0.403,
                                   0.16,
                                   0.33,
                                   0.17,
                                   0.18,
                                   {{{-0.6488, 0.1380, 0.0334, 0.0421, -0.1111, -0.0100, -0.0028, 0.0095, -0.0242},
                                     {0.1181, 0.0664, -0.0025},
                                     {0.9618, 0.3059, -0.1460, -0.0795, -0.0004, -0.0200, -0.0168, -0.0144, 0.0042}}},
                                   {{{0.4670, 0.3297, -0.0495, -0.0158, -0.0406, 0.0095, -0.0235, -0.0015, -0.0208},
                                     {0.1424, -0.0271, -0.0113},
                                     {1.6588, -0.0129, -0.0955, -0.1341, -0.0495, 0.0096, -0.0022, 0.0100, 0.0022}}}};
  in_place = turning;
  forward = fast;
  back = backing;
  waves = in_waves;
  highest.forward = 0.2;
  highest.back = 0.15;
  highest.left = 0.08;
  highest.turn = 1.5;
  fastest = 0.3;
  highest_of_legs.forward = 1.05 * highest.forward;
  highest_of_legs.back = 1.08 * highest.back;
  highest_of_legs.left = 1.14 * highest.left;
  highest_of_legs.turn = 1.06 * highest.turn;
  fastest_of_legs = 1.1 * fastest;
}

Velocity Gait::Shortened(const Velocity& wanted, const protocol::version2::WalkLimits& highest, double fastest) {
  const bool is_back = wanted.forward < 0;
  const double others = Part(wanted.left, highest.left) + Part(wanted.turn, highest.turn);
  const double sum = std::min(Part(wanted.forward, is_back ? highest.back : highest.forward) + others,
                              Part(wanted.forward, is_back ? highest.back : fastest) + OTHERS_IN_WAVES * others);
  const double scale = sum > 1 ? 1 / sum : 1;
  const Velocity limited = {wanted.forward * scale, wanted.left * scale, wanted.turn * scale};
  return limited;
}

Velocity Gait::Narrowed(const Velocity& wanted, double told, const protocol::version2::WalkLimits& highest,
                        double fastest) const {
  const Velocity shortened = Shortened(wanted, highest, fastest);
  const double forward = std::min(wanted.forward, fastest);
  const double others = Part(wanted.left, highest.left) + Part(wanted.turn, highest.turn);
  const double room = std::max(1 - forward / highest.forward, (1 - forward / fastest) / OTHERS_IN_WAVES);
  const double scale = others > room ? room / others : 1;
  // The limits change gradually, because a foot must not jump, and mostly before the waves begin.
  const double share = Clamped((told - parameters_.waves.none) / NARROWING + 0.8);
  const Velocity limited = {shortened.forward + share * (forward - shortened.forward),
                            shortened.left + share * (wanted.left * scale - shortened.left),
                            shortened.turn + share * (wanted.turn * scale - shortened.turn)};
  return limited;
}

StepParameters Gait::StepAt(const Velocity& velocity) const {
  const bool is_back = velocity.forward < 0;
  const StepParameters& other = is_back ? parameters_.back : parameters_.forward;
  const double highest = is_back ? parameters_.highest.back : parameters_.highest.forward;
  const double share = std::min(Part(std::min(velocity.forward, parameters_.waves.none), highest), 1.0);
  const double part = share * share;  // at half of the speed, the numbers for turning are still better
  StepParameters step = parameters_.in_place;
  for (size_t i = 0; i < sizeof(NUMBERS) / sizeof(NUMBERS[0]); ++i) {
    step.*NUMBERS[i] += part * (other.*NUMBERS[i] - step.*NUMBERS[i]);
  }
  step.period += ShareOfWaves(velocity.forward) * (parameters_.waves.period - step.period);
  return step;
}

void Gait::FindPosture(double phase, const Velocity& velocity, double effort, LegAngles* angles,
                       const Point& shift) const {
  const StepParameters step = StepAt(velocity);
  const double with_floor = step.duty + 2 * step.margin;
  const double sine = sin(step.nose_down);
  const double cosine = cos(step.nose_down);
  const double waves = ShareOfWaves(velocity.forward);
  const double shift_ahead = effort * (1 - waves) * shift.x;
  const double shift_left = effort * shift.y - LAG_ASIDE * (velocity.left + TURNS_AHEAD * velocity.turn);
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    const Leg leg = static_cast<Leg>(i);
    const Point middle = FootMiddle(step, leg);
    const double time = LegPhase(leg, phase);
    const double in_air = (time - step.duty) / (1 - step.duty);
    const double lift = in_air >= 0 ? effort * Lift(step, leg, in_air) : 0;
    // The time in seconds that the foot needs from here to the middle of its line at the floor's speed.
    const double ahead = PlaceAt(step, time + step.margin) * with_floor * step.period - step.lag;
    const double aside = velocity.turn * middle.y;
    const Point foot = {middle.x + ahead * (std::min(velocity.forward, parameters_.waves.none) - aside) + shift_ahead,
                        middle.y + ahead * (velocity.left + velocity.turn * middle.x) + shift_left, middle.z + lift};
    const Point in_body = {foot.x * cosine - foot.z * sine, foot.y, foot.x * sine + foot.z * cosine};
    angles[i] = findLegAngles(leg, in_body);
    if (waves > 0) {
      // In a turn, the inner legs make shorter strokes. The share of the waves makes up only half of a stroke.
      AddWaves(leg, phase, effort * std::min(waves * (1 - 2 * aside / velocity.forward), 1.0), &angles[i]);
    }
  }
}

double Gait::UnseenWay(const Velocity& velocity) const {
  const double waves = ShareOfWaves(velocity.forward);
  return parameters_.waves.unseen * waves * waves;
}

double Gait::NoseDown(const Velocity& velocity) const {
  const double waves = ShareOfWaves(velocity.forward);
  return (1 - waves) * StepAt(velocity).nose_down - waves * parameters_.waves.nose_up;
}

double Gait::ShareOfWaves(double forward) const {
  const WaveParameters& waves = parameters_.waves;
  return Clamped((forward - waves.none) / (waves.all - waves.none));
}

void Gait::AddWaves(Leg leg, double phase, double share, LegAngles* angles) const {
  const WaveParameters& waves = parameters_.waves;
  const double angle = WHOLE_TURN * (phase + (isFront(leg) ? 0 : waves.hind_ahead) + (isLeft(leg) ? 0 : 0.5));
  const double cosine = cos(angle);
  const double sine = sin(angle);
  const LegWaves& leg_waves = isFront(leg) ? waves.front : waves.hind;
  angles->rotator += share * (WaveAt(leg_waves.angles[0], cosine, sine) - angles->rotator);
  angles->elevator += share * (WaveAt(leg_waves.angles[1], cosine, sine) - angles->elevator);
  angles->knee += share * (WaveAt(leg_waves.angles[2], cosine, sine) - angles->knee);
}

double Gait::LegPhase(Leg leg, double phase) {
  const bool is_first_pair = leg == LEFT_FRONT_LEG || leg == RIGHT_HIND_LEG;
  const double shifted = is_first_pair ? phase : phase + 0.5;
  return shifted - floor(shifted);
}
