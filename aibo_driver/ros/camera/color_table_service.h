/// @file color_table_service.h
#ifndef AIBO_DRIVER_ROS_CAMERA_COLOR_TABLE_SERVICE_H
#define AIBO_DRIVER_ROS_CAMERA_COLOR_TABLE_SERVICE_H

#include <aibo_driver/LoadColorTable.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "aibo_driver/rcserver_client.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// The tables of the colour detection: those loaded at the start, and the service load_color_table.
class ColorTableService {
 public:
  /// @param model of the robot
  /// @param client must outlive the object, as model
  /// @param loaded is told each table that a channel gets; null: it has none any more
  ColorTableService(const robot_model::RobotModel& model, RcServerClient& client,
                    std::function<void(int channel, const ColorTablePtr& table)> loaded);

  /// Loads tables for the channels 0, 1 and so on. One that cannot be loaded is logged, and its channel left empty.
  /// @param tables files or names for loadColorTable(), separated by blanks or commas
  void loadAtStart(const std::string& tables);

  /// @param handle the driver's namespace
  void advertise(const ros::NodeHandle& handle);

  /// Carries out a call of the service.
  bool load(LoadColorTable::Request& request, LoadColorTable::Response& response);

 private:
  std::string carryOut(const LoadColorTable::Request& request);
  std::string setTable(int channel, const ColorTablePtr& table);

  const robot_model::RobotModel& model_;
  RcServerClient& client_;
  const std::function<void(int channel, const ColorTablePtr& table)> loaded_;
  ros::ServiceServer service_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_COLOR_TABLE_SERVICE_H
