#include "body_model.h"

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "robot_model/robot_model.h"

namespace physics {
namespace {

constexpr double kGravity = 9.81;

constexpr int kSills = 20;  ///< ahead of the robot, and as many behind it
constexpr double kBetweenSills = 0.15;

std::string poseOf(const urdf::Pose& pose) {
  std::ostringstream text;
  const urdf::Rotation& turn = pose.rotation;
  text << " pos='" << pose.position.x << ' ' << pose.position.y << ' ' << pose.position.z << "' quat='" << turn.w << ' '
       << turn.x << ' ' << turn.y << ' ' << turn.z << "'";
  return text.str();
}

/// @param rounded cylinders get round ends, and keep their length
std::string shapeOf(const urdf::Geometry& geometry, bool rounded) {
  std::ostringstream text;
  if (const auto* ball = dynamic_cast<const urdf::Sphere*>(&geometry)) {
    text << " type='sphere' size='" << ball->radius << "'";
  } else if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) {
    text << " type='box' size='" << box->dim.x / 2 << ' ' << box->dim.y / 2 << ' ' << box->dim.z / 2 << "'";
  } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry)) {
    text << " type='" << (rounded ? "capsule" : "cylinder") << "' size='" << cylinder->radius << ' '
         << cylinder->length / 2 - (rounded ? cylinder->radius : 0) << "'";
  } else {
    throw std::runtime_error("a collision shape is neither a ball nor a box nor a cylinder");
  }
  return text.str();
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

bool isLowerLeg(const std::string& link) {
  return contains(link, "_knee_") || contains(link, "_foot_");
}

bool isLeg(const std::string& link) {
  return isLowerLeg(link) || contains(link, "_elevator_");
}

/// Writes the parts of the robot as they are in a world.
class BodyWriter {
 public:
  BodyWriter(const World& world, std::ostream& text) : world_(world), text_(text) {}

  void write(const urdf::Link& link, const std::string& joint, const std::string& pose) {
    text_ << "<body name='" << link.name << "'" << pose << ">\n" << joint;
    if (link.inertial) {
      write(*link.inertial, massFactor(link.name));
    }
    for (std::size_t i = 0; i < link.collision_array.size(); ++i) {
      const urdf::Collision& part = *link.collision_array[i];
      const bool is_cylinder = part.geometry->type == urdf::Geometry::CYLINDER;
      if (world_.has_long_shanks || !is_cylinder || !isLowerLeg(link.name)) {
        text_ << "<geom name='" << link.name << '_' << i << "'" << poseOf(part.origin)
              << shapeOf(*part.geometry, isLeg(link.name))
              << (isLeg(link.name) ? " conaffinity='3' contype='" : " conaffinity='1' contype='")
              << (isLeg(link.name) ? kLegContacts : kBodyContacts) << "'/>\n";
      }
    }
    if (link.name == "imu_link") {
      text_ << "<site name='" << kAccelerometer << "'/>\n";
    }
    for (const urdf::LinkSharedPtr& child : link.child_links) {
      const urdf::Joint& parent_joint = *child->parent_joint;
      write(*child, parent_joint.type == urdf::Joint::FIXED ? "" : jointOf(parent_joint),
            poseOf(parent_joint.parent_to_joint_origin_transform));
    }
    text_ << "</body>\n";
  }

 private:
  double massFactor(const std::string& link) const {
    if (isLeg(link) || contains(link, "_rotator_")) {
      return world_.leg_mass;
    }
    return contains(link, "head_") || contains(link, "neck_") ? world_.head_mass : world_.body_mass;
  }

  void write(const urdf::Inertial& inertial, double factor) {
    const urdf::Vector3& centre = inertial.origin.position;  // the file's inertias are along the axes of their links
    text_ << "<inertial pos='" << centre.x << ' ' << centre.y << ' ' << centre.z << "' mass='" << inertial.mass * factor
          << "' fullinertia='" << inertial.ixx * factor << ' ' << inertial.iyy * factor << ' ' << inertial.izz * factor
          << ' ' << inertial.ixy * factor << ' ' << inertial.ixz * factor << ' ' << inertial.iyz * factor << "'/>\n";
  }

  std::string jointOf(const urdf::Joint& joint) const {
    const robot_model::RobotModel& robot = *robot_model::findRobotModel("ERS-7");
    const int index = robot_model::findJointByName(robot, joint.name.c_str());
    if (index == robot_model::NO_JOINT) {
      throw std::runtime_error("the ERS-7 has no joint " + joint.name);
    }
    const robot_model::Joint& limits = robot.joints[index];
    std::ostringstream text;
    text << "<joint name='" << joint.name << "' type='hinge' axis='" << joint.axis.x << ' ' << joint.axis.y << ' '
         << joint.axis.z << "' limited='true' range='" << limits.mechanical_lowest * 1e-6 << ' '
         << limits.mechanical_highest * 1e-6 << "' armature='" << world_.rotor_inertia << "' frictionloss='"
         << world_.gear_friction << "'/>\n";
    return text.str();
  }

  const World& world_;
  std::ostream& text_;
};

void writeFloor(const World& world, std::ostream& text) {
  text << "<geom name='" << kFloor << "' type='plane' size='0 0 1' contype='1' conaffinity='0'/>\n";
  for (int i = 1; world.sill > 0 && i <= kSills; ++i) {
    for (const int direction : {-1, 1}) {
      text << "<geom type='box' size='0.005 2 " << world.sill << "' pos='" << direction * i * kBetweenSills
           << " 0 0' contype='1' conaffinity='0'/>\n";
    }
  }
}

[[noreturn]] void stopAtError(const char* message) {
  std::fprintf(stderr, "MuJoCo: %s\n", message);
  std::abort();  // MuJoCo's own handler waits for somebody to press Enter
}

void printWarning(const char* message) {
  std::fprintf(stderr, "MuJoCo: %s\n", message);  // MuJoCo's own handler writes a file beside the tests
}

}  // namespace

std::string describeBody(const std::string& urdf_file, const World& world) {
  const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDFFile(urdf_file);
  if (!robot) {
    throw std::runtime_error(urdf_file + " is not a URDF");
  }
  const double along = -kGravity * std::sin(world.slope);
  std::ostringstream text;
  text.precision(9);
  // The model is sparse, and links without joints cost time. MuJoCo's own tolerance of 1e-8 changes only the last
  // digits.
  text << "<mujoco>\n<compiler angle='radian' inertiafromgeom='false' fusestatic='true'/>\n<option timestep='"
       << kStepSeconds << "' cone='elliptic' impratio='10' jacobian='sparse' tolerance='1e-6' gravity='"
       << along * std::cos(world.uphill) << ' ' << along * std::sin(world.uphill) << ' '
       << -kGravity * std::cos(world.slope) << "'/>\n<default><geom friction='" << world.friction
       << " 0.005 0.0001' solref='" << world.contact_time << " 1'/></default>\n<worldbody>\n";
  writeFloor(world, text);
  BodyWriter(world, text).write(*robot->getRoot(), "<freejoint name='" + std::string(kBodyJoint) + "'/>\n", "");
  text << "</worldbody>\n<actuator>\n";
  for (const auto& [name, joint] : robot->joints_) {
    if (joint->type != urdf::Joint::FIXED) {
      text << "<motor name='" << name << "' joint='" << name << "'/>\n";
    }
  }
  text << "</actuator>\n<sensor><accelerometer name='" << kAccelerometer << "' site='" << kAccelerometer
       << "'/></sensor>\n</mujoco>\n";
  return text.str();
}

ModelPointer compile(const std::string& description) {
  mju_user_error = stopAtError;
  mju_user_warning = printWarning;
  constexpr char kFile[] = "body.xml";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), kFile, static_cast<int>(description.size()));
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), kFile)], description.data(), description.size());
  char problem[1000] = "";
  ModelPointer model(mj_loadXML(kFile, files.get(), problem, sizeof(problem)));
  mj_deleteVFS(files.get());
  if (!model) {
    throw std::runtime_error(std::string("MuJoCo does not take the model: ") + problem);
  }
  return model;
}

}  // namespace physics
