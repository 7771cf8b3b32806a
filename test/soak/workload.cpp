#include "workload.h"

#include <aibo_driver/Ears.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/TakePicture.h>
#include <ros/service.h>
#include <std_srvs/SetBool.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>

#include "robot_model/robot_model.h"

namespace soak {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// take_picture ends after 2 s at the latest, what the memory stick has to do with after 5 s; and a busy computer.
constexpr milliseconds kLongestCall{8000};

constexpr double kMicro = 1e-6;

const robot_model::Joint& anyJoint(Random& random) {
  const robot_model::RobotModel* model = robot_model::findRobotModel("ERS-7");
  return model->joints[std::uniform_int_distribution<int>(0, model->number_of_joints - 1)(random)];
}

double anyPosition(const robot_model::Joint& joint, Random& random) {
  return kMicro * std::uniform_int_distribution<int>(joint.lowest, joint.highest)(random);
}

void ignore(const sensor_msgs::ImageConstPtr& /*image*/) {}

bool maybe(Random& random) {
  return std::bernoulli_distribution()(random);
}

}  // namespace

Workload::Workload(const std::string& name_space, Violations* violations)
    : node_(name_space),
      violations_(violations),
      joint_command_(node_.advertise<sensor_msgs::JointState>("joint_command", 10)),
      trajectory_(node_.advertise<trajectory_msgs::JointTrajectory>("joint_trajectory", 10)),
      leds_(node_.advertise<aibo_driver::Leds>("leds", 10)),
      ears_(node_.advertise<aibo_driver::Ears>("ears", 10)),
      joint_states_(node_.subscribe("joint_states", 100, &Workload::onJointState, this)) {}

void Workload::doSomething(Random& random, bool connected) {
  switch (std::uniform_int_distribution<int>(0, 9)(random)) {
    case 0:
      return light(random);
    case 1:
      return flickEars(random);
    case 2:
      return callService(random, connected);
    case 3:
      return lookAtImages();
    case 4:
      return beginTrajectory(random);
    default:
      return moveJoints(random);
  }
}

void Workload::moveJoints(Random& random) {
  sensor_msgs::JointState command;
  for (int i = 0; i < 3; ++i) {
    const robot_model::Joint& joint = anyJoint(random);
    if (std::find(command.name.begin(), command.name.end(), joint.name) == command.name.end()) {
      command.name.emplace_back(joint.name);
      command.position.push_back(anyPosition(joint, random));
    }
  }
  joint_command_.publish(command);
}

// The head turns within 4 s: slow enough for every speed limit, and under way for as long as faults need to begin.
void Workload::beginTrajectory(Random& random) {
  trajectory_msgs::JointTrajectory trajectory;
  trajectory.joint_names = {"head_pan"};
  trajectory.points.resize(1);
  trajectory.points[0].positions = {std::uniform_real_distribution<double>(-1.4, 1.4)(random)};
  trajectory.points[0].time_from_start = ros::Duration(4.0);
  trajectory_.publish(trajectory);
}

void Workload::light(Random& random) {
  aibo_driver::Leds command;
  command.names = {maybe(random) ? "face" : "back"};
  command.intensities = {std::uniform_real_distribution<float>(0, 1)(random)};
  leds_.publish(command);
}

void Workload::flickEars(Random& random) {
  aibo_driver::Ears command;
  command.left = maybe(random);
  command.right = maybe(random);
  ears_.publish(command);
}

void Workload::callService(Random& random, bool connected) {
  switch (std::uniform_int_distribution<int>(0, 3)(random)) {
    case 0:
      return call("list_motions", aibo_driver::ListMotions(), connected);
    case 1: {
      aibo_driver::PlayMotion motion;
      motion.request.stop = true;  // else it is refused while it plays
      call("play_motion", motion, connected);
      motion.request.stop = false;
      motion.request.name = "nod";
      return call("play_motion", motion, connected);
    }
    default: {
      aibo_driver::TakePicture picture;
      picture.request.quality = static_cast<std::uint8_t>(std::uniform_int_distribution<int>(1, 100)(random));
      return call("take_picture", picture, connected);
    }
  }
}

// Decoded pictures are wanted for a while, and then no more.
void Workload::lookAtImages() {
  if (images_) {
    images_.shutdown();
    images_ = ros::Subscriber();
  } else {
    images_ = node_.subscribe("camera/image_raw", 1, &ignore);
  }
}

void Workload::toggleStream() {
  for (const bool on : {false, true}) {
    std_srvs::SetBool streaming;
    streaming.request.data = on;
    call("set_streaming", streaming, true);
  }
}

template <typename Service>
void Workload::call(const std::string& name, Service service, bool connected) {
  const auto begin = steady_clock::now();
  const bool answered = ros::service::call(node_.resolveName(name), service);
  const auto time = std::chrono::duration_cast<milliseconds>(steady_clock::now() - begin);
  ++calls_;
  longest_call_ = std::max(longest_call_, time);
  if (!answered) {
    violations_->add(name + " was not answered");
  } else if (connected && !service.response.success) {
    violations_->add(name + ": " + service.response.message);
  }
  if (time > kLongestCall) {
    violations_->add(name + " took " + std::to_string(time.count()) + " ms");
  }
}

void Workload::onJointState(const sensor_msgs::JointState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (message.header.stamp <= last_stamp_) {
    violations_->add("a stamp of joint_states is not after that of the one before");
  }
  last_stamp_ = message.header.stamp;
  for (std::size_t i = 0; i < message.name.size(); ++i) {
    positions_[message.name[i]] = message.position[i];
  }
}

std::map<std::string, double> Workload::jointPositions() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return positions_;
}

}  // namespace soak
