#include <aibo_driver/LoadColorTable.h>
#include <ros/package.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "aibo_client/exceptions.h"
#include "camera/color_table_file.h"
#include "node/service.h"
#include "node/services.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

using aibo_client::ColorTable;
using aibo_client::ColorTablePtr;
using camera::ColorTableException;

namespace {

ColorTablePtr tableIn(const std::string& file) {
  return std::make_shared<ColorTable>(
      camera::loadColorTable(file, ros::package::getPath("aibo_driver") + "/config/colors"));
}

void requireChannel(int channel, const robot_model::RobotModel& model) {
  if (channel >= model.number_of_color_channels) {
    throw ColorTableException("there is no channel " + std::to_string(channel) + ": an " + model.design +
                              " has the channels 0 to " + std::to_string(model.number_of_color_channels - 1) + ".");
  }
}

std::string load(const LoadColorTable::Request& request, const robot_model::RobotModel& model,
                 const aibo_client::RcServerClient& client, const SetColorTable& set_table) {
  if (!request.file.empty() && !request.table.empty()) {
    throw ColorTableException("file and table are both given; leave one of them empty.");
  }
  ColorTablePtr table;
  if (!request.file.empty()) {
    table = tableIn(request.file);
  } else if (!request.table.empty()) {
    table = std::make_shared<ColorTable>(camera::parseColorTable(request.table, "table"));
  }
  requireChannel(request.channel, model);
  set_table(request.channel, table);
  const std::string done =
      "Channel " + std::to_string(request.channel) + " has " + (table ? "the table " + table->name : "no table");
  const aibo_client::ConnectionStatus status = client.status();
  if (status.state != aibo_client::ConnectionState::kConnected) {
    return done + ". The robot gets it as soon as it is connected.";
  }
  if (!status.robot.hasCapability("Z")) {
    throw ColorTableException("the robot's server detects no colours. It needs a newer RCServer; the table is kept.");
  }
  return done + ". The robot gets it while color_regions or color_mask has a subscriber.";
}

}  // namespace

Services colorTableServices(const robot_model::RobotModel& model, const aibo_client::RcServerClient& client,
                            const SetColorTable& set_table) {
  return {service<LoadColorTable>("load_color_table", "No table was loaded", [&model, &client, set_table](auto& call) {
    return load(call.request, model, client, set_table);
  })};
}

void loadColorTables(const std::string& tables, const robot_model::RobotModel& model, const SetColorTable& set_table) {
  std::string names = tables;
  std::replace(names.begin(), names.end(), ',', ' ');
  std::istringstream words(names);
  int channel = 0;
  for (std::string name; words >> name; ++channel) {
    try {
      requireChannel(channel, model);
      set_table(channel, tableIn(name));
    } catch (const aibo_client::Exception& error) {
      throw aibo_client::InvalidArgumentException("Parameter color_tables names the table '" + text::plainLine(name) +
                                                  "', which cannot be loaded: " + text::plainLine(error.what(), 500));
    }
  }
}

}  // namespace aibo_driver::node
