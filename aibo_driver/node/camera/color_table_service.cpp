#include "node/camera/color_table_service.h"

#include <ros/package.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>

#include "camera/color_table_file.h"
#include "node/service.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

using aibo_client::ColorTable;
using aibo_client::ColorTablePtr;

namespace {

ColorTablePtr tableIn(const std::string& file) {
  return std::make_shared<ColorTable>(
      camera::loadColorTable(file, ros::package::getPath("aibo_driver") + "/config/colors"));
}

}  // namespace

ColorTableService::ColorTableService(const robot_model::RobotModel& model, aibo_client::RcServerClient& client,
                                     std::function<void(int channel, const ColorTablePtr& table)> loaded)
    : model_(model), client_(client), loaded_(std::move(loaded)) {}

void ColorTableService::loadAtStart(const std::string& tables) {
  std::string names = tables;
  std::replace(names.begin(), names.end(), ',', ' ');
  std::istringstream words(names);
  int channel = 0;
  for (std::string name; words >> name; ++channel) {
    try {
      setTable(channel, tableIn(name));
    } catch (const aibo_client::Exception& error) {
      throw aibo_client::InvalidArgumentException("Parameter color_tables names the table '" + text::plainLine(name) +
                                                  "', which cannot be loaded: " + text::plainLine(error.what(), 500));
    }
  }
}

Services ColorTableService::services() {
  return {service<LoadColorTable>("load_color_table", "No table was loaded",
                                  [this](auto& call) { return load(call.request); })};
}

std::string ColorTableService::load(const LoadColorTable::Request& request) {
  if (!request.file.empty() && !request.table.empty()) {
    throw camera::ColorTableException("file and table are both given; leave one of them empty.");
  }
  ColorTablePtr table;
  if (!request.file.empty()) {
    table = tableIn(request.file);
  } else if (!request.table.empty()) {
    table = std::make_shared<ColorTable>(camera::parseColorTable(request.table, "table"));
  }
  const std::string done = setTable(request.channel, table);
  const aibo_client::ConnectionStatus status = client_.status();
  if (status.state != aibo_client::ConnectionState::kConnected) {
    return done + ". There is no connection now; the robot gets it with the next one.";
  }
  if (!status.robot.hasCapability("Z")) {
    throw camera::ColorTableException(
        "the robot's server detects no colours. It needs a newer RCServer; the table is kept.");
  }
  return done + ". The robot gets it while color_regions or color_mask has a subscriber.";
}

/// @return what the channel detects now
std::string ColorTableService::setTable(int channel, const ColorTablePtr& table) {
  if (channel >= model_.number_of_color_channels) {
    throw camera::ColorTableException("there is no channel " + std::to_string(channel) + ": an " + model_.design +
                                      " has the channels 0 to " + std::to_string(model_.number_of_color_channels - 1) +
                                      ".");
  }
  client_.setColorTable(channel, table);
  loaded_(channel, table);
  return "Channel " + std::to_string(channel) + " detects " + (table ? table->name : "nothing");
}

}  // namespace aibo_driver::node
