#include "order_user.h"

#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/StopMotion.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "robot_model/robot_model.h"
#include "support/ros/joints.h"

namespace soak {
namespace {

using std::chrono::milliseconds;

constexpr int kUsers = 5;
constexpr unsigned kNoRound = std::numeric_limits<unsigned>::max();  // odd
constexpr double kMicro = 1e-6;

double now() {
  return ros::WallTime::now().toSec();
}

class User {
 public:
  User(const std::string& name_space, unsigned number, unsigned seed)
      : handle_(name_space), number_(static_cast<int>(number)), random_(seed), name_(ros::this_node::getName()) {
    orders_ = handle_.advertise<sensor_msgs::JointState>(kUserOrders, 10000);
    calls_ = handle_.advertise<std_msgs::String>(kUserCalls, 10000);
    commands_ = handle_.advertise<sensor_msgs::JointState>("joint_command", 100);
    trajectories_ = handle_.advertise<trajectory_msgs::JointTrajectory>("joint_trajectory", 100);
    velocities_ = handle_.advertise<geometry_msgs::Twist>("cmd_vel", 100);
    model_ = robot_model::findRobotModel("ERS-7");
    rounds_ = handle_.subscribe<std_msgs::UInt32>(
        kUserRuns, 10, [this](const std_msgs::UInt32::ConstPtr& round) { round_ = round->data; });
  }

  void run() {
    while (calls_.getNumSubscribers() == 0 && ros::ok()) {
      pause(5, 20);
    }
    unsigned told = kNoRound;
    while (ros::ok()) {
      const unsigned round = round_;
      if (round % 2 == 0) {
        giveAnyOrder();
        pause(50, 1200);
      } else if (round != told) {
        told = round;
        log({name_, kQuiet, now(), now(), true, std::to_string(round)});
      } else {
        pause(5, 20);
      }
    }
  }

 private:
  int uniform(int lowest, int highest) { return std::uniform_int_distribution<int>(lowest, highest)(random_); }
  void pause(int shortest, int longest) { std::this_thread::sleep_for(milliseconds(uniform(shortest, longest))); }
  bool mayGoOn() const { return round_ % 2 == 0 && ros::ok(); }

  void log(const Call& call) {
    std_msgs::String message;
    message.data = toText(call);
    calls_.publish(message);
  }

  void giveAnyOrder() {
    const int what = uniform(0, 99);
    if (what < 40) {
      commandJoints();
    } else if (what < 55) {
      followTrajectory();
    } else if (what < 70) {
      walk();
    } else if (what < 80) {
      aibo_driver::PlayMotion motion;
      motion.request.name = uniform(0, 1) == 0 ? "nod" : "wag";
      call("play_motion", motion);
    } else if (what < 83) {
      call<aibo_driver::StopMotion>("stop_motion");
    } else if (what < 90) {
      call<std_srvs::Trigger>(
          std::vector<const char*>{"stand", "sit", "rest"}[static_cast<std::size_t>(uniform(0, 2))]);
    } else if (what < 94) {
      switchMotors();
    } else {
      stopForAWhile();
    }
  }

  // Each user has every fifth microradian for itself.
  double anyTarget(const robot_model::Joint& joint) {
    int target = 0;
    do {
      target = uniform(joint.lowest / kUsers + 1, joint.highest / kUsers - 1) * kUsers;
      target += target >= 0 ? number_ : -number_;
    } while (!used_.insert({joint.identifier, target}).second);
    return kMicro * target;
  }

  Targets anyTargets() {
    Targets targets;
    while (targets.size() < 2) {
      const robot_model::Joint& joint = model_->joints[uniform(0, model_->number_of_joints - 1)];
      targets[joint.name] = anyTarget(joint);
    }
    return targets;
  }

  void commandJoints() {
    sensor_msgs::JointState order = test_support::command(anyTargets());
    const ros::Time time = ros::Time::now();
    commands_.publish(order);
    order.header.stamp = time;
    order.header.frame_id = name_;
    orders_.publish(order);
  }

  void followTrajectory() {
    const double duration = 0.1 * uniform(5, 40);
    trajectories_.publish(test_support::trajectory(anyTargets(), duration));
  }

  // Ends by a zero or by silence.
  void walk() {
    geometry_msgs::Twist twist;
    twist.linear.x = 0.01 * uniform(-8, 12);
    twist.angular.z = 0.1 * uniform(-5, 5);
    for (int i = uniform(1, 25); i > 0 && mayGoOn(); --i) {
      velocities_.publish(twist);
      pause(100, 100);
    }
    if (uniform(0, 1) == 0) {
      velocities_.publish(geometry_msgs::Twist());
    }
  }

  template <typename Service>
  void call(const std::string& name, Service service = Service()) {
    Call each{name_, name, now()};
    const bool answered = ros::service::call(handle_.resolveName(name), service);
    each.end = now();
    each.success = answered && service.response.success;
    each.message = answered ? service.response.message : kNoAnswer;
    log(each);
  }

  void switchMotors() {
    std_srvs::SetBool motors;
    motors.request.data = 0;
    call("motors", motors);
    pause(100, 1500);
    if (uniform(0, 1) == 0) {
      motors.request.data = 1;
      call("motors", motors);
    } else {
      call<std_srvs::Trigger>("stand");
    }
  }

  void stopForAWhile() {
    call<std_srvs::Trigger>("stop");
    pause(500, 3000);
    if (uniform(0, 5) == 0) {
      call<std_srvs::Trigger>("rest");
    }
    call<std_srvs::Trigger>("release");
  }

  ros::NodeHandle handle_;
  const int number_;
  std::mt19937 random_;
  const std::string name_;
  const robot_model::RobotModel* model_;
  std::set<std::pair<int, int>> used_;  ///< ids of joints and targets
  std::atomic<unsigned> round_{kNoRound};
  ros::Publisher orders_;
  ros::Publisher calls_;
  ros::Publisher commands_;
  ros::Publisher trajectories_;
  ros::Publisher velocities_;
  ros::Subscriber rounds_;
};

}  // namespace

std::string toText(const Call& call) {
  std::ostringstream text;
  text.precision(17);
  text << call.user << ' ' << call.service << ' ' << call.begin << ' ' << call.end << ' ' << call.success << ' '
       << call.message;
  return text.str();
}

Call parseCall(const std::string& text) {
  std::istringstream words(text);
  Call call;
  words >> call.user >> call.service >> call.begin >> call.end >> call.success;
  std::getline(words >> std::ws, call.message);
  return call;
}

void runUser(const std::string& name_space, unsigned number, unsigned seed) {
  ros::AsyncSpinner spinner(1);
  spinner.start();
  User(name_space, number, seed).run();
}

}  // namespace soak
