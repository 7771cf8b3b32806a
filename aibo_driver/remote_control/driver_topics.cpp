#include "remote_control/driver_topics.h"

#include <aibo_driver/Ears.h>
#include <aibo_driver/LedStates.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/LookAtResult.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/Sound.h>
#include <aibo_driver/Touch.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Twist.h>
#include <ros/this_node.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <utility>

#include "camera/jpeg_decoder.h"
#include "remote_control/ended_movements.h"
#include "remote_control/from_ros.h"
#include "remote_control/settings_messages.h"

namespace aibo_driver::remote_control {
namespace {

using std::chrono::steady_clock;

// The driver sends something once a second.
constexpr std::chrono::seconds kTimeToSpeak{5};
constexpr std::chrono::seconds kHeardFor{3};

// The joints of a robot of version 1 come one by one, and a short touch must not be missed.
constexpr std::uint32_t kAllOfThem = 64;
constexpr std::uint32_t kTheNewest = 1;

constexpr int kLongestName = 200;  // characters

constexpr std::size_t kMostJoints = 100;  // no robot has as many

QImage imageOf(const camera::BgrImage& picture) {
  QImage image(picture.width, picture.height, QImage::Format_RGB32);
  const std::uint8_t* pixel = picture.pixels.data();
  for (int y = 0; y < picture.height; ++y) {
    auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < picture.width; ++x, pixel += 3) {
      row[x] = qRgb(pixel[2], pixel[1], pixel[0]);
    }
  }
  return image;
}

QStringList touchedPlaces(const Touch& touch) {
  const std::pair<const char*, bool> places[] = {{"paw_left_front", touch.paw_left_front},
                                                 {"paw_left_hind", touch.paw_left_hind},
                                                 {"paw_right_front", touch.paw_right_front},
                                                 {"paw_right_hind", touch.paw_right_hind},
                                                 {"chin", touch.chin},
                                                 {"head", touch.head},
                                                 {"back_front", touch.back_front},
                                                 {"back_middle", touch.back_middle},
                                                 {"back_rear", touch.back_rear}};
  QStringList touched;
  for (const auto& [place, is_touched] : places) {
    if (is_touched) {
      touched.append(place);
    }
  }
  return touched;
}

RobotCondition::Posture toPosture(std::uint8_t posture) {
  switch (posture) {
    case RobotState::STANDING:
      return RobotCondition::Posture::kStanding;
    case RobotState::SITTING:
      return RobotCondition::Posture::kSitting;
    case RobotState::LYING:
      return RobotCondition::Posture::kLying;
    case RobotState::WALKING:
      return RobotCondition::Posture::kWalking;
    case RobotState::FALLEN:
      return RobotCondition::Posture::kFallen;
    case RobotState::CARRIED:
      return RobotCondition::Posture::kCarried;
    default:
      return RobotCondition::Posture::kNotKnown;
  }
}

RobotCondition toCondition(const RobotState& state) {
  RobotCondition condition;
  condition.motors = state.motors == RobotState::ON    ? RobotCondition::Motors::kOn
                     : state.motors == RobotState::OFF ? RobotCondition::Motors::kOff
                                                       : RobotCondition::Motors::kNotKnown;
  condition.posture = toPosture(state.posture);
  condition.is_stopped = state.stopped != 0;
  condition.stopped_by = fromRos(state.stopped_by).left(kLongestName);
  return condition;
}

}  // namespace

template <typename Message>
void DriverTopics::subscribe(const std::string& topic, const std::function<void(const Message&)>& receive) {
  subscribeIn(handle_, topic, kTheNewest, receive);
}

template <typename Message>
void DriverTopics::subscribeMeasurements(const std::string& topic, std::uint32_t queue_size,
                                         const std::function<void(const Message&)>& receive) {
  subscribeIn(measurements_handle_, topic, queue_size, receive);
}

template <typename Message>
void DriverTopics::subscribeIn(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue_size,
                               const std::function<void(const Message&)>& receive) {
  subscribers_[topic] = handle.subscribe<Message>(
      topic, queue_size, [receive](const boost::shared_ptr<const Message>& message) { receive(*message); }, {},
      ros::TransportHints().tcpNoDelay());
}

DriverTopics::DriverTopics(const ros::NodeHandle& handle, const Post& post,
                           const std::function<void()>& connection_changed)
    : handle_(handle), measurements_handle_(handle), post_(post), stop_client_(handle) {
  measurements_handle_.setCallbackQueue(&measurements_);
  leds_ = handle_.advertise<Leds>("leds", 30);
  ears_ = handle_.advertise<Ears>("ears", 1);
  joint_command_ = handle_.advertise<sensor_msgs::JointState>("joint_command", 1);
  velocity_ = handle_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  look_at_ = handle_.advertise<geometry_msgs::PointStamped>("look_at", 1);
  subscribeStates(connection_changed);
  subscribeAnswers();
}

void DriverTopics::subscribeStates(const std::function<void()>& connection_changed) {
  subscribe<aibo_driver::Connection>("connection", [this, connection_changed](const aibo_driver::Connection& message) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      connection_ = boost::make_shared<const aibo_driver::Connection>(message);
      last_heard_ = steady_clock::now();
    }
    connection_changed();
  });
  subscribe<LinkQuality>("link_quality", [this, connection_changed](const LinkQuality& message) {
    hear(connection_changed);
    LinkFigures figures;
    figures.pictures_per_second = static_cast<double>(message.pictures_per_second);
    figures.age = static_cast<double>(message.age);
    figures.lost = static_cast<double>(message.lost);
    post_([figures](Robot& robot) { Q_EMIT robot.linkMeasured(figures); });
  });
  subscribe<std_msgs::Bool>("streaming", [this](const std_msgs::Bool& message) {
    const bool on = message.data != 0;
    post_([on](Robot& robot) { Q_EMIT robot.streamingChanged(on); });
  });
  subscribe<sensor_msgs::BatteryState>("battery", [this](const sensor_msgs::BatteryState& message) {
    const auto charge = static_cast<double>(message.percentage);
    const auto temperature = static_cast<double>(message.temperature);
    post_([charge, temperature](Robot& robot) { Q_EMIT robot.batteryMeasured(charge, temperature); });
  });
  subscribe<MotionState>("motion_state", [this](const MotionState& message) {
    const bool plays = std::any_of(message.movements.begin(), message.movements.end(),
                                   [](const Movement& movement) { return movement.kind == Movement::MOTION; });
    const QString text = fromRos(message.text);
    post_([text, plays](Robot& robot) { Q_EMIT robot.movementChanged(text, plays); });
    complain(message.ended);
  });
  subscribe<RobotState>("robot_state", [this](const RobotState& message) {
    post_([condition = toCondition(message)](Robot& robot) { Q_EMIT robot.conditionChanged(condition); });
  });
}

// Movements that ended before this window listened are no news.
void DriverTopics::complain(const std::vector<EndedMovement>& ended) {
  const auto before = std::exchange(ended_, ended);
  for (const EndedMovement& each : endedBetween(before.value_or(ended), ended)) {
    const QString complaint = complaintAbout(each);
    if (each.movement.source == ros::this_node::getName() && !complaint.isEmpty()) {
      post_([complaint, is_refused = each.how == EndedMovement::REFUSED](Robot& robot) {
        is_refused ? Q_EMIT robot.hinted(complaint) : Q_EMIT robot.answered(false, complaint);
      });
    }
  }
}

void DriverTopics::subscribeAnswers() {
  subscribe<LedStates>("led_states", [this](const LedStates& message) {
    LedIntensities intensities;
    for (std::size_t i = 0; i < std::min(message.names.size(), message.intensities.size()); ++i) {
      intensities[fromRos(message.names[i])] = static_cast<double>(message.intensities[i]);
    }
    post_([intensities](Robot& robot) { Q_EMIT robot.ledsChanged(intensities); });
  });
  subscribe<LookAtResult>("look_at_result", [this](const LookAtResult& message) {
    bool is_ours = false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_ours = asked_to_look_ && asked_to_look_->stamp == message.header.stamp &&
                asked_to_look_->frame_id == message.header.frame_id;
    }
    if (is_ours) {  // otherwise it answers somebody else
      const bool success = message.success != 0;
      const QString text = "look there: " + fromRos(message.message);
      post_([success, text](Robot& robot) { Q_EMIT robot.answered(success, text); });
    }
  });
}

void DriverTopics::show(Part part, bool visible) {
  switch (part) {
    case Part::kPictures:
      showPictures(visible);
      break;
    case Part::kJoints:
      if (!visible) {
        drop({"joint_states"});
      } else if (subscribers_.count("joint_states") == 0) {
        subscribeMeasurements<sensor_msgs::JointState>(
            "joint_states", kAllOfThem, [this](const sensor_msgs::JointState& message) { receiveJoints(message); });
      }
      break;
    case Part::kSensors:
      showSensors(visible);
      break;
    case Part::kMicrophones:
      if (!visible) {
        drop({"microphone"});
      } else if (subscribers_.count("microphone") == 0) {
        subscribeMeasurements<Sound>("microphone", kAllOfThem,
                                     [this](const Sound& message) { level_.add(message.samples); });
      }
      break;
  }
}

void DriverTopics::drop(const std::vector<std::string>& topics) {
  for (const std::string& topic : topics) {
    subscribers_.erase(topic);
  }
}

void DriverTopics::showSensors(bool visible) {
  if (!visible) {
    drop({"touch", "range/near", "range/far", "range/chest", "range/head"});
    return;
  }
  if (subscribers_.count("touch") > 0) {
    return;
  }
  subscribeMeasurements<Touch>("touch", kAllOfThem, [this](const Touch& message) {
    post_([places = touchedPlaces(message)](Robot& robot) { Q_EMIT robot.touched(places); });
  });
  for (const char* name : {"near", "far", "chest", "head"}) {
    subscribeMeasurements<sensor_msgs::Range>(
        std::string("range/") + name, kTheNewest, [this, name](const sensor_msgs::Range& message) {
          const Distance distance{name, static_cast<double>(message.range), static_cast<double>(message.max_range)};
          post_([distance](Robot& robot) { Q_EMIT robot.distanceMeasured(distance); });
        });
  }
}

void DriverTopics::hear(const std::function<void()>& connection_changed) {
  const bool was_heard = isHeard();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_heard_ = steady_clock::now();
  }
  if (!was_heard) {
    connection_changed();
  }
}

// The camera's calibration comes with each picture, but we need it only once.
void DriverTopics::showPictures(bool visible) {
  const std::string jpegs = "camera/image_raw/compressed";
  const std::string calibration = "camera/camera_info";
  bool knows_camera = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    knows_camera = camera_.has_value();
  }
  if (!visible || knows_camera) {
    drop({calibration});
  } else if (subscribers_.count(calibration) == 0) {
    subscribe<sensor_msgs::CameraInfo>(calibration, [this](const sensor_msgs::CameraInfo& message) {
      if (message.K[0] > 0 && message.K[4] > 0) {  // otherwise it is not calibrated
        const std::lock_guard<std::mutex> lock(mutex_);
        camera_ = message;
      }
    });
  }
  if (!visible) {
    drop({jpegs});
  } else if (subscribers_.count(jpegs) == 0) {
    subscribe<sensor_msgs::CompressedImage>(
        jpegs, [this](const sensor_msgs::CompressedImage& message) { receivePicture(message); });
  }
}

// If the window is too slow, a newer picture replaces the one that waits for it.
void DriverTopics::receivePicture(const sensor_msgs::CompressedImage& message) {
  QImage image;
  try {
    image = imageOf(camera::decodeJpeg(message.data.data(), message.data.size()));
  } catch (const camera::DecodeException&) {
    return;  // the driver's diagnostics count these pictures
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    picture_stamp_ = message.header.stamp;
  }
  const std::lock_guard<std::mutex> lock(newest_->mutex);
  const bool one_waits = !newest_->picture.isNull();
  newest_->picture = image;
  if (!one_waits) {
    post_([newest = newest_](Robot& robot) {
      QImage picture;
      {
        const std::lock_guard<std::mutex> taking(newest->mutex);
        picture = std::exchange(newest->picture, {});
      }
      Q_EMIT robot.pictureArrived(picture);
    });
  }
}

void DriverTopics::receiveJoints(const sensor_msgs::JointState& message) {
  if (positions_.size() > static_cast<int>(kMostJoints)) {
    positions_.clear();  // somebody makes names up
  }
  for (std::size_t i = 0; i < std::min({message.name.size(), message.position.size(), kMostJoints}); ++i) {
    positions_[fromRos(message.name[i])] = message.position[i];
  }
  positions_are_new_ = true;
}

void DriverTopics::takeMeasurements() {
  measurements_.callAvailable();
  if (level_.count() > 0) {
    post_([level = level_.take()](Robot& robot) { Q_EMIT robot.heard(level); });
  }
  if (std::exchange(positions_are_new_, false)) {
    post_([positions = positions_](Robot& robot) { Q_EMIT robot.jointsMeasured(positions); });
  }
}

void DriverTopics::followSettings(const std::string& owner) {
  if (owner == settings_owner_) {
    return;
  }
  subscribers_.erase(settings_owner_ + "/parameter_descriptions");
  subscribers_.erase(settings_owner_ + "/parameter_updates");
  settings_owner_ = owner;
  if (owner.empty()) {
    return;
  }
  subscribe<dynamic_reconfigure::ConfigDescription>(
      owner + "/parameter_descriptions", [this](const dynamic_reconfigure::ConfigDescription& message) {
        post_([settings = settingsIn(message)](Robot& robot) { Q_EMIT robot.settingsDescribed(settings); });
      });
  subscribe<dynamic_reconfigure::Config>(
      owner + "/parameter_updates", [this](const dynamic_reconfigure::Config& message) {
        post_([values = valuesIn(message)](Robot& robot) { Q_EMIT robot.settingsChanged(values); });
      });
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
  geometry_msgs::PointStamped message;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!camera_) {
      return false;
    }
    message.header.frame_id = camera_->header.frame_id;
    message.header.stamp = picture_stamp_;
    message.point.x = (place.x() * camera_->width - camera_->K[2]) / camera_->K[0];
    message.point.y = (place.y() * camera_->height - camera_->K[5]) / camera_->K[4];
    message.point.z = 1;
    asked_to_look_ = message.header;
  }
  look_at_.publish(message);
  return true;
}

}  // namespace aibo_driver::remote_control
