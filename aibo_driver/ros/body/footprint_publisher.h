/// @file footprint_publisher.h
#ifndef AIBO_DRIVER_ROS_BODY_FOOTPRINT_PUBLISHER_H
#define AIBO_DRIVER_ROS_BODY_FOOTPRINT_PUBLISHER_H

#include <geometry_msgs/Vector3.h>
#include <ros/node_handle.h>
#include <ros/time.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "aibo_driver/telemetry.h"
#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "robot_model/legs.h"
#include "robot_model/robot_model.h"
#include "ros/body/sensor_messages.h"
#include "ros/driver_parameters.h"
#include "ros/robot_stamper.h"

namespace aibo_driver::node {

/// Publishes in tf where the body of an ERS-7 is over the floor: base_link in base_footprint. stance.h says how this is
/// estimated.
class FootprintPublisher {
 public:
  /// All arguments but the handle must outlive the object.
  /// @param model of an ERS-7; the legs of other robots are not known
  FootprintPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                     const robot_model::RobotModel& model, const movement::JointTable& joint_table,
                     const movement::MeasuredJoints& measured_joints, RobotStamper& stamper);

  /// To be called when `measured_joints` has been updated. Publishes once all legs and the acceleration have been
  /// measured, whenever there is a new measurement of a joint. From one thread at a time.
  void publish(const Telemetry& telemetry);

 private:
  void updateAcceleration(const Telemetry& telemetry, const ros::Time& stamp);
  std::optional<std::array<robot_model::LegAngles, robot_model::NUMBER_OF_LEGS>> legs() const;

  const DriverParameters& parameters_;
  const movement::MeasuredJoints& measured_joints_;
  RobotStamper& stamper_;
  /// Rotator, elevator and knee of each leg in the JointTable.
  std::array<std::array<std::size_t, robot_model::JOINTS_OF_A_LEG>, robot_model::NUMBER_OF_LEGS> leg_joints_;
  Accelerometer accelerometer_;
  std::optional<geometry_msgs::Vector3> acceleration_;  ///< smoothed
  ros::Time last_acceleration_;
  std::uint64_t connection_ = 0;
  ros::Publisher publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_FOOTPRINT_PUBLISHER_H
