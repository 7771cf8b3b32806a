/// @file robot_model.h
/// An Aibo in numbers: joints with their limits, postures in which parts of the body would collide, sensors, LEDs and
/// ears. C++98, no I/O.
///
/// Angles are whole microradians, as in OPEN-R; `int` has 32 bits on both sides. The signs are Sony's. At zero, the
/// legs point straight down. Positive is up for head and tail, left for pan, forward for rotators, away from the body
/// for elevators, and bent for knees (Model Information ERS-7, section 2.1).
#ifndef AIBO_RCSERVER_ROBOT_MODEL_ROBOT_MODEL_H
#define AIBO_RCSERVER_ROBOT_MODEL_ROBOT_MODEL_H

namespace robot_model {

/// The length of OPEN-R's frame: the ERS-7 and the ERS-210 take a joint value every 8 ms (Sony's OPEN-R programmer's
/// guide).
const int FRAME_MILLISECONDS = 8;

/// The largest numbers of parts of any robot, for arrays of a fixed size.
const int MAX_JOINTS = 18;
const int MAX_SENSORS = 18;
const int MAX_LEDS = 26;
const int MAX_EARS = 2;

/// What the find functions return if they find nothing.
const int NO_JOINT = -1;
const int NO_SENSOR = -1;
const int NO_LED = -1;
const int NO_EAR = -1;

/// A servo's gains, in the order of OPENR::SetJointGain().
struct PidGains {
  unsigned short proportional;
  unsigned short integral;
  unsigned short derivative;
  unsigned short proportional_shift;
  unsigned short integral_shift;
  unsigned short derivative_shift;
};

/// One servo. In the comments, "MI" is Sony's Model Information ERS-7 or ERS-210.
struct Joint {
  const char* name;          ///< in ROS: lower case with underscores
  unsigned char identifier;  ///< in the protocol; docs/protocol.md lists the identifiers
  const char* locator;       ///< for OPENR::OpenPrimitive() (MI)

  /// The range of allowed targets, in microradians (MI, software limits; section 2.1.1 for the ERS-7). The ERS-7's J1
  /// differs between front and rear legs (section 2.1.2, drawing in 1.2). The rows of 2.1.1 suggest that it differs
  /// between left and right legs, but it does not. The ERS-7's hind knees bend 3 degrees further than that (ers7.cc).
  int lowest;
  int highest;

  /// The range in which somebody can move the joint by hand, in microradians (MI, drawing in section 1.2).
  int mechanical_lowest;
  int mechanical_highest;

  /// In microradians/s. The ERS-7's figures are Sony's, in Tekkotsu's ERS7Info.h. The ERS-210's are from Sony's FAQ,
  /// quoted in Tekkotsu's JointSpeedLimits.txt.
  int highest_speed;

  PidGains gains;  ///< standard gains of the ERS-7 (MI); those of the ERS-210 in Tekkotsu's ERS210Info.h
};

/// The default acceleration of a joint, in microradians/s^2.
///
/// No source gives a figure. With our choice, a joint reaches its highest speed in 100 ms, 12.5 frames of 8 ms. This
/// protects the gears from jumps of the target, and is enough for walking: swinging a leg by 0.3 rad to each side 1.5
/// times a second takes 27 rad/s^2, and an ERS-7's rotator gets 48.7.
int defaultAcceleration(const Joint& joint);

/// While the leader is between `from` and `to`, the follower must not go below `lowest`. All are in microradians.
struct CouplingRow {
  int from;
  int to;  ///< not below `from`
  int lowest;
};

/// A joint (the follower) that must keep out of the way of another one (the leader).
///
/// The rows are Sony's, in ascending order. Some overlap, and some leave gaps of a degree; see coupledLowest().
/// `lowest` first falls and then rises, so the follower is never restricted more between two positions of the leader
/// than at one of them. So every allowed posture can be reached from any other.
struct Coupling {
  int leader;    ///< index of the leader
  int follower;  ///< index of the follower, which is never a leader itself
  const CouplingRow* rows;
  int number_of_rows;
};

/// What a sensor measures, and OPEN-R's unit.
enum SensorKind {
  SENSOR_DISTANCE,      ///< infrared, in micrometres
  SENSOR_ACCELERATION,  ///< in micrometres/s^2
  SENSOR_FORCE,         ///< in micronewtons
  SENSOR_TEMPERATURE,   ///< in millionths of a degree Celsius
  SENSOR_CHARGE,        ///< the battery's charge, in millionths of its capacity
  SENSOR_TOUCH,         ///< electrostatic; a strength without a unit
  SENSOR_SWITCH         ///< 0 or 1
};

/// One sensor with a numeric value. The camera and the microphones are not sensors of this kind.
struct Sensor {
  const char* name;          ///< in ROS and on the simulated robot's console: lower case with underscores
  unsigned char identifier;  ///< in the protocol, which lists them (docs/protocol.md); no joint has the same one

  /// For OPENR::OpenPrimitive() (MI). Null for the charge and temperature of an ERS-7's battery, which come from
  /// OPENR::GetPowerStatus().
  const char* locator;

  SensorKind kind;

  /// The measuring range (MI). Both ends are 0 if Sony gives no range.
  int lowest;
  int highest;

  /// The sensor is pressed from `on` up, and released below `off` (isPressed()). Both are 0 if it cannot be pressed or
  /// Sony gives no figure. The ERS-7's figures are the levels of its electrostatic sensors in MI.
  int on;
  int off;
};

/// True if a switch or touch sensor is pressed, with Sony's hysteresis.
/// @param value the strength of a touch; 0 or 1 for a switch
/// @param was_pressed the previous result; false at first
bool isPressed(const Sensor& sensor, double value, bool was_pressed);

/// OPEN-R's kinds of LEDs.
enum LedKind {
  LED2,  ///< the LED is on or off
  LED3   ///< intensity 0 to 255, mode A or B
};

enum LedPlace { LED_ON_HEAD, LED_ON_FACE, LED_ON_BACK, LED_ON_TAIL };

struct Led {
  const char* name;          ///< in ROS: lower case with underscores
  unsigned char identifier;  ///< in the protocol, unique among LEDs; docs/protocol.md lists the identifiers
  const char* locator;       ///< for OPENR::OpenPrimitive() (MI); it ends with Sony's name of the LED
  LedKind kind;
  LedPlace place;
};

/// OPEN-R's command that moves an ear: JOINT_COMMAND3 or JOINT_COMMAND4.
enum EarKind { EAR_JOINT3, EAR_JOINT4 };

/// An ear. A magnet draws it or lets it go. The magnet must not stay energised (MI).
struct Ear {
  const char* name;          ///< "left_ear", "right_ear"
  unsigned char identifier;  ///< in the protocol: 1 is left, 2 is right
  const char* locator;       ///< for OPENR::OpenPrimitive() (MI)
  EarKind kind;
};

struct RobotModel {
  const char* design;  ///< from OPENR::GetRobotDesign(): "ERS-7", "ERS-210"
  const Joint* joints;
  int number_of_joints;
  const Coupling* couplings;
  int number_of_couplings;
  const Sensor* sensors;  ///< in ascending order of identifiers, like LEDs and ears
  int number_of_sensors;
  const Led* leds;
  int number_of_leds;
  const Ear* ears;
  int number_of_ears;
  int number_of_color_channels;  ///< the channels of the camera's colour detection are 0..number - 1
};

/// The model of a design; null if there is no such robot.
const RobotModel* findRobotModel(const char* design);

/// Returns an index into RobotModel::joints, or NO_JOINT.
int findJointByIdentifier(const RobotModel& model, int identifier);
int findJointByName(const RobotModel& model, const char* name);
int findJointByLocator(const RobotModel& model, const char* locator);

/// Returns an index into RobotModel::sensors, or NO_SENSOR.
int findSensorByIdentifier(const RobotModel& model, int identifier);
int findSensorByName(const RobotModel& model, const char* name);
int findSensorByLocator(const RobotModel& model, const char* locator);

/// Returns an index into RobotModel::leds, or NO_LED.
int findLedByIdentifier(const RobotModel& model, int identifier);
int findLedByName(const RobotModel& model, const char* name);
int findLedByLocator(const RobotModel& model, const char* locator);

/// Returns an index into RobotModel::ears, or NO_EAR.
int findEarByIdentifier(const RobotModel& model, int identifier);
int findEarByName(const RobotModel& model, const char* name);
int findEarByLocator(const RobotModel& model, const char* locator);

/// The follower's lower limit for this position of the leader, in microradians. Where rows overlap or leave a gap, the
/// stricter row counts. Beyond all rows, the nearest row counts.
int coupledLowest(const Coupling& coupling, int leader_position);

/// The lower limit of a joint in this posture, in microradians: its own limit or a coupling's, whichever is higher.
/// @param posture a position for each joint, in the order of RobotModel::joints
int lowestPosition(const RobotModel& model, int joint, const int* posture);

/// Changes a posture as little as possible, so that it is allowed. First it moves every joint into its limits, then
/// followers up, out of their leaders' way.
/// @param[in,out] posture a position for each joint, in the order of RobotModel::joints; any values
void clampPosture(const RobotModel& model, int* posture);

}  // namespace robot_model

#endif  // AIBO_RCSERVER_ROBOT_MODEL_ROBOT_MODEL_H
