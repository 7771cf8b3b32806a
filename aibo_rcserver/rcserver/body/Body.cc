#include "rcserver/body/Body.h"

#include <OPENR/OSyslog.h>

#include <algorithm>

using namespace robot_model;

namespace {

const char* const PAWS[NUMBER_OF_LEGS] = {"paw_left_front", "paw_left_hind", "paw_right_front", "paw_right_hind"};

}  // namespace

Body::Body()
    : model_(FindModel()),
      joint_driver_(model_),
      light_driver_(model_),
      sensor_driver_(model_),
      camera_(model_.number_of_color_channels) {
  light_driver_.Open();
  sensor_driver_.Open();
}

// Finds the robot's table, and creates the command vectors.
const RobotModel& Body::FindModel() {
  design_[0] = '\0';
  OPENR::GetRobotDesign(design_);
  const RobotModel* const model = findRobotModel(design_);
  if (model == NULL) {
    OSYSLOG1((osyslogERROR, "RCServer: no joints, sensors and LEDs: the design \"%s\" is not known", design_));
    return EMPTY_ROBOT;
  }
  if (!vectors_.Create(MAX_JOINTS + MAX_LEDS + MAX_EARS)) {
    OSYSLOG1((osyslogERROR, "RCServer: no memory for commands to joints and LEDs"));
    return EMPTY_ROBOT;
  }
  return *model;
}

void Body::Start(OSubject* effector, OSubject* speaker) {
  vectors_.Start(effector);
  speaker_.Start(speaker);
}

void Body::SendCommands() {
  while (SendVector()) {
  }
  vectors_.Notify();
}

void Body::EffectorIsReady() {
  if (vectors_.IsReady()) {
    joint_driver_.OutputIsComplete();
  }
  SendCommands();
}

// Sends the next vector. False if none can be sent, or if nothing has to be commanded.
bool Body::SendVector() {
  const bool joints_are_due = joint_driver_.HasCommand();
  RCRegion* const vector = joints_are_due || light_driver_.HasCommand() ? vectors_.Next() : NULL;
  if (vector == NULL) {
    return false;
  }
  CommandVectors::Clear(vector);
  if (joints_are_due) {
    joint_driver_.Fill(vector);
    joint_driver_.Sent(vectors_.VectorsOnTheirWay());
    FlickEars();
  }
  light_driver_.Fill(vector);
  vectors_.Send(vector);
  return true;
}

// Flicks the ears that motions want to flick now.
void Body::FlickEars() {
  for (int ear = 0; ear < model_.number_of_ears; ++ear) {
    if (Joints().Motions().TakeFlick(ear)) {
      light_driver_.SetEar(ear, true);
    }
  }
}

bool Body::ReadSensors(OSensorFrameVectorData* sensors, longword* frame) {
  const bool have_sensors_reported = sensor_driver_.Read(sensors, frame);
  const bool have_joints_reported = joint_driver_.ReadSensors(sensors, frame);
  if (have_sensors_reported) {
    WatchWalk(*frame);
  }
  return have_sensors_reported || have_joints_reported;
}

// The three sensors of the accelerometer measure gravity along their axes: forward, to the right, up.
void Body::WatchWalk(longword frame) {
  Walker& walker = Joints().Walking();
  const WalkGuard::Reading around = LookAround();
  FallWatch::Reading reading = {-Measured("acceleration_front_back"),
                                Measured("acceleration_right_left"),
                                -Measured("acceleration_up_down"),
                                {false, false, false, false}};
  std::copy(around.paws, around.paws + NUMBER_OF_LEGS, reading.paws);
  Joints().Measured(reading, frame);
  walker.HaveLooked(around);
  if (walker.GoesSoft()) {
    OSYSPRINT(("RCServer: %s: its motors go off, so that its legs are limp\n", FallWatch::Words(walker.Fall().Now())));
  }
  if (walker.WantsMotorsOff()) {
    joint_driver_.Switch(false);
  }
}

WalkGuard::Reading Body::LookAround() {
  WalkGuard::Reading reading;
  reading.chest = Measured("range_chest");
  reading.near = Measured("range_near");
  reading.far = Measured("range_far");
  for (int leg = 0; leg < NUMBER_OF_LEGS; ++leg) {
    reading.paws[leg] = Measured(PAWS[leg]) != 0;
  }
  double* const angles[] = {&reading.head.neck_tilt, &reading.head.head_pan, &reading.head.head_tilt};
  static const char* const HEAD[] = {"neck_tilt", "head_pan", "head_tilt"};
  for (int i = 0; i < 3; ++i) {
    const int joint = findJointByName(model_, HEAD[i]);
    *angles[i] = joint == NO_JOINT ? 0 : Joints().Position(joint) * 1e-6;
  }
  return reading;
}

// The sensor's value; 0 if there is no such sensor, or if it has not measured yet.
double Body::Measured(const char* sensor) const {
  const int found = findSensorByName(model_, sensor);
  return found == NO_SENSOR ? 0 : sensor_driver_.Value(found) * 1e-6;
}

void Body::CutMotors() {
  joint_driver_.Switch(false);
  OPENR::SetMotorPower(opowerOFF);
}

bool Body::SwitchOff(bool reboots) {
  CutMotors();
  const OBootCondition condition =
      reboots ? OBootCondition(obcbBOOT_TIMER, 0, obcbttRELATIVE) : OBootCondition(obcbPAUSE_SW);
  const OStatus status = OPENR::Shutdown(condition);
  if (status != oSUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: the robot does not %s (status %u)", reboots ? "reboot" : "shut down",
              static_cast<unsigned>(status)));
  }
  return status == oSUCCESS;
}
