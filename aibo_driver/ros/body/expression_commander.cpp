#include "ros/body/expression_commander.h"

#include <cstdint>

#include "aibo_driver/exceptions.h"
#include "ros/body/led_command.h"

namespace aibo_driver::node {
namespace {

// Several programs may each command some of the LEDs.
constexpr std::uint32_t kQueueSize = 10;

}  // namespace

ExpressionCommander::ExpressionCommander(const ros::NodeHandle& handle, const robot_model::RobotModel& model,
                                         RcServerClient& client)
    : model_(model), client_(client) {
  ros::NodeHandle topics(handle);
  const boost::function<void(const Leds::ConstPtr&)> receive_leds = [this](const Leds::ConstPtr& message) {
    receiveLeds(*message);
  };
  leds_ = topics.subscribe<Leds>("leds", kQueueSize, receive_leds);
  const boost::function<void(const Ears::ConstPtr&)> receive_ears = [this](const Ears::ConstPtr& message) {
    receiveEars(*message);
  };
  ears_ = topics.subscribe<Ears>("ears", kQueueSize, receive_ears);
}

void ExpressionCommander::receiveLeds(const Leds& message) {
  const LedOrders orders = parseLeds(message, model_);
  for (const std::string& refusal : orders.refusals) {
    warnings_.warn(refusal);
  }
  if (!orders.commands.empty()) {
    send("LEDs", [this, &orders] { client_.commandLeds(orders.commands); });
  }
}

void ExpressionCommander::receiveEars(const Ears& message) {
  send("ears", [this, &message] { client_.commandEars(message.left != 0, message.right != 0); });
}

void ExpressionCommander::send(const std::string& what, const std::function<void()>& command) {
  try {
    command();
  } catch (const StoppedException&) {
    return;  // the driver ends
  } catch (const Exception& error) {
    warnings_.warn("A command to the " + what + " was dropped: " + error.what());
  }
}

}  // namespace aibo_driver::node
