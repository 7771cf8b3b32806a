/// @file robot_model.h
/// What an Aibo is, in numbers: its joints, their limits, where parts of the body would hit each other, its sensors,
/// LEDs and ears. One table a robot, chosen by the name of its design. Used by both sides; C++98, no I/O.
///
/// Angles are whole microradians, as everywhere in OPEN-R; `int` has 32 bits on both sides. Signs are Sony's: all zero
/// is the robot with its legs straight down; positive is up for head and tail, to the left for pan, forward for the
/// rotators, away from the body for the elevators, bent for the knees (Model Information ERS-7, section 2.1).
#ifndef AIBO_RCSERVER_ROBOT_MODEL_ROBOT_MODEL_H
#define AIBO_RCSERVER_ROBOT_MODEL_ROBOT_MODEL_H

namespace robot_model {

/// Most of each of any robot in the tables, for arrays of a fixed size.
const int MAX_JOINTS = 18;
const int MAX_SENSORS = 18;
const int MAX_LEDS = 26;
const int MAX_EARS = 2;

/// What a find function returns when there is no such thing.
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

  /// Where the joint may be sent, in microradian (MI, software limits; section 2.1.1 for the ERS-7).
  /// The ERS-7's J1 is limited by front and rear as in section 2.1.2 and the drawing in 1.2, not by left and right as
  /// the rows of 2.1.1 read.
  int lowest;
  int highest;

  /// Where the joint can be found when it is moved by hand, in microradian (MI, drawing in section 1.2).
  int mechanical_lowest;
  int mechanical_highest;

  /// Greatest speed, in microradian/s. ERS-7: Sony's figures in Tekkotsu's ERS7Info.h. ERS-210: Sony's FAQ, quoted in
  /// Tekkotsu's JointSpeedLimits.txt.
  int highest_speed;

  PidGains gains;  ///< ERS-7: MI, standard gains. ERS-210: Tekkotsu's ERS210Info.h
};

/// The acceleration a joint is planned with unless somebody asks for another one, in microradian/s^2.
///
/// No source gives one. The highest speed is reached within 100 ms, 12.5 frames of 8 ms: slow enough for a jump of the
/// target not to become a blow to the gears, fast enough for legs: swinging by 0.3 rad to each side 1.5 times a second
/// takes 27 rad/s^2, and an ERS-7's rotator gets 48.7.
int defaultAcceleration(const Joint& joint);

/// In this stretch of the leading joint, the following joint may not go below `lowest`. All in microradian.
struct CouplingRow {
  int from;
  int to;  ///< not below `from`
  int lowest;
};

/// Two joints, one of which must keep out of the way of the other, or the body is hit.
///
/// The rows are as Sony prints them, in ascending order. They overlap here and leave gaps of a degree there; see
/// coupledLowest(). Down the rows, `lowest` first falls and then rises, never the other way round. So between two
/// positions of the leading joint the follower is never restricted more than at one of the two, which is what makes
/// every pair of allowed postures reachable from one another.
struct Coupling {
  int leader;    ///< index of the joint that goes first
  int follower;  ///< index of the joint whose lower limit depends on it; leads no other joint
  const CouplingRow* rows;
  int number_of_rows;
};

/// What a sensor measures, and so what its values are.
enum SensorKind {
  SENSOR_DISTANCE,      ///< infrared, in micrometre
  SENSOR_ACCELERATION,  ///< in micrometre/s^2
  SENSOR_FORCE,         ///< in micronewton
  SENSOR_TEMPERATURE,   ///< in millionths of a degree Celsius
  SENSOR_CHARGE,        ///< what is left in the battery, in millionths of all that it holds
  SENSOR_TOUCH,         ///< electrostatic: a strength, without a unit
  SENSOR_SWITCH         ///< 0 or 1
};

/// One sensor with a value; camera, microphones and loudspeaker are none.
struct Sensor {
  const char* name;          ///< in ROS and on the simulated robot's console: lower case with underscores
  unsigned char identifier;  ///< on the wire; no joint of the robot has the same; docs/protocol.md lists them

  /// For OPENR::OpenPrimitive() (MI), whose values are in the units of SensorKind. Null for what is no primitive and
  /// comes from OPENR::GetPowerStatus(): charge and temperature of the battery.
  const char* locator;

  SensorKind kind;

  /// What it can measure, in the units of SensorKind (MI). Both 0 if Sony does not say.
  int lowest;
  int highest;

  /// Pressed from `on` up, no longer pressed below `off`; see isPressed(). Both 0 for what cannot be pressed, and where
  /// Sony gives no figure. ERS-7: MI, on and off levels of the electrostatic sensors.
  int on;
  int off;
};

/// True if somebody presses or touches a switch or touch sensor, with the hysteresis that Sony gives for it.
/// @param value strength, or 0 or 1
/// @param was_pressed what this function said of the sensor's value before; false at first
bool isPressed(const Sensor& sensor, double value, bool was_pressed);

/// What OPEN-R can do with an LED.
enum LedKind {
  LED2,  ///< on or off
  LED3   ///< intensity 0 to 255, mode A or B
};

/// Where on the body an LED is.
enum LedPlace { LED_ON_HEAD, LED_ON_FACE, LED_ON_BACK, LED_ON_TAIL };

/// One LED.
struct Led {
  const char* name;          ///< in ROS: lower case with underscores
  unsigned char identifier;  ///< on the wire, a numbering of its own; docs/protocol.md lists them
  const char* locator;       ///< for OPENR::OpenPrimitive() (MI); the letter or letters at its end are Sony's name
  LedKind kind;
  LedPlace place;
};

/// How OPEN-R is told about an ear: by JOINT_COMMAND3 or by JOINT_COMMAND4.
enum EarKind { EAR_JOINT3, EAR_JOINT4 };

/// One ear: drawn by a magnet, which is not to be held energised (MI), or let go.
struct Ear {
  const char* name;          ///< "left_ear", "right_ear"
  unsigned char identifier;  ///< on the wire, a numbering of its own: 1 left, 2 right
  const char* locator;       ///< for OPENR::OpenPrimitive() (MI)
  EarKind kind;
};

/// One kind of robot.
struct RobotModel {
  const char* design;  ///< as OPENR::GetRobotDesign() gives it: "ERS-7", "ERS-210"
  const Joint* joints;
  int number_of_joints;
  const Coupling* couplings;
  int number_of_couplings;
  const Sensor* sensors;  ///< in ascending order of the identifiers, as LEDs and ears
  int number_of_sensors;
  const Led* leds;
  int number_of_leds;
  const Ear* ears;
  int number_of_ears;
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

/// The lower limit that a coupling sets its follower while the leader is at `leader_position`, in microradian.
/// Of rows that overlap, and of the two rows beside a gap, the one holds that restricts more. Beyond the first and the
/// last row, these go on.
int coupledLowest(const Coupling& coupling, int leader_position);

/// The lower limit of a joint while the others are in this posture, in microradian: its own limit or that of a
/// coupling, whichever is higher.
/// @param posture one position a joint, in the order of RobotModel::joints
int lowestPosition(const RobotModel& model, int joint, const int* posture);

/// Changes a posture as little as needed for it to be allowed: every joint into its limits, then followers up out of
/// the way of their leaders.
/// @param[in,out] posture one position a joint, in the order of RobotModel::joints; any values
void clampPosture(const RobotModel& model, int* posture);

}  // namespace robot_model

#endif  // AIBO_RCSERVER_ROBOT_MODEL_ROBOT_MODEL_H
