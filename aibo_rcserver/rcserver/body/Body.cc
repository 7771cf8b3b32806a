#include "rcserver/body/Body.h"

#include <OPENR/OSyslog.h>

#include "rcserver/body/EmptyRobot.h"

using robot_model::MAX_EARS;
using robot_model::MAX_JOINTS;
using robot_model::MAX_LEDS;
using robot_model::RobotModel;

Body::Body() : vectors_on_their_way_(0), power_order_(POWER_STAYS_ON) {
  design_[0] = '\0';
}

void Body::Open() {
  OPENR::GetRobotDesign(design_);
  const RobotModel* robot = robot_model::findRobotModel(design_);
  if (robot == NULL) {
    OSYSLOG1((osyslogERROR, "RCServer: no joints, sensors and LEDs: the design \"%s\" is not known", design_));
    robot = &EMPTY_ROBOT;
  } else if (!vectors_.Create(MAX_JOINTS + MAX_LEDS + MAX_EARS)) {
    OSYSLOG1((osyslogERROR, "RCServer: no memory for commands to joints and LEDs"));
    robot = &EMPTY_ROBOT;
  }
  joint_driver_.Open(*robot);
  light_driver_.Open(*robot);
  sensor_driver_.Open(*robot);
}

void Body::Close() {
  vectors_.Destroy();
  sensor_driver_.Close();
  light_driver_.Close();
  joint_driver_.Close();
}

void Body::SendCommands(OSubject* effector) {
  if (!effector->IsReady()) {
    return;
  }
  const int wanted = CommandVectors::NUMBER_OF_VECTORS - vectors_on_their_way_;
  int added = 0;
  while (added < wanted && AddVector(effector)) {
    ++added;
  }
  if (added > 0) {
    effector->NotifyObservers();
  }
}

void Body::EffectorIsReady(OSubject* effector) {
  if (vectors_on_their_way_ > 0) {  // the first READY follows no vector
    --vectors_on_their_way_;
    joint_driver_.OutputIsComplete();
  }
  SendCommands(effector);
}

// Adds what is to be said now to the next notification.
bool Body::AddVector(OSubject* effector) {
  const bool joints_are_due = joint_driver_.HasCommand();
  RCRegion* vector = joints_are_due || light_driver_.HasCommand() ? vectors_.FindFree() : NULL;
  if (vector == NULL) {
    return false;
  }
  CommandVectors::Clear(vector);
  if (joints_are_due) {
    joint_driver_.Fill(vector);
    joint_driver_.Sent(vectors_on_their_way_);
  }
  light_driver_.Fill(vector);
  effector->SetData(vector);
  ++vectors_on_their_way_;
  return true;
}

bool Body::ReadSensors(OSensorFrameVectorData* sensors, longword* frame) {
  const bool have_sensors_reported = sensor_driver_.Read(sensors, frame);
  const bool have_joints_reported = joint_driver_.ReadSensors(sensors, frame);
  return have_sensors_reported || have_joints_reported;
}

void Body::CutMotors() {
  joint_driver_.Switch(false);
  OPENR::SetMotorPower(opowerOFF);
}

void Body::CarryOutPowerOrder() {
  const PowerOrder order = power_order_;
  if (order == POWER_STAYS_ON) {
    return;
  }
  CutMotors();
  // Shut down, it boots when somebody presses its button.
  const OBootCondition condition =
      order == POWER_REBOOT ? OBootCondition(obcbBOOT_TIMER, 0, obcbttRELATIVE) : OBootCondition(obcbPAUSE_SW);
  const OStatus status = OPENR::Shutdown(condition);
  if (status != oSUCCESS) {
    power_order_ = POWER_STAYS_ON;
    OSYSLOG1((osyslogERROR, "RCServer: the robot does not %s (status %u)",
              order == POWER_REBOOT ? "reboot" : "shut down", static_cast<unsigned>(status)));
  }
}
