/// @file body_model.h
/// The ERS-7 as a model for MuJoCo, made from urdf/ers7.urdf.
#ifndef TEST_PHYSICS_BODY_MODEL_H
#define TEST_PHYSICS_BODY_MODEL_H

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace physics {

/// Length of a step of the physics, in seconds; four of them are a frame of OPEN-R.
constexpr double kStepSeconds = 0.002;

/// Inertia of a motor behind its gears, in kg m^2, about that of the leg it moves. Our choice.
constexpr double kMotorInertia = 5e-4;

/// The joint with six degrees of freedom between the room and the body.
constexpr char kBodyJoint[] = "room_to_base_link";
constexpr char kFloor[] = "floor";
constexpr char kAccelerometer[] = "accelerometer";

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPointer = std::unique_ptr<mjModel, DeleteModel>;
using DataPointer = std::unique_ptr<mjData, DeleteData>;

/// The text of a model (MJCF): a level floor, on which the robot moves freely.
///
/// Links, joints, shapes and masses have the names that they have in the URDF, and come from there; the joints' stops
/// are the mechanical limits of robot_model.h. Each joint has a motor of the same name, whose control is its torque.
/// The floor touches everything. Lower legs touch each other, too; otherwise the parts of the robot pass through each
/// other, which the limits in robot_model.h prevent.
/// @param urdf_file the robot
/// @param friction between the robot and the floor
/// @throw std::runtime_error if the file is not a URDF, or has a shape that is not a box, a cylinder or a ball
std::string describeBody(const std::string& urdf_file, double friction);

/// Compiles a model.
/// @throw std::runtime_error with MuJoCo's words if it cannot
ModelPointer compile(const std::string& description);

}  // namespace physics

#endif  // TEST_PHYSICS_BODY_MODEL_H
