#include <gmock/gmock.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <stdexcept>

#include "robot_model/head.h"
#include "robot_model/legs.h"
#include "robot_model/robot_model.h"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kDegree = 3.14159265358979323846 / 180;

/// Positions by joint, in radian. Joints that are not named are at zero.
using Posture = std::map<std::string, double>;

Isometry3d toIsometry(const urdf::Pose& pose) {
  const urdf::Rotation& rotation = pose.rotation;
  return Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z) *
         Eigen::Quaterniond(rotation.w, rotation.x, rotation.y, rotation.z);
}

Eigen::AngleAxisd turn(const urdf::Joint& joint, const Posture& posture) {
  const auto position = posture.find(joint.name);
  const Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  return Eigen::AngleAxisd(position == posture.end() ? 0 : position->second, axis.normalized());
}

/// A URDF file and the poses of its links when its joints are moved.
class UrdfModel {
 public:
  explicit UrdfModel(const std::string& file) : model_(urdf::parseURDFFile(file)) {
    if (!model_) {
      throw std::runtime_error(file + " is not a URDF");
    }
  }

  const urdf::ModelInterface& model() const { return *model_; }

  /// Pose of a link in the root link, in metres.
  Isometry3d linkPose(const std::string& link, const Posture& posture) const {
    Isometry3d pose = Isometry3d::Identity();
    for (urdf::JointConstSharedPtr joint = model_->links_.at(link)->parent_joint; joint;
         joint = model_->links_.at(joint->parent_link_name)->parent_joint) {
      if (joint->type == urdf::Joint::REVOLUTE) {
        pose = turn(*joint, posture) * pose;
      }
      pose = toIsometry(joint->parent_to_joint_origin_transform) * pose;
    }
    return pose;
  }

 private:
  const urdf::ModelInterfaceSharedPtr model_;
};

// The file's numbers have six decimals.
constexpr double kPrecision = 2e-6;

class Ers7Urdf : public ::testing::Test {
 protected:
  // Checks a link's origin, in millimetres in the body, and the directions of its axes there.
  void expectPose(const std::string& link, const Posture& posture, const Vector3d& millimetres, const Vector3d& x_axis,
                  const Vector3d& z_axis) {
    const Isometry3d pose = urdf_.linkPose(link, posture);
    EXPECT_LT((pose.translation() - millimetres / 1000).norm(), kPrecision) << pose.translation().transpose() * 1000;
    EXPECT_LT((pose.linear().col(0) - x_axis).norm(), kPrecision) << pose.linear().col(0).transpose();
    EXPECT_LT((pose.linear().col(2) - z_axis).norm(), kPrecision) << pose.linear().col(2).transpose();
  }

  const UrdfModel urdf_{ERS7_URDF};
  const robot_model::RobotModel& table_{*robot_model::findRobotModel("ERS-7")};

  const Vector3d forward_{1, 0, 0};
  const Vector3d left_{0, 1, 0};
  const Vector3d up_{0, 0, 1};
};

TEST_F(Ers7Urdf, MovesLikeTheTable) {
  const auto& joints = urdf_.model().joints_;
  EXPECT_EQ(std::count_if(joints.begin(), joints.end(),
                          [](const auto& joint) { return joint.second->type != urdf::Joint::FIXED; }),
            table_.number_of_joints);
  for (int i = 0; i < table_.number_of_joints; ++i) {
    const robot_model::Joint& expected = table_.joints[i];
    SCOPED_TRACE(expected.name);
    const urdf::JointConstSharedPtr joint = urdf_.model().getJoint(expected.name);
    ASSERT_TRUE(joint);
    EXPECT_EQ(joint->type, urdf::Joint::REVOLUTE);
    EXPECT_EQ(joint->child_link_name, joint->name + "_link");
    ASSERT_TRUE(joint->limits);
    EXPECT_EQ(std::lround(joint->limits->lower * 1e6), expected.lowest);
    EXPECT_EQ(std::lround(joint->limits->upper * 1e6), expected.highest);
    EXPECT_EQ(std::lround(joint->limits->velocity * 1e6), expected.highest_speed);
  }
}

// The tail's joints are at (-102, 0, 33). At zero it points up; tilted, forward; and then panned, to the left. Its own
// x is turned down by the tilt and left there by the pan.
TEST_F(Ers7Urdf, HasItsTailBehindAndTurnsItFirstForwardThenToTheLeft) {
  const double right_angle = 90 * kDegree;
  expectPose("tail_pan_link", {}, {-102, 0, 33}, forward_, up_);
  expectPose("tail_pan_link", {{"tail_tilt", right_angle}, {"tail_pan", right_angle}}, {-102, 0, 33}, -up_, left_);
}

// The joints of the head are 80 up the neck, whose joint is at (67.5, 0, 19.5); the camera is 81.06 ahead of them and
// 14.6 below.
TEST_F(Ers7Urdf, LooksLeftIfItPansUpIfItTiltsAndDownIfItsNeckGoesDown) {
  const double right_angle = 90 * kDegree;
  expectPose("camera_link", {{"head_pan", right_angle}}, {67.5, 81.06, 99.5 - 14.6}, left_, up_);
  expectPose("camera_link", {{"head_tilt", right_angle}}, {67.5 + 14.6, 0, 99.5 + 81.06}, up_, -forward_);
  expectPose("camera_link", {{"neck_tilt", -right_angle}}, {67.5 + 80 - 14.6, 0, 19.5 - 81.06}, -up_, forward_);
  expectPose("camera_optical_frame", {}, {67.5 + 81.06, 0, 99.5 - 14.6}, -left_, forward_);
}

TEST_F(Ers7Urdf, HasItsInfraredBeamsWhereTheRobotHasThem) {
  const double down = 30 * kDegree;
  expectPose("range_chest_link", {}, {109.136, 0, -3.384}, {std::cos(down), 0, -std::sin(down)},
             {std::sin(down), 0, std::cos(down)});
  // In the head, 76.9 ahead of its joints at (67.5, 0, 99.5), the near one 2.8 right of the camera, the far one 8.0
  // left.
  const std::map<std::string, Vector3d> places = {{"range_near_link", {67.5 + 76.9, -2.8, 99.5 + 1.9}},
                                                  {"range_far_link", {67.5 + 76.9, 8.0, 99.5 + 1.1}}};
  for (const auto& place : places) {
    const Isometry3d sensor = urdf_.linkPose(place.first, {});
    EXPECT_LT((sensor.translation() * 1000 - place.second).norm(), 0.1) << place.first;
    const Vector3d beam = sensor.linear().col(0);
    EXPECT_LT(std::acos(beam.dot(forward_)), 3 * kDegree) << place.first;
    EXPECT_LT(beam.z(), 0) << place.first;
  }
}

TEST_F(Ers7Urdf, MeasuresAccelerationInTheBodysAxes) {
  EXPECT_TRUE(urdf_.linkPose("imu_link", {}).linear().isIdentity(kPrecision));
}

TEST_F(Ers7Urdf, WeighsWhatSonySays) {
  double mass = 0;
  for (const auto& link : urdf_.model().links_) {
    mass += link.second->inertial ? link.second->inertial->mass : 0;
  }
  EXPECT_NEAR(mass, 1.65, 1e-9);
}

// robot_state_publisher warns about a root link with a mass, because KDL cannot use it.
TEST_F(Ers7Urdf, HasAMassAndAShapeInEveryPartThatMovesAndNoMassAtItsRoot) {
  EXPECT_FALSE(urdf_.model().getRoot()->inertial);
  for (int i = 0; i < table_.number_of_joints; ++i) {
    const urdf::LinkConstSharedPtr link = urdf_.model().getLink(table_.joints[i].name + std::string("_link"));
    EXPECT_TRUE(link->inertial) << link->name;
    EXPECT_TRUE(link->collision) << link->name;
  }
}

class RandomPostures : public Ers7Urdf {
 protected:
  Posture next() {
    Posture posture;
    for (int i = 0; i < table_.number_of_joints; ++i) {
      const robot_model::Joint& joint = table_.joints[i];
      posture[joint.name] = std::uniform_real_distribution<double>(joint.lowest * 1e-6, joint.highest * 1e-6)(random_);
    }
    return posture;
  }

 private:
  std::mt19937 random_{2006};
};

// What the camera sees in its middle, near and far, it can be turned to again; the neck is then at least as upright.
TEST_F(RandomPostures, LookAtWhatTheirCameraSees) {
  std::uniform_real_distribution<double> distance(0.05, 3);
  std::mt19937 random(7);
  for (int i = 0; i < 3000; ++i) {
    int allowed[robot_model::MAX_JOINTS];
    Posture posture = next();
    for (int j = 0; j < table_.number_of_joints; ++j) {
      allowed[j] = static_cast<int>(std::lround(posture[table_.joints[j].name] * 1e6));
    }
    allowed[robot_model::findJointByName(table_, "mouth")] = -52360;  // closed
    robot_model::clampPosture(table_, allowed);
    for (int j = 0; j < table_.number_of_joints; ++j) {
      posture[table_.joints[j].name] = allowed[j] * 1e-6;
    }
    const Vector3d place = urdf_.linkPose("camera_link", posture) * Vector3d(distance(random), 0, 0);
    robot_model::HeadAngles angles;
    const double error = robot_model::findHeadAngles({place.x(), place.y(), place.z()}, &angles);
    ASSERT_LT(error, 0.001) << place.transpose() << ", neck " << posture["neck_tilt"] << ", pan " << posture["head_pan"]
                            << ", tilt " << posture["head_tilt"];
    EXPECT_GE(angles.neck_tilt, posture["neck_tilt"] - 0.006);
    const Vector3d seen =
        urdf_
            .linkPose("camera_link",
                      {{"neck_tilt", angles.neck_tilt}, {"head_pan", angles.head_pan}, {"head_tilt", angles.head_tilt}})
            .inverse() *
        place;
    ASSERT_LT(std::atan2(std::hypot(seen.y(), seen.z()), seen.x()), 0.0011) << place.transpose();
  }
}

TEST_F(RandomPostures, HaveTheFeetWhereTheLegsOfTheRobotModelHaveThem) {
  const std::map<std::string, robot_model::Leg> legs = {{"left_front", robot_model::LEFT_FRONT_LEG},
                                                        {"left_hind", robot_model::LEFT_HIND_LEG},
                                                        {"right_front", robot_model::RIGHT_FRONT_LEG},
                                                        {"right_hind", robot_model::RIGHT_HIND_LEG}};
  for (int i = 0; i < 1000; ++i) {
    const Posture posture = next();
    for (const auto& [name, leg] : legs) {
      const robot_model::Point foot = robot_model::findFoot(
          leg, {posture.at(name + "_rotator"), posture.at(name + "_elevator"), posture.at(name + "_knee")});
      const Vector3d expected = urdf_.linkPose(name + "_foot_link", posture).translation();
      ASSERT_LT((Vector3d(foot.x, foot.y, foot.z) - expected).norm(), kPrecision) << name;
    }
  }
}

}  // namespace
