#include "body_model.h"

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "robot_model/robot_model.h"

namespace physics {
namespace {

std::string poseOf(const urdf::Pose& pose) {
  std::ostringstream text;
  const urdf::Rotation& turn = pose.rotation;
  text << " pos='" << pose.position.x << ' ' << pose.position.y << ' ' << pose.position.z << "' quat='" << turn.w << ' '
       << turn.x << ' ' << turn.y << ' ' << turn.z << "'";
  return text.str();
}

std::string shapeOf(const urdf::Geometry& geometry) {
  std::ostringstream text;
  if (const auto* ball = dynamic_cast<const urdf::Sphere*>(&geometry)) {
    text << " type='sphere' size='" << ball->radius << "'";
  } else if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) {
    text << " type='box' size='" << box->dim.x / 2 << ' ' << box->dim.y / 2 << ' ' << box->dim.z / 2 << "'";
  } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry)) {
    text << " type='cylinder' size='" << cylinder->radius << ' ' << cylinder->length / 2 << "'";
  } else {
    throw std::runtime_error("a collision shape is neither a ball nor a box nor a cylinder");
  }
  return text.str();
}

bool isLowerLeg(const std::string& link) {
  return link.find("_knee_link") != std::string::npos || link.find("_foot_link") != std::string::npos;
}

std::string inertialOf(const urdf::Inertial& inertial) {
  const urdf::Vector3& centre = inertial.origin.position;
  std::ostringstream text;  // the file's inertias are along the axes of their links
  text << "<inertial pos='" << centre.x << ' ' << centre.y << ' ' << centre.z << "' mass='" << inertial.mass
       << "' fullinertia='" << inertial.ixx << ' ' << inertial.iyy << ' ' << inertial.izz << ' ' << inertial.ixy << ' '
       << inertial.ixz << ' ' << inertial.iyz << "'/>\n";
  return text.str();
}

std::string jointOf(const urdf::Joint& joint) {
  const robot_model::RobotModel& robot = *robot_model::findRobotModel("ERS-7");
  const int index = robot_model::findJointByName(robot, joint.name.c_str());
  if (index == robot_model::NO_JOINT) {
    throw std::runtime_error("the ERS-7 has no joint " + joint.name);
  }
  const robot_model::Joint& limits = robot.joints[index];
  std::ostringstream text;
  text << "<joint name='" << joint.name << "' type='hinge' axis='" << joint.axis.x << ' ' << joint.axis.y << ' '
       << joint.axis.z << "' limited='true' range='" << limits.mechanical_lowest * 1e-6 << ' '
       << limits.mechanical_highest * 1e-6 << "' armature='" << kMotorInertia << "'/>\n";
  return text.str();
}

void describeLink(const urdf::Link& link, const std::string& joint, const std::string& pose, std::ostream& text) {
  text << "<body name='" << link.name << "'" << pose << ">\n" << joint;
  if (link.inertial) {
    text << inertialOf(*link.inertial);
  }
  for (std::size_t i = 0; i < link.collision_array.size(); ++i) {
    const urdf::Collision& part = *link.collision_array[i];
    text << "<geom name='" << link.name << '_' << i << "'" << poseOf(part.origin) << shapeOf(*part.geometry)
         << (isLowerLeg(link.name) ? " contype='2' conaffinity='3'" : " contype='0' conaffinity='1'") << "/>\n";
  }
  if (link.name == "imu_link") {
    text << "<site name='" << kAccelerometer << "'/>\n";
  }
  for (const urdf::LinkSharedPtr& child : link.child_links) {
    const urdf::Joint& parent_joint = *child->parent_joint;
    describeLink(*child, parent_joint.type == urdf::Joint::FIXED ? "" : jointOf(parent_joint),
                 poseOf(parent_joint.parent_to_joint_origin_transform), text);
  }
  text << "</body>\n";
}

[[noreturn]] void stopAtError(const char* message) {
  std::fprintf(stderr, "MuJoCo: %s\n", message);
  std::abort();  // MuJoCo's own handler waits for somebody to press Enter
}

void printWarning(const char* message) {
  std::fprintf(stderr, "MuJoCo: %s\n", message);  // MuJoCo's own handler writes a file beside the tests
}

}  // namespace

std::string describeBody(const std::string& urdf_file, double friction) {
  const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDFFile(urdf_file);
  if (!robot) {
    throw std::runtime_error(urdf_file + " is not a URDF");
  }
  std::ostringstream text;
  text.precision(9);
  text << "<mujoco>\n<compiler angle='radian' inertiafromgeom='false'/>\n<option timestep='" << kStepSeconds
       << "' cone='elliptic' impratio='10'/>\n<default><geom friction='" << friction
       << " 0.005 0.0001' solref='0.01 1'/></default>\n<worldbody>\n<geom name='" << kFloor
       << "' type='plane' size='0 0 1' contype='1' conaffinity='0'/>\n";
  describeLink(*robot->getRoot(), "<freejoint name='" + std::string(kBodyJoint) + "'/>\n", "", text);
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
