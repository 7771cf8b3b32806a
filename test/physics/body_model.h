/// @file body_model.h
/// The ERS-7 as a model for MuJoCo, made from urdf/ers7.urdf.
#ifndef TEST_PHYSICS_BODY_MODEL_H
#define TEST_PHYSICS_BODY_MODEL_H

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

#include "world.h"

namespace physics {

/// Length of a step of the physics, in seconds; four of them are a frame of OPEN-R.
constexpr double kStepSeconds = 0.002;

/// The joint with six degrees of freedom between the room and the body.
constexpr char kBodyJoint[] = "room_to_base_link";
constexpr char kFloor[] = "floor";
constexpr char kAccelerometer[] = "accelerometer";

/// The kinds of contacts (MuJoCo's contype) of shapes: of the legs, and of all other parts of the robot.
constexpr int kLegContacts = 2;
constexpr int kBodyContacts = 0;

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPointer = std::unique_ptr<mjModel, DeleteModel>;
using DataPointer = std::unique_ptr<mjData, DeleteData>;

/// The text of a model (MJCF): a floor, on which the robot moves freely. On a slope, gravity is tilted.
///
/// Links, joints, shapes and masses have the names that they have in the URDF, and come from there; the joints' stops
/// are the mechanical limits of robot_model.h. Each joint has a motor of the same name, whose control is its torque.
/// The floor touches everything. Legs touch each other, too; otherwise the parts of the robot pass through each other,
/// which the limits in robot_model.h prevent.
/// @param urdf_file the robot
/// @throw std::runtime_error if the file is not a URDF, or has a shape that is not a box, a cylinder or a ball
std::string describeBody(const std::string& urdf_file, const World& world);

/// Compiles a model.
/// @throw std::runtime_error with MuJoCo's words if it cannot
ModelPointer compile(const std::string& description);

}  // namespace physics

#endif  // TEST_PHYSICS_BODY_MODEL_H
