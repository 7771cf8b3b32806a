#include <aibo_driver/MotionState.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
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
#include "text/plain_text.h"
#include "tools/program.h"
#include "tools/teleop/key_steering.h"
#include "tools/teleop/teleop_node.h"
#include "tools/teleop/terminal.h"

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using teleop::KeySteering;

// The time between two velocities, which is well below the 0.5 s after which the robot stops.
constexpr milliseconds kPeriod{100};

// Longer than keyboards wait before they repeat a key that is held down.
constexpr double kHold = 0.8;          // s
constexpr double kLongestHold = 60.0;  // s

constexpr char kStop = 'S';
constexpr char kRelease = 'R';

std::atomic<bool> is_ending{false};

void end(int) {
  is_ending = true;
}

// Makes signals end the loop, so that the program can stop the robot and restore the terminal.
void endOnSignals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(number, end);
  }
}

/// @throw std::runtime_error a parameter is out of its range
KeySteering readKeys(const ros::NodeHandle& parameters) {
  const double hold = aibo_driver::node::readNumber(parameters, "key_timeout", kHold, kLongestHold);
  return {teleop::readSpeeds(parameters), milliseconds(std::lround(1000 * hold))};
}

void print(const std::string& text) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

void printSpeeds(const teleop::Speeds& speeds) {
  std::printf("speeds: %.3f m/s, sideways %.3f m/s, turn %.2f rad/s\n", speeds.forward, speeds.left, speeds.turn);
  std::fflush(stdout);
}

/// Tells the user once why the robot does not walk as the keys say.
class RefusalNotice {
 public:
  explicit RefusalNotice(ros::NodeHandle handle) {
    movements_ = handle.subscribe("motion_state", 10, &RefusalNotice::receive, this);
  }

 private:
  using EndedMovement = aibo_driver::EndedMovement;

  // The same reason comes again while a key is held down, with the advice to release the key.
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
    if (std::exchange(has_listened_, true) && !reason.empty()) {  // movements that ended before are not shown
      print("The robot does not walk: " + reason + ".");
    }
  }

  bool has_listened_ = false;
  std::string told_;  ///< the reason for the last end; empty after an orderly end
  ros::Subscriber movements_;
};

/// @throw std::runtime_error the terminal cannot be used
void steer(KeySteering* keys, const ros::Publisher& publisher, teleop::StopAndRelease* robot) {
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
      if (*key == kStop) {  // this key stops the walk like every other key, and also calls stop
        robot->stop();
      }
      const bool is_release = *key == kRelease && robot->release();
      const bool changes_speed = !is_release && keys->press(*key, steady_clock::now());
      if (changes_speed) {
        printSpeeds(keys->speeds());
      }
      is_steered = !is_release && !changes_speed;
    } else if (steady_clock::now() < next) {
      continue;
    }
    const aibo_client::WalkVelocity velocity = keys->velocity(steady_clock::now());
    if (walks || is_steered) {  // a key may also stop a walk of another node
      publisher.publish(teleop::toTwist(velocity));
    }
    walks = !velocity.isZero();
    next = steady_clock::now() + kPeriod;
  }
  if (walks) {
    publisher.publish(geometry_msgs::Twist());
    ros::WallDuration(0.2).sleep();  // gives the message time to be sent
  }
}

constexpr char kHelp[] = R"(  rosrun aibo_driver aibo_teleop_keyboard [__ns:=aibo] [_PARAMETER:=VALUE...]

Steers the robot by the keys of this terminal, which it lists when it starts.

  ~speed, ~side_speed  the first speeds, in m/s (0.1 and 0.05)
  ~turn_speed          the same for turns, in rad/s (0.5)
  ~key_timeout         how long a key counts as held down, in s (0.8); 0: until the next key
)";

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::tools::init(argc, argv, "aibo_teleop_keyboard", kHelp, ros::init_options::NoSigintHandler);
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
    teleop::StopAndRelease robot(handle, "R (capital) lets it move again.", print);
    const RefusalNotice refusal_notice(handle);
    steer(&keys, publisher, &robot);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
