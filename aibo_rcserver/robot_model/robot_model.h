/// @file robot_model.h
/// An Aibo in numbers: its joints, their limits, the postures in which parts of the body would hit each other, its
/// sensors, LEDs and ears. There is one table per robot, found by the name of its design. Used by both sides; C++98, no
/// I/O.
///
/// Angles are whole microradians, as everywhere in OPEN-R; `int` has 32 bits on both sides. Signs are Sony's: with all
/// joints at zero, the legs are straight down; positive is up for head and tail, to the left for pan, forward for the
/// rotators, away from the body for the elevators, bent for the knees (Model Information ERS-7, section 2.1).
#ifndef AIBO_RCSERVER_ROBOT_MODEL_ROBOT_MODEL_H
#define AIBO_RCSERVER_ROBOT_MODEL_ROBOT_MODEL_H

namespace robot_model {

/// The most of each that any robot in the tables has, for arrays of a fixed size.
const int MAX_JOINTS = 18;
const int MAX_SENSORS = 18;
const int MAX_LEDS = 26;
const int MAX_EARS = 2;

/// Results of the find functions when nothing is found.
const int NO_JOINT = -1;
const int NO_SENSOR = -1;
const int NO_LED = -1;
const int NO_EAR = -1;

/// Gains of a joint's servo, in the order of OPENR::SetJointGain().
struct PidGains {
  unsigned short proportional;
  unsigned short integral;
  unsigned short derivative;
  unsigned short proportional_shift;
  unsigned short integral_shift;
  unsigned short derivative_shift;
};

/// One servo. Sources: "MI" is Sony's Model Information ERS-7 or ERS-210.
struct Joint {
  const char* name;          ///< in ROS: lower case with underscores
  unsigned char identifier;  ///< on the wire; docs/protocol.md lists them
  const char* locator;       ///< for OPENR::OpenPrimitive() (MI)

  /// Range of allowed targets, in microradian (MI, software limits; section 2.1.1 for the ERS-7).
  /// The ERS-7's J1 has different limits for front and rear, as in section 2.1.2 and the drawing in 1.2, not for left
  /// and right, as the rows of 2.1.1 suggest.
  int lowest;
  int highest;

  /// Range of positions when the joint is moved by hand, in microradian (MI, drawing in section 1.2).
  int mechanical_lowest;
  int mechanical_highest;

  /// Greatest speed, in microradian/s. ERS-7: Sony's figures in Tekkotsu's ERS7Info.h. ERS-210: Sony's FAQ, quoted in
  /// Tekkotsu's JointSpeedLimits.txt.
  int highest_speed;

  PidGains gains;  ///< ERS-7: MI, standard gains. ERS-210: Tekkotsu's ERS210Info.h
};

/// The acceleration with which a joint's movements are planned unless a client sets another one, in microradian/s^2.
///
/// No source gives a figure. With this one, a joint reaches its highest speed in 100 ms, 12.5 frames of 8 ms. That is
/// slow enough to protect the gears from jumps of the target, and fast enough for walking: swinging a leg by 0.3 rad to
/// each side 1.5 times a second takes 27 rad/s^2, and an ERS-7's rotator gets 48.7.
int defaultAcceleration(const Joint& joint);

/// While the leader is between `from` and `to`, the follower may not go below `lowest`. All in microradian.
struct CouplingRow {
  int from;
  int to;  ///< not below `from`
  int lowest;
};

/// Two joints, one of which (the follower) must keep out of the way of the other (the leader).
///
/// The rows are as Sony prints them, in ascending order. Some overlap, and some leave gaps of a degree; see
/// coupledLowest(). From row to row, `lowest` first falls and then rises, never the other way round. So on the way
/// between two positions of the leader, the follower is never restricted more than at one of the two. This is why every
/// allowed posture can be reached from every other one.
struct Coupling {
  int leader;    ///< index of the joint that moves freely
  int follower;  ///< index of the joint whose lower limit depends on the leader; is not itself a leader
  const CouplingRow* rows;
  int number_of_rows;
};

/// The quantity that a sensor measures, and the unit of its values in OPEN-R.
enum SensorKind {
  SENSOR_DISTANCE,      ///< infrared, in micrometre
  SENSOR_ACCELERATION,  ///< in micrometre/s^2
  SENSOR_FORCE,         ///< in micronewton
  SENSOR_TEMPERATURE,   ///< in millionths of a degree Celsius
  SENSOR_CHARGE,        ///< remaining charge of the battery, in millionths of its capacity
  SENSOR_TOUCH,         ///< electrostatic; a strength without a unit
  SENSOR_SWITCH         ///< 0 or 1
};

/// One sensor with a numeric value, so not the camera or the microphones.
struct Sensor {
  const char* name;          ///< in ROS and on the simulated robot's console: lower case with underscores
  unsigned char identifier;  ///< on the wire; different from those of the robot's joints; docs/protocol.md lists them

  /// For OPENR::OpenPrimitive() (MI). Null for the charge and temperature of an ERS-7's battery, which are not
  /// primitives but come from OPENR::GetPowerStatus().
  const char* locator;

  SensorKind kind;

  /// Measuring range, in the units of SensorKind (MI). Both 0 if Sony does not give one.
  int lowest;
  int highest;

  /// Pressed from `on` up, no longer pressed below `off`; see isPressed(). Both 0 for sensors that cannot be pressed or
  /// for which Sony gives no figure. ERS-7: MI, on and off levels of the electrostatic sensors.
  int on;
  int off;
};

/// True if a switch is pressed or a touch sensor touched, with the hysteresis that Sony gives for it.
/// @param value strength of a touch, or 0 or 1 for a switch
/// @param was_pressed this function's result for the sensor's previous value; false at first
bool isPressed(const Sensor& sensor, double value, bool was_pressed);

/// OPEN-R's kinds of LEDs.
enum LedKind {
  LED2,  ///< on or off
  LED3   ///< intensity 0 to 255, mode A or B
};

/// Where on the body an LED is.
enum LedPlace { LED_ON_HEAD, LED_ON_FACE, LED_ON_BACK, LED_ON_TAIL };

/// One LED.
struct Led {
  const char* name;          ///< in ROS: lower case with underscores
  unsigned char identifier;  ///< on the wire, unique among LEDs; docs/protocol.md lists them
  const char* locator;       ///< for OPENR::OpenPrimitive() (MI); its last letters are Sony's name of the LED
  LedKind kind;
  LedPlace place;
};

/// The command that moves an ear in OPEN-R: JOINT_COMMAND3 or JOINT_COMMAND4.
enum EarKind { EAR_JOINT3, EAR_JOINT4 };

/// One ear. A magnet draws it or lets it go; the magnet must not stay energised (MI).
struct Ear {
  const char* name;          ///< "left_ear", "right_ear"
  unsigned char identifier;  ///< on the wire: 1 left, 2 right
  const char* locator;       ///< for OPENR::OpenPrimitive() (MI)
  EarKind kind;
};

/// One kind of robot.
struct RobotModel {
  const char* design;  ///< as returned by OPENR::GetRobotDesign(): "ERS-7", "ERS-210"
  const Joint* joints;
  int number_of_joints;
  const Coupling* couplings;
  int number_of_couplings;
  const Sensor* sensors;  ///< in ascending order of the identifiers, like LEDs and ears
  int number_of_sensors;
  const Led* leds;
  int number_of_leds;
  const Ear* ears;
  int number_of_ears;
  int number_of_color_channels;  ///< of the camera's colour detection: 0..number - 1 can be used
};

/// The table of the robot whose design has this name; null if there is none.
const RobotModel* findRobotModel(const char* design);

/// Indices into RobotModel::joints, or NO_JOINT.
int findJointByIdentifier(const RobotModel& model, int identifier);
int findJointByName(const RobotModel& model, const char* name);
int findJointByLocator(const RobotModel& model, const char* locator);

/// Indices into RobotModel::sensors, or NO_SENSOR.
int findSensorByIdentifier(const RobotModel& model, int identifier);
int findSensorByName(const RobotModel& model, const char* name);
int findSensorByLocator(const RobotModel& model, const char* locator);

/// Indices into RobotModel::leds, or NO_LED.
int findLedByIdentifier(const RobotModel& model, int identifier);
int findLedByName(const RobotModel& model, const char* name);
int findLedByLocator(const RobotModel& model, const char* locator);

/// Indices into RobotModel::ears, or NO_EAR.
int findEarByIdentifier(const RobotModel& model, int identifier);
int findEarByName(const RobotModel& model, const char* name);
int findEarByLocator(const RobotModel& model, const char* locator);

/// The follower's lower limit while the leader is at `leader_position`, in microradian. Where rows overlap, and in the
/// gap between two rows, the stricter one counts. Positions beyond the first or last row count as inside it.
int coupledLowest(const Coupling& coupling, int leader_position);

/// The lower limit of a joint while the others are in this posture, in microradian: its own limit or that from a
/// coupling, whichever is higher.
/// @param posture one position per joint, in the order of RobotModel::joints
int lowestPosition(const RobotModel& model, int joint, const int* posture);

/// Changes a posture as little as needed to make it allowed: moves every joint into its limits, then followers up, out
/// of the way of their leaders.
/// @param[in,out] posture one position per joint, in the order of RobotModel::joints; any values
void clampPosture(const RobotModel& model, int* posture);

}  // namespace robot_model

#endif  // AIBO_RCSERVER_ROBOT_MODEL_ROBOT_MODEL_H
