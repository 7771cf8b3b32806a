#include "workload.h"

#include <aibo_driver/DeleteMotion.h>
#include <aibo_driver/Ears.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/StopMotion.h>
#include <aibo_driver/TakePicture.h>
#include <aibo_driver/UploadMotion.h>
#include <ros/service.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "robot_model/robot_model.h"
#include "support/ros/joint_messages.h"

namespace soak {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

// Each call is answered within these times, according to docs/ros_interface.md.
constexpr seconds kAtOnce{0};
constexpr seconds kOfBody{2};  // also pictures
constexpr seconds kOfMemoryStick{5};
constexpr seconds kOfUpload{15};

constexpr seconds kHeldUp{3};       // by a busy computer
constexpr seconds kNeverAny{60};    // a call that takes longer is given up
constexpr seconds kMeasurement{5};  // several come each second

constexpr const char* kPlayed = "nod";
constexpr const char* kUploaded = "soak";

constexpr double kMicro = 1e-6;

const robot_model::Joint& anyJoint(Random& random) {
  const robot_model::RobotModel* model = robot_model::findRobotModel("ERS-7");
  return model->joints[std::uniform_int_distribution<int>(0, model->number_of_joints - 1)(random)];
}

double anyPosition(const robot_model::Joint& joint, Random& random) {
  return kMicro * std::uniform_int_distribution<int>(joint.lowest, joint.highest)(random);
}

bool maybe(Random& random) {
  return std::bernoulli_distribution()(random);
}

}  // namespace

// Only the last one moves joints.
const std::vector<Workload::ServiceCall> Workload::kServiceCalls = {
    &Workload::takePicture,   &Workload::switchStreamOn, &Workload::switchMotorsOn, &Workload::listMotions,
    &Workload::changeMotions, &Workload::askForPower,    &Workload::stopMotion,     &Workload::playMotion,
};

Workload::Workload(const std::string& name_space, const std::string& motion, Violations* violations)
    : node_(name_space),
      motion_(motion),
      violations_(violations),
      joint_command_(node_.advertise<sensor_msgs::JointState>("joint_command", 10)),
      trajectory_(node_.advertise<trajectory_msgs::JointTrajectory>("joint_trajectory", 10)),
      leds_(node_.advertise<aibo_driver::Leds>("leds", 10)),
      ears_(node_.advertise<aibo_driver::Ears>("ears", 10)),
      joint_states_(node_.subscribe("joint_states", 100, &Workload::onJointState, this)) {}

void Workload::doSomething(Random& random) {
  switch (std::uniform_int_distribution<int>(0, 9)(random)) {
    case 0:
      return light(random);
    case 1:
      return flickEars(random);
    case 2:
      return (this->*anyOf(kServiceCalls.size(), random))(random, Expected::kSuccess);
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

// The head turns within 4 s: slowly enough for every speed limit, and long enough for a fault to begin meanwhile.
void Workload::beginTrajectory(Random& random) {
  const double position = std::uniform_real_distribution<double>(-1.4, 1.4)(random);
  trajectory_.publish(test_support::trajectory({{"head_pan", position}}, 4.0));
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

// Subscribes to decoded pictures, or unsubscribes.
void Workload::lookAtImages() {
  if (images_) {
    images_.shutdown();
    images_ = ros::Subscriber();
  } else {
    images_ = node_.subscribe("camera/image_raw", 1, &Workload::onImage, this);
  }
}

void Workload::callEveryService(Random& random) {
  for (const ServiceCall service : kServiceCalls) {
    (this->*service)(random, Expected::kSuccess);
  }
}

void Workload::callAnyService(Random& random) {
  (this->*anyOf(kServiceCalls.size() - 1, random))(random, Expected::kAnswer);
}

Workload::ServiceCall Workload::anyOf(std::size_t first, Random& random) {
  return kServiceCalls[std::uniform_int_distribution<std::size_t>(0, first - 1)(random)];
}

void Workload::takePicture(Random& random, Expected expected) {
  aibo_driver::TakePicture picture;
  picture.request.quality = static_cast<std::uint8_t>(std::uniform_int_distribution<int>(1, 100)(random));
  call("take_picture", picture, kOfBody, expected);
}

void Workload::switchStreamOn(Random& /*random*/, Expected expected) {
  setStreaming(true, expected);
}

void Workload::toggleStream() {
  setStreaming(false, Expected::kSuccess);
  setStreaming(true, Expected::kSuccess);
}

void Workload::setStreaming(bool on, Expected expected) {
  std_srvs::SetBool streaming;
  streaming.request.data = on;
  call("set_streaming", streaming, kAtOnce, expected);
}

void Workload::switchMotorsOn(Random& /*random*/, Expected expected) {
  std_srvs::SetBool motors;
  motors.request.data = true;
  call("motors", motors, kOfBody, expected);
}

void Workload::listMotions(Random& /*random*/, Expected expected) {
  call("list_motions", aibo_driver::ListMotions(), kOfMemoryStick, expected);
}

void Workload::changeMotions(Random& /*random*/, Expected expected) {
  aibo_driver::UploadMotion upload;
  upload.request.name = kUploaded;
  upload.request.file = motion_;
  call("upload_motion", upload, kOfUpload, expected);
  aibo_driver::DeleteMotion deletion;
  deletion.request.name = kUploaded;
  call("delete_motion", deletion, kOfMemoryStick, expected);
}

// The robot refuses it.
void Workload::askForPower(Random& random, Expected /*expected*/) {
  call(maybe(random) ? "shut_down" : "reboot", std_srvs::Trigger(), kOfMemoryStick, Expected::kAnswer);
}

// A motion that is playing cannot be played again before it is stopped.
void Workload::stopMotion(Random& /*random*/, Expected expected) {
  aibo_driver::StopMotion motion;
  motion.request.name = kPlayed;
  call("stop_motion", motion, kOfBody, expected);
}

void Workload::playMotion(Random& random, Expected expected) {
  stopMotion(random, expected);
  aibo_driver::PlayMotion motion;
  motion.request.name = kPlayed;
  motion.request.repetitions = 1;
  call("play_motion", motion, kOfBody, expected);
}

// In a thread of its own, because the call cannot be interrupted.
template <typename Service>
void Workload::call(const std::string& name, const Service& service, seconds longest, Expected expected) {
  const auto answer = std::make_shared<Service>(service);
  const auto begin = steady_clock::now();
  std::future<bool> answered = std::async(std::launch::async, [answer, full_name = node_.resolveName(name)] {
    return ros::service::call(full_name, *answer);
  });
  const bool over = answered.wait_for(kNeverAny) == std::future_status::ready;
  const auto time = std::chrono::duration_cast<milliseconds>(steady_clock::now() - begin);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++calls_;
    longest_call_ = std::max(longest_call_, time);
    if (!over) {
      given_up_.push_back(std::move(answered));
      throw Unanswered(name + " was not answered within " + std::to_string(kNeverAny.count()) + " s");
    }
  }
  if (!answered.get()) {
    violations_->add(name + " was not answered");
  } else if (expected == Expected::kSuccess && !answer->response.success) {
    violations_->add(name + ": " + answer->response.message);
  }
  if (time > longest + kHeldUp) {
    violations_->add(name + " took " + std::to_string(time.count()) + " ms, more than " +
                     std::to_string(longest.count()) + " s");
  }
}

void Workload::onJointState(const sensor_msgs::JointState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (message.header.stamp <= measured_) {
    violations_->add("a stamp of joint_states is not later than the last one");
  }
  measured_ = message.header.stamp;
  for (std::size_t i = 0; i < message.name.size(); ++i) {
    positions_[message.name[i]] = message.position[i];
  }
  changed_.notify_all();
}

void Workload::onImage(const sensor_msgs::Image& image) {
  const std::lock_guard<std::mutex> lock(mutex_);
  seen_ = image.header.stamp;
  changed_.notify_all();
}

std::map<std::string, double> Workload::measure() {
  const ros::Time begin = ros::Time::now();
  std::unique_lock<std::mutex> lock(mutex_);
  if (!changed_.wait_for(lock, kMeasurement, [&] { return measured_ > begin; })) {
    violations_->add("no joint_states came");
  }
  if (images_ && !changed_.wait_for(lock, kMeasurement, [&] { return seen_ > begin; })) {
    violations_->add("no decoded pictures came");
  }
  return positions_;
}

std::size_t Workload::calls() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return calls_;
}

milliseconds Workload::longestCall() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return longest_call_;
}

ServiceCalls::ServiceCalls(Workload* workload, Random::result_type seed)
    : calls_(std::async(std::launch::async, [this, workload, seed] {
        Random random(seed);
        while (!ending_) {
          workload->callAnyService(random);
          std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<int>(0, 300)(random)));
        }
      })) {}

ServiceCalls::~ServiceCalls() {
  ending_ = true;
}

void ServiceCalls::end() {
  ending_ = true;
  calls_.get();
}

}  // namespace soak
