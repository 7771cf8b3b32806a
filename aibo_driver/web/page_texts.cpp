#include "web/page_texts.h"

#include <algorithm>
#include <vector>

#include "text/json.h"
#include "text/plain_text.h"

namespace aibo_driver::web {
namespace {

using text::Json;

Json shown(const std::string& words) {
  constexpr std::size_t kMostBytes = 500;
  return text::plainLine(words, kMostBytes);
}

}  // namespace

std::string pageText(const Connection& message) {
  const bool is_connected = message.state == Connection::CONNECTED;
  return Json::object({{"type", "connection"}, {"is_connected", is_connected}, {"text", shown(message.text)}}).text();
}

std::string pageText(const RobotState& message) {
  const std::string stopped_by = message.stopped != 0 ? message.stopped_by : "";
  return Json::object({{"type", "robot"},
                       {"posture", static_cast<int>(message.posture)},
                       {"motors", static_cast<int>(message.motors)},
                       {"stopped_by", shown(stopped_by)}})
      .text();
}

std::string pageText(const MotionState& message) {
  return pageText("moves", message.text);
}

std::string pageText(const sensor_msgs::BatteryState& message) {
  return Json::object({{"type", "battery"}, {"charge", static_cast<double>(message.percentage)}}).text();
}

std::string pageText(const LinkQuality& message) {
  return Json::object({{"type", "link"},
                       {"rate", static_cast<double>(message.pictures_per_second)},
                       {"age", static_cast<double>(message.age)},
                       {"lost", static_cast<double>(message.lost)}})
      .text();
}

std::string pageText(const ListMotions::Response& response) {
  constexpr std::size_t kMost = 200;
  std::vector<Json> names;
  std::transform(response.names.begin(), response.names.begin() + std::min(response.names.size(), kMost),
                 std::back_inserter(names), shown);
  return Json::object({{"type", "motions"}, {"names", Json::array(names)}}).text();
}

std::string pageText(const std::string& type, const std::string& words) {
  return Json::object({{"type", type}, {"text", shown(words)}}).text();
}

}  // namespace aibo_driver::web
