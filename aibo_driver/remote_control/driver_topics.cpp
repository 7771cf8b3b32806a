#include "remote_control/driver_topics.h"

#include <aibo_driver/Ears.h>
#include <aibo_driver/LedStates.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/LookAtResult.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/Touch.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Twist.h>
#include <ros/names.h>
#include <ros/this_node.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <utility>

#include "camera/jpeg_decoder.h"
#include "node/bounded_message.h"
#include "remote_control/messages.h"

namespace aibo_driver::remote_control {
namespace {

using std::chrono::steady_clock;

// How long a driver may be silent. It sends something once a second.
constexpr std::chrono::seconds kTimeToSpeak{5};
constexpr std::chrono::seconds kHeardFor{3};

// How many messages are kept: the joints of a robot of version 1 come one by one, and no short touch must be missed.
constexpr std::uint32_t kAllOfThem = 16;
constexpr std::uint32_t kTheNewest = 1;

// The longest message that is read, because reading delays clicks. A picture has 128 KB at most.
constexpr std::size_t kMostBytes = 256 * 1024;
constexpr std::size_t kMostJoints = 100;  // no robot has as many
constexpr std::size_t kLevelsPerSecond = 10;

}  // namespace

WindowQueue::WindowQueue(std::chrono::milliseconds pause) {
  timer_.setSingleShot(true);
  timer_.setInterval(pause);
  QObject::connect(&timer_, &QTimer::timeout, &timer_, [this] {
    is_due_ = false;
    callAvailable();
  });
}

void WindowQueue::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  CallbackQueue::addCallback(callback, owner);
  if (!is_due_.exchange(true)) {
    QMetaObject::invokeMethod(
        &timer_, [this] { timer_.start(); }, Qt::QueuedConnection);
  }
}

template <typename Message>
ros::Subscriber DriverTopics::subscribe(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue_size,
                                        const std::function<void(const Message&)>& receive) {
  using Bounded = node::BoundedMessage<Message, kMostBytes>;
  const auto receive_bounded = [receive](const boost::shared_ptr<const Bounded>& bounded) {
    if (bounded->skipped == 0) {  // no driver has sent a message that is longer
      receive(bounded->message);
    }
  };
  return handle.subscribe<Bounded>(topic, queue_size, receive_bounded, {}, ros::TransportHints().tcpNoDelay());
}

template <typename Message>
void DriverTopics::receiveAlways(const std::string& topic, const std::function<void(const Message&)>& receive) {
  always_.push_back(subscribe<Message>(handle_, topic, kTheNewest, receive));
}

template <typename Message>
void DriverTopics::receiveWhileShown(Part part, ros::NodeHandle& handle, const std::string& topic,
                                     std::uint32_t queue_size, const std::function<void(const Message&)>& receive) {
  sources_[part].push_back([=, &handle] { return subscribe<Message>(handle, topic, queue_size, receive); });
}

DriverTopics::DriverTopics(const std::string& name_space, WindowQueue* queue, WindowQueue* measurements, Robot& robot,
                           const std::function<void()>& connection_changed)
    : handle_(name_space),
      measurements_handle_(name_space),
      robot_(robot),
      connection_changed_(connection_changed),
      stop_client_(handle_) {
  handle_.setCallbackQueue(queue);
  measurements_handle_.setCallbackQueue(measurements);
  leds_ = handle_.advertise<Leds>("leds", 30);
  ears_ = handle_.advertise<Ears>("ears", 1);
  joint_command_ = handle_.advertise<sensor_msgs::JointState>("joint_command", 1);
  velocity_ = handle_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  look_at_ = handle_.advertise<geometry_msgs::PointStamped>("look_at", 1);
  receiveParts();
  receiveStates();
}

void DriverTopics::receiveStates() {
  receiveAlways<aibo_driver::Connection>("connection", [this](const aibo_driver::Connection& message) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      connection_ = boost::make_shared<const aibo_driver::Connection>(message);
      last_heard_ = steady_clock::now();
    }
    connection_changed_();
  });
  receiveAlways<LinkQuality>("link_quality", [this](const LinkQuality& message) {
    hear();
    Q_EMIT robot_.linkMeasured({static_cast<double>(message.pictures_per_second), static_cast<double>(message.age),
                                static_cast<double>(message.lost)});
  });
  receiveAlways<std_msgs::Bool>(
      "streaming", [this](const std_msgs::Bool& message) { Q_EMIT robot_.streamingChanged(message.data != 0); });
  receiveAlways<sensor_msgs::BatteryState>("battery", [this](const sensor_msgs::BatteryState& message) {
    Q_EMIT robot_.batteryMeasured(static_cast<double>(message.percentage), static_cast<double>(message.temperature));
  });
  receiveAlways<MotionState>("motion_state", [this](const MotionState& message) {
    Q_EMIT robot_.movementChanged(fromRos(message.text));
    complain(message.ended);
  });
  receiveAlways<RobotState>(
      "robot_state", [this](const RobotState& message) { Q_EMIT robot_.conditionChanged(conditionIn(message)); });
  receiveAlways<LedStates>("led_states", [this](const LedStates& message) {
    LedIntensities intensities;
    for (std::size_t i = 0; i < std::min(message.names.size(), message.intensities.size()); ++i) {
      intensities[fromRos(message.names[i])] = static_cast<double>(message.intensities[i]);
    }
    Q_EMIT robot_.ledsChanged(intensities);
  });
  receiveAlways<LookAtResult>("look_at_result", [this](const LookAtResult& message) {
    const bool is_ours = asked_to_look_ && asked_to_look_->stamp == message.header.stamp &&
                         asked_to_look_->frame_id == message.header.frame_id;
    if (is_ours) {  // a result for another node has another header
      Q_EMIT robot_.answered(message.success != 0, "look there: " + fromRos(message.message));
    }
  });
}

void DriverTopics::receiveParts() {
  receiveWhileShown<sensor_msgs::CameraInfo>(Part::kPictures, handle_, "camera/camera_info", kTheNewest,
                                             [this](const sensor_msgs::CameraInfo& message) {
                                               if (message.K[0] > 0 && message.K[4] > 0) {  // otherwise not calibrated
                                                 camera_ = message;
                                               }
                                             });
  receiveWhileShown<sensor_msgs::CompressedImage>(
      Part::kPictures, handle_, "camera/image_raw/compressed", kTheNewest,
      [this](const sensor_msgs::CompressedImage& message) { receivePicture(message); });
  receiveWhileShown<sensor_msgs::JointState>(
      Part::kJoints, measurements_handle_, "joint_states", kAllOfThem,
      [this](const sensor_msgs::JointState& message) { receiveJoints(message); });
  receiveWhileShown<Touch>(Part::kSensors, measurements_handle_, "touch", kAllOfThem,
                           [this](const Touch& message) { Q_EMIT robot_.touched(touchedPlacesIn(message)); });
  for (const char* name : {"near", "far", "chest", "head"}) {
    receiveWhileShown<sensor_msgs::Range>(Part::kSensors, measurements_handle_, std::string("range/") + name,
                                          kTheNewest, [this, name](const sensor_msgs::Range& message) {
                                            Q_EMIT robot_.distanceMeasured({name, static_cast<double>(message.range),
                                                                            static_cast<double>(message.max_range)});
                                          });
  }
  receiveWhileShown<Sound>(Part::kMicrophones, measurements_handle_, "microphone", kAllOfThem,
                           [this](const Sound& message) { receiveSound(message); });
}

void DriverTopics::show(const std::set<Part>& parts) {
  for (const auto& [part, sources] : sources_) {
    if (parts.count(part) == 0) {
      shown_.erase(part);
    } else if (shown_.count(part) == 0) {
      std::vector<ros::Subscriber>& subscribers = shown_[part];
      for (const auto& subscribe_to : sources) {
        subscribers.push_back(subscribe_to());
      }
    }
  }
  followSettings();
}

void DriverTopics::followSettings() {
  const std::string owner = settings();
  if (owner.empty() || owner == followed_) {
    return;
  }
  followed_ = owner;
  settings_ = {
      subscribe<dynamic_reconfigure::ConfigDescription>(handle_, owner + "/parameter_descriptions", kTheNewest,
                                                        [this](const dynamic_reconfigure::ConfigDescription& message) {
                                                          Q_EMIT robot_.settingsDescribed(settingsIn(message));
                                                        }),
      subscribe<dynamic_reconfigure::Config>(
          handle_, owner + "/parameter_updates", kTheNewest,
          [this](const dynamic_reconfigure::Config& message) { Q_EMIT robot_.settingsChanged(valuesIn(message)); })};
}

void DriverTopics::hear() {
  const bool was_heard = isHeard();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_heard_ = steady_clock::now();
  }
  if (!was_heard) {
    connection_changed_();
  }
}

// Shows failures among the movements that have ended. Those that ended before this window listened are not shown.
void DriverTopics::complain(const std::vector<EndedMovement>& ended) {
  const auto before = std::exchange(ended_, ended);
  for (const EndedMovement& each : endedBetween(before.value_or(ended), ended)) {
    const QString complaint = complaintAbout(each);
    if (each.movement.source == ros::this_node::getName() && !complaint.isEmpty()) {
      each.how == EndedMovement::REFUSED ? Q_EMIT robot_.hinted(complaint) : Q_EMIT robot_.answered(false, complaint);
    }
  }
}

void DriverTopics::receivePicture(const sensor_msgs::CompressedImage& message) {
  try {
    const camera::BgrImage picture = camera::decodeJpeg(message.data.data(), message.data.size());
    picture_stamp_ = message.header.stamp;
    Q_EMIT robot_.pictureArrived(
        QImage(picture.pixels.data(), picture.width, picture.height, 3 * picture.width, QImage::Format_RGB888)
            .rgbSwapped());
  } catch (const camera::DecodeException&) {
    // A damaged picture is ignored here, because the driver's diagnostics count it.
  }
}

void DriverTopics::receiveJoints(const sensor_msgs::JointState& message) {
  if (positions_.size() > static_cast<int>(kMostJoints)) {
    positions_.clear();  // somebody invents names of joints
  }
  for (std::size_t i = 0; i < std::min({message.name.size(), message.position.size(), kMostJoints}); ++i) {
    positions_[fromRos(message.name[i])] = message.position[i];
  }
  Q_EMIT robot_.jointsMeasured(positions_);
}

void DriverTopics::receiveSound(const Sound& message) {
  level_.add(message.samples);
  if (level_.count() > message.samples_per_second * message.channels / kLevelsPerSecond) {
    Q_EMIT robot_.heard(level_.take());
  }
}

aibo_driver::Connection::ConstPtr DriverTopics::connection() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return connection_;
}

bool DriverTopics::areNew() const {
  return steady_clock::now() - made_ < kTimeToSpeak;
}

bool DriverTopics::isHeard() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_heard_ != steady_clock::time_point() && steady_clock::now() - last_heard_ < kHeardFor;
}

bool DriverTopics::wasHeard() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_heard_ != steady_clock::time_point();
}

// The settings' namespace is not used in a playback, where it could be that of a driver that runs now.
std::string DriverTopics::settings() const {
  const aibo_driver::Connection::ConstPtr message = connection();
  std::string problem;
  const bool is_usable = message && message->state != aibo_driver::Connection::PLAYBACK &&
                         message->settings.find('/') == 0 && ros::names::validate(message->settings, problem);
  return is_usable ? message->settings : "";
}

void DriverTopics::publishLeds(const QStringList& names, double intensity) const {
  Leds message;
  for (const QString& name : names) {
    message.names.push_back(name.toStdString());
  }
  message.intensities = {static_cast<float>(intensity)};
  leds_.publish(message);
}

void DriverTopics::publishEars(bool left, bool right) const {
  Ears message;
  message.left = left;
  message.right = right;
  ears_.publish(message);
}

void DriverTopics::publishJoints(const JointPositions& positions) const {
  sensor_msgs::JointState message;
  message.header.stamp = ros::Time::now();
  for (auto joint = positions.begin(); joint != positions.end(); ++joint) {
    message.name.push_back(joint.key().toStdString());
    message.position.push_back(joint.value());
  }
  joint_command_.publish(message);
}

void DriverTopics::publishVelocity(double forward, double left, double turn) const {
  geometry_msgs::Twist message;
  message.linear.x = forward;
  message.linear.y = left;
  message.angular.z = turn;
  velocity_.publish(message);
}

// The point is a metre in front of the camera. The lens' distortion does not matter, because the head moves the point
// to the middle of the picture.
bool DriverTopics::publishLookAt(const QPointF& place) {
  if (!camera_) {
    return false;
  }
  geometry_msgs::PointStamped message;
  message.header.frame_id = camera_->header.frame_id;
  message.header.stamp = picture_stamp_;
  message.point.x = (place.x() * camera_->width - camera_->K[2]) / camera_->K[0];
  message.point.y = (place.y() * camera_->height - camera_->K[5]) / camera_->K[4];
  message.point.z = 1;
  asked_to_look_ = message.header;
  look_at_.publish(message);
  return true;
}

}  // namespace aibo_driver::remote_control
