/// @file color_table_service.h
#ifndef AIBO_DRIVER_NODE_CAMERA_COLOR_TABLE_SERVICE_H
#define AIBO_DRIVER_NODE_CAMERA_COLOR_TABLE_SERVICE_H

#include <aibo_driver/LoadColorTable.h>

#include <functional>
#include <string>

#include "aibo_client/rcserver_client.h"
#include "node/services.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// The tables of the colour detection: the ones loaded at the start, and the service load_color_table.
class ColorTableService {
 public:
  /// @param model, client must outlive the object
  /// @param loaded called with each table that a channel gets, and with null if the channel loses its table
  ColorTableService(const robot_model::RobotModel& model, aibo_client::RcServerClient& client,
                    std::function<void(int channel, const aibo_client::ColorTablePtr& table)> loaded);

  /// Loads tables for the channels 0, 1 and so on. If a table cannot be loaded, its channel stays empty, and the reason
  /// is logged.
  /// @param tables files or names for camera::loadColorTable(), separated by blanks or commas
  void loadAtStart(const std::string& tables);

  /// The service load_color_table. This object must outlive it.
  Services services();

 private:
  std::string load(const LoadColorTable::Request& request);
  std::string setTable(int channel, const aibo_client::ColorTablePtr& table);

  const robot_model::RobotModel& model_;
  aibo_client::RcServerClient& client_;
  const std::function<void(int channel, const aibo_client::ColorTablePtr& table)> loaded_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_COLOR_TABLE_SERVICE_H
