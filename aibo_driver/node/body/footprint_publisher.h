/// @file footprint_publisher.h
#ifndef AIBO_DRIVER_NODE_BODY_FOOTPRINT_PUBLISHER_H
#define AIBO_DRIVER_NODE_BODY_FOOTPRINT_PUBLISHER_H

#include <ros/node_handle.h>
#include <ros/time.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "aibo_client/telemetry.h"
#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "node/body/body_pose.h"
#include "node/body/sensor_messages.h"
#include "node/driver_parameters.h"
#include "node/robot_stamper.h"
#include "robot_model/legs.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// Publishes the pose of an ERS-7's body above the floor in tf: base_link in base_footprint. stance.h says how this is
/// estimated.
class FootprintPublisher {
 public:
  /// All arguments except the handle must outlive the object.
  /// @param model must be an ERS-7, because the legs of other robots are not known
  FootprintPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                     const robot_model::RobotModel& model, const movement::JointTable& joint_table,
                     const movement::MeasuredJoints& measured_joints, RobotStamper& stamper);

  /// Call this when `measured_joints` has been updated. It publishes whenever a joint has been measured anew, once all
  /// legs and the acceleration have been measured. Only one thread at a time may call it.
  void publish(const aibo_client::Telemetry& telemetry);

 private:
  void updateAcceleration(const aibo_client::Telemetry& telemetry, const ros::Time& stamp);
  std::optional<std::array<robot_model::LegAngles, robot_model::NUMBER_OF_LEGS>> legs() const;

  const DriverParameters& parameters_;
  const movement::MeasuredJoints& measured_joints_;
  RobotStamper& stamper_;
  /// The indices of the rotator, elevator and knee of each leg in the JointTable.
  std::array<std::array<std::size_t, robot_model::JOINTS_OF_A_LEG>, robot_model::NUMBER_OF_LEGS> leg_joints_;
  Accelerometer accelerometer_;
  BodyPose pose_;
  std::uint64_t connection_ = 0;
  ros::Publisher publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_FOOTPRINT_PUBLISHER_H
