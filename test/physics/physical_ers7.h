/// @file physical_ers7.h
/// An ERS-7 with weight for openr_host::Machine: MuJoCo moves it.
#ifndef TEST_PHYSICS_PHYSICAL_ERS7_H
#define TEST_PHYSICS_PHYSICAL_ERS7_H

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "body_model.h"
#include "robot_model/legs.h"
#include "robot_model/robot_model.h"
#include "simulator/ers7/body/battery.h"
#include "simulator/ers7/body/primitive_table.h"
#include "simulator/ers7/region_pool.h"
#include "simulator/openr_host/virtual_robot.h"

namespace physics {

/// Angles by joint, in degrees.
using JointAngles = std::map<std::string, double>;

/// Each joint is a DC motor. Its duty is proportional to the distance between the joint and its command, and full if
/// that is what the joint moves in 3 frames at its highest speed, as in simulator/ers7/body/joint.h. Without a load it
/// reaches its highest speed (robot_model.h); the torque falls evenly from World::stall_torque at rest to 0 at this
/// speed. Without gain or power, only the friction of the gears is left, so the joint gives way.
///
/// World::servo_gain changes how far behind that is.
///
/// The accelerometer measures acceleration and gravity, averaged over each frame; a paw's switch is on while its foot
/// touches the floor. Distances are the farthest that a sensor can measure. There is no camera.
class PhysicalErs7 : public openr_host::VirtualRobot {
 public:
  /// It stands in the resting posture of the simulated robot.
  /// @throw std::runtime_error if the model cannot be made
  explicit PhysicalErs7(const World& world = World());

  /// @name openr_host::VirtualRobot
  /// @{
  std::string design() const override { return model_.design; }
  OStatus openPrimitive(const char* locator, OPrimitiveID* id) override { return primitives_.open(locator, id); }
  OStatus closePrimitive(OPrimitiveID id) override { return primitives_.close(id); }
  OStatus controlPrimitive(OPrimitiveID, OPrimitiveRequest, void*, size_t, void*, size_t) override {
    return oINVALID_ARG;
  }
  OStatus setJointGain(OPrimitiveID id, word pg, word ig, word dg, word ps, word is, word ds) override;
  OStatus enableJointGain(OPrimitiveID id) override;
  OStatus disableJointGain(OPrimitiveID id) override;
  OStatus getJointValue(OPrimitiveID id, OJointValue* value) override;
  OStatus getSensorValue(OPrimitiveID id, OSensorValue* value) override;
  OStatus setMotorPower(OPower power) override;
  OStatus getPowerStatus(OPowerStatus* status) override;
  OStatus getMemoryStickStatus(OMemoryStickStatus*) override { return oFAIL; }
  OStatus setCdtVectorData(const OCdtVectorData&) override { return oFAIL; }
  void switchOff() override;
  bool takesCommand(OPrimitiveID id, ODataType type) const override;
  void passFrame(longword frame, const openr_host::EffectorCommands& commands) override;
  RCRegion* captureSensors(longword frame) override;
  bool cameraImageDue(longword) override { return false; }
  RCRegion* captureImage(longword) override { return nullptr; }
  /// @}

  /// Puts the robot on the floor in a posture, at rest; joints that are not named keep their positions.
  /// @param turn of the body against upright: lying on its left side, for example
  void place(const JointAngles& angles, const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity());

  /// A force on the middle of the body until the next call, in newton in the room.
  void push(const Eigen::Vector3d& force);

  /// @name The true state after the last frame
  /// @{
  Eigen::Isometry3d body() const;                 ///< in the room, metres
  double tilt() const;                            ///< of the body's up against the room's, in radian
  double jointPosition(std::size_t joint) const;  ///< radian
  double jointSpeed(std::size_t joint) const;     ///< radian/s
  double duty(std::size_t joint) const;           ///< of its motor, -1..1
  double reference(std::size_t joint) const { return servos_[joint].reference; }  ///< its command, radian
  double soleHeight(robot_model::Leg leg) const;  ///< lowest point of the foot over the floor, metres
  bool touchesFloor(robot_model::Leg leg) const;  ///< the foot
  bool bodyTouchesFloor() const;                  ///< anything else than feet and lower legs
  bool legsTouch() const;                         ///< one leg another
  bool motorsPull() const;                        ///< power is on, and a joint has gain
  /// @}

  const robot_model::RobotModel& model() const { return model_; }
  double highestSpeed(std::size_t joint) const { return model_.joints[joint].highest_speed * 1e-6; }

 private:
  static constexpr int kReadings = 4;

  struct Servo {
    int position_address;
    int speed_address;
    int motor;
    bool has_gain = false;
    double stiffness = 0;  ///< part of the standard proportional gain
    double reference = 0;  ///< radian
    double duty = 0;
    std::array<OJointValue, kReadings> readings = {};
  };

  OStatus forServos(OPrimitiveID id, const std::function<OStatus(std::size_t, Servo&)>& action);
  void driveMotors();
  void read();
  int measure(const robot_model::Sensor& sensor) const;
  bool touches(int geom) const;
  bool anyContact(const std::function<bool(int, int)>& condition) const;

  const robot_model::RobotModel& model_;
  const World world_;
  const ModelPointer physics_;
  const DataPointer state_;
  int body_;
  std::array<int, robot_model::NUMBER_OF_LEGS> feet_;  ///< shapes
  simulated_ers7::PrimitiveTable primitives_;
  std::vector<Servo> servos_;
  std::vector<std::array<OSensorValue, kReadings>> sensors_;
  std::array<double, 3> acceleration_ = {};  ///< mean of the last frame
  simulated_ers7::Battery battery_{90};
  simulated_ers7::RegionPool regions_;
  bool powered_ = false;
};

}  // namespace physics

#endif  // TEST_PHYSICS_PHYSICAL_ERS7_H
