// Makes the robot walk as the user presses keys in a terminal.

#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "node/node.h"
#include "node/stop_client.h"
#include "text/plain_text.h"
#include "tools/teleop/key_steering.h"
#include "tools/teleop/service_caller.h"
#include "tools/teleop/terminal.h"

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using std_srvs::Trigger;
using teleop::KeySteering;

// This is well below the 0.5 s after which the robot stops.
constexpr milliseconds kPeriod{100};

// Keyboards wait for less than this before they repeat a key that is held down.
constexpr double kHold = 0.8;          // s
constexpr double kLongestHold = 60.0;  // s

std::atomic<bool> is_ending{false};

void end(int) {
  is_ending = true;
}

// The program handles the signals itself, so that it can stop the robot and restore the terminal.
void endOnSignals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(number, end);
  }
}

geometry_msgs::Twist toTwist(const aibo_client::WalkVelocity& velocity) {
  geometry_msgs::Twist twist;
  twist.linear.x = velocity.forward;
  twist.linear.y = velocity.left;
  twist.angular.z = velocity.turn;
  return twist;
}

/// @throw std::runtime_error a parameter is out of its range
KeySteering readKeys(const ros::NodeHandle& parameters) {
  using aibo_driver::node::readNumber;
  teleop::Speeds speeds;
  speeds.forward = readNumber(parameters, "speed", speeds.forward, 1.0);
  speeds.left = readNumber(parameters, "side_speed", speeds.left, 1.0);
  speeds.turn = readNumber(parameters, "turn_speed", speeds.turn, 10.0);
  const double hold = readNumber(parameters, "key_timeout", kHold, kLongestHold);
  return {speeds, milliseconds(std::lround(1000 * hold))};
}

void printSpeeds(const teleop::Speeds& speeds) {
  std::printf("speeds: %.3f m/s, sideways %.3f m/s, turn %.2f rad/s\n", speeds.forward, speeds.left, speeds.turn);
  std::fflush(stdout);
}

/// Tells the user when somebody has stopped the robot. One key stops it, and another one releases it.
class StopKeys {
 public:
  explicit StopKeys(ros::NodeHandle handle) : stop_(handle), release_(handle) {
    states_ = handle.subscribe("robot_state", 1, &StopKeys::receive, this);
  }

  /// @return true if the key was to release the robot; every other key has something to do with steering, too
  bool press(char key) {
    if (key == kStop) {
      stop_.stop([this](const Trigger::Response* response) { teleop::logAnswer(stop_.service(), response); });
    }
    if (key != kRelease || stopped_by_.empty()) {
      return false;
    }
    release_.call<Trigger>("release", {});
    return true;
  }

 private:
  static constexpr char kStop = 'S';
  static constexpr char kRelease = 'R';

  void receive(const aibo_driver::RobotState::ConstPtr& state) {
    const std::string stopped_by = state->stopped != 0 ? aibo_driver::text::plainLine(state->stopped_by) : "";
    if (stopped_by == std::exchange(stopped_by_, stopped_by)) {
      return;
    }
    if (stopped_by.empty()) {
      std::printf("The robot may move again.\n");
    } else {
      std::printf("%s has stopped the robot. %c (capital) lets it move again.\n", stopped_by.c_str(), kRelease);
    }
    std::fflush(stdout);
  }

  std::string stopped_by_;  ///< empty while the robot may move
  aibo_driver::node::StopClient stop_;
  teleop::ServiceCaller release_;
  ros::Subscriber states_;
};

/// Tells the user once why the robot does not walk as the keys say.
class RefusalNotice {
 public:
  explicit RefusalNotice(ros::NodeHandle handle) {
    movements_ = handle.subscribe("motion_state", 10, &RefusalNotice::receive, this);
  }

 private:
  using EndedMovement = aibo_driver::EndedMovement;

  // While the key is held down, the same reason comes again, with the advice to let go.
  void receive(const aibo_driver::MotionState::ConstPtr& state) {
    const auto is_ours = [](const EndedMovement& each) {
      return each.movement.source == ros::this_node::getName() && each.movement.kind == aibo_driver::Movement::WALK;
    };
    const auto newest = std::find_if(state->ended.rbegin(), state->ended.rend(), is_ours);
    const bool is_orderly = newest == state->ended.rend() || newest->how == EndedMovement::DONE ||
                            newest->how == EndedMovement::STOPPED || newest->how == EndedMovement::REPLACED;
    const std::string reason = is_orderly ? "" : aibo_driver::text::plainLine(newest->reason);
    if (!told_.empty() && reason.rfind(told_, 0) == 0) {
      return;
    }
    told_ = reason;
    if (std::exchange(has_listened_, true) && !reason.empty()) {  // what ended before is no news
      std::printf("The robot does not walk: %s.\n", reason.c_str());
      std::fflush(stdout);
    }
  }

  bool has_listened_ = false;
  std::string told_;  ///< the reason for the last end; empty after an orderly end
  ros::Subscriber movements_;
};

/// @throw std::runtime_error the terminal cannot be used
void steer(KeySteering* keys, const ros::Publisher& publisher, StopKeys* stop_keys) {
  teleop::Terminal terminal(STDIN_FILENO);
  std::printf("\n%s\n", KeySteering::help());
  printSpeeds(keys->speeds());
  bool walks = false;
  steady_clock::time_point next;
  while (!is_ending && ros::ok()) {
    ros::spinOnce();
    const auto wait = std::max(milliseconds(0), std::chrono::ceil<milliseconds>(next - steady_clock::now()));
    bool is_steered = false;
    if (const std::optional<char> key = terminal.readKey(std::min(wait, kPeriod))) {
      const bool is_release = stop_keys->press(*key);
      const bool changes_speed = !is_release && keys->press(*key, steady_clock::now());
      if (changes_speed) {
        printSpeeds(keys->speeds());
      }
      is_steered = !is_release && !changes_speed;
    } else if (steady_clock::now() < next) {
      continue;
    }
    const aibo_client::WalkVelocity velocity = keys->velocity(steady_clock::now());
    if (walks || is_steered) {  // a key may also stop what another node lets walk
      publisher.publish(toTwist(velocity));
    }
    walks = !velocity.isZero();
    next = steady_clock::now() + kPeriod;
  }
  if (walks) {
    publisher.publish(geometry_msgs::Twist());
    ros::WallDuration(0.2).sleep();  // until the message has been sent
  }
}

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_teleop_keyboard", ros::init_options::NoSigintHandler);
  endOnSignals();
  if (!ros::master::check()) {
    std::fprintf(stderr, "There is no ROS master at %s. Start the driver first, or set ROS_MASTER_URI.\n",
                 ros::master::getURI().c_str());
    return EXIT_FAILURE;
  }
  ros::NodeHandle handle = aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo");
  try {
    KeySteering keys = readKeys(ros::NodeHandle("~"));
    const ros::Publisher publisher = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    StopKeys stop_keys(handle);
    const RefusalNotice refusal_notice(handle);
    steer(&keys, publisher, &stop_keys);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
