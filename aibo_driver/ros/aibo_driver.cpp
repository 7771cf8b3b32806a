#include "ros/aibo_driver.h"

#include <ros/console.h>

#include "ros/node.h"
#include "text/plain_text.h"

namespace aibo_driver::node {
namespace {

// How many callers of take_picture may wait at the same time; the next one waits for one of them.
constexpr int kPictureThreads = 4;

// Stop does not wait behind motors, nor motors behind stop.
constexpr int kStopThreads = 2;

// A posture does not wait until the one before it, which it ends, has answered.
constexpr int kPostureThreads = 2;

// From one diagnostic message to the next, as REP 107 has it, and from one link_quality to the next. One timer serves
// both, because each wakes two threads several times.
constexpr double kReportPeriod = 1.0;  // s

void warnOfUnknown(const DriverParameters& parameters, const std::string& name_prefix) {
  text::FirstThree names;
  for (const std::string& name : parameters.unknown) {
    names.add(name_prefix + "/" + name);
  }
  if (!names.empty()) {
    ROS_WARN_STREAM("The driver has no parameter " << names.text() << ", and ignores "
                                                   << (names.count() == 1 ? "it: is the name" : "them: are the names")
                                                   << " misspelt?");
  }
}

void warnOfMissingModel(const std::string& design) {
  if (design != "ERS-7") {
    ROS_WARN_STREAM("There is no model (URDF) of the "
                    << design << " here: its links have no tf frames, and rviz does not show it.");
  }
}

// actionlib publishes the state of each action at every change, for those who subscribe later, too, and repeats it five
// times a second unless this parameter says otherwise. These repetitions took a third of an idle driver's wake-ups.
void repeatStateOfActionsRarely(const ros::NodeHandle& handle) {
  constexpr const char* kParameter = "actionlib_status_frequency";
  constexpr double kTimesASecond = 1;
  std::string found;
  if (!handle.searchParam(kParameter, found)) {
    handle.setParam(kParameter, kTimesASecond);
  }
}

// As the logger ros.aibo_driver.client.
void logForClient(LogLevel level, const std::string& message) {
  switch (level) {
    case LogLevel::kDebug:
      ROS_DEBUG_STREAM_NAMED("client", message);
      break;
    case LogLevel::kInfo:
      ROS_INFO_STREAM_NAMED("client", message);
      break;
    case LogLevel::kWarn:
      ROS_WARN_STREAM_NAMED("client", message);
      break;
    case LogLevel::kError:
      ROS_ERROR_STREAM_NAMED("client", message);
      break;
  }
}

}  // namespace

AiboDriver::AiboDriver(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, const std::string& name)
    : handle_(inDriverNamespace(handle, "aibo")),
      only_driver_(handle_),
      parameters_(readDriverParameters(handle_, private_handle)),
      model_(*robot_model::findRobotModel(parameters_.robot.c_str())),
      stop_threads_(handle_, receipts_, kStopThreads),
      joint_thread_(handle_, receipts_),
      motion_thread_(handle_, receipts_),
      body_thread_(handle_, receipts_),
      posture_threads_(handle_, receipts_, kPostureThreads),
      picture_threads_(handle_, receipts_, kPictureThreads),
      telemetry_stamper_(usedRobotClock(), parameters_.time_offset),
      joint_table_(parameters_.robot, parameters_.joint_speed_limit),
      measured_joints_(joint_table_),
      power_(model_),
      policy_(parameters_.stream_on_start, parameters_.stream_on_demand),
      connection_(handle_, parameters_.client),
      camera_(ros::NodeHandle(handle_, "camera"), parameters_, usedRobotClock(),
              [this] { policy_.subscribersChanged(); }),
      camera_state_(ros::NodeHandle(handle_, "camera")),
      raw_images_(ros::NodeHandle(handle_, "camera"), "image_raw", [this] { policy_.subscribersChanged(); }),
      colors_(handle_, parameters_, usedRobotClock()),
      telemetry_(handle_, parameters_, model_, joint_table_, measured_joints_, telemetry_stamper_),
      odometry_(handle_, parameters_, telemetry_stamper_),
      led_states_(handle_, model_),
      client_(parameters_.client, makeCallbacks()),
      adapter_(client_),
      link_quality_(handle_, [this] { return askedEveryNthImage(); }),
      settings_(private_handle, client_, adapter_, joint_table_),
      stream_services_(
          parameters_, client_, policy_, [this] { return adapter_.wishedQuality(); },
          [this](const Picture& p) { return camera_.toMessage(p); }),
      stick_pictures_(parameters_, client_),
      color_tables_(model_, client_,
                    [this](int channel, const ColorTablePtr& table) { colors_.setTable(channel, table); }),
      mover_(joint_table_, measured_joints_, client_, parameters_.approach_speed, parameters_.slow_down,
             [this] { return settings_.telemetryPeriod() > 0; }),
      motion_state_(handle_, mover_),
      joints_(joint_table_, mover_),
      walk_(parameters_.walk, client_, mover_),
      postures_(mover_),
      expression_(model_, client_),
      robot_services_(client_, mover_),
      diagnostics_(
          handle_, private_handle, name,
          {parameters_, client_, policy_, adapter_, meter_, raw_images_, settings_, robot_clock_, power_, mover_}),
      report_timer_(handle_.createSteadyTimer(ros::WallDuration(kReportPeriod), [this](const ros::SteadyTimerEvent&) {
        link_quality_.publish();
        diagnostics_.publish();
      })) {
  if (parameters_.publish_footprint && parameters_.robot == "ERS-7") {
    footprint_.emplace(handle_, parameters_, model_, joint_table_, measured_joints_, telemetry_stamper_);
  }
  warnOfUnknown(parameters_, private_handle.getNamespace());
  mover_.setListener(makeListener());
  warnOfMissingModel(parameters_.robot);
  joints_.subscribe(joint_thread_.handle());
  walk_.subscribe(joint_thread_.handle());
  postures_.advertise(posture_threads_.handle());
  repeatStateOfActionsRarely(handle_);
  motion_action_ = startPlayMotionServer(motion_thread_.handle(), mover_);
  trajectory_action_ = startFollowTrajectoryServer(joint_thread_.handle(), joint_table_, measured_joints_, mover_);
  expression_.subscribe(body_thread_.handle());
  robot_services_.advertise(stop_threads_.handle(), motion_thread_.handle(), body_thread_.handle());
  stream_services_.advertise(handle_, picture_threads_.handle());
  stick_pictures_.advertise(body_thread_.handle());
  color_tables_.loadAtStart(parameters_.color_tables);
  color_tables_.advertise(handle_);
  colors_.start([this](const ColorDetection& detection) { client_.setColorDetection(detection); });
  policy_.start([this] { return camera_.hasSubscribers() || raw_images_.hasSubscribers(); },
                [this](bool on) { client_.setStreaming(on); });
  client_.start();
  receipts_.start();
  stop_threads_.start();
  joint_thread_.start();
  motion_thread_.start();
  body_thread_.start();
  posture_threads_.start();
  picture_threads_.start();
}

// In a nodelet manager, subscribers may come and go on other threads until the publishers are gone. First the client:
// a service that waits for the robot ends with it.
AiboDriver::~AiboDriver() {
  policy_.stop();
  colors_.stop();
  client_.stop();
  stop_threads_.stop();
  joint_thread_.stop();
  motion_thread_.stop();
  body_thread_.stop();
  posture_threads_.stop();
  picture_threads_.stop();
}

RcServerClient::Callbacks AiboDriver::makeCallbacks() {
  RcServerClient::Callbacks callbacks;
  callbacks.on_picture = [this](const PicturePtr& picture) { publishPicture(*picture); };
  callbacks.on_status = [this](const ConnectionStatus& status) { updateConnection(status); };
  callbacks.on_streaming = [this](bool streaming) { connection_.publishStreaming(streaming); };
  callbacks.on_telemetry = [this](const Telemetry& telemetry) { publishTelemetry(telemetry); };
  callbacks.on_colors = [this](const DetectedColors& colors) { colors_.publish(colors); };
  callbacks.on_leds_accepted = [this](const std::vector<LedCommand>& leds) { led_states_.accept(leds); };
  callbacks.on_steered = [this](const WalkVelocity& in_force) { mover_.steered(in_force); };
  callbacks.on_ended = [this](const MotionEnd& end) {
    odometry_.motionEnded(end);
    mover_.ended(end);
  };
  callbacks.on_refused = [this](const Refusal& refusal) { refused(refusal); };
  callbacks.on_late_answer = [this](const LateAnswer& answer) { mover_.answeredLate(answer); };
  callbacks.on_motors_and_posture = [this](const MotorsAndPosture& state) {
    odometry_.update(state);
    mover_.robotChanged(state);
  };
  callbacks.log = logForClient;
  return callbacks;
}

// The end of each movement is logged, too.
void AiboDriver::refused(const Refusal& refusal) {
  mover_.refused(refusal);
  if (refusal.request != RefusedRequest::kJoints && refusal.request != RefusedRequest::kWalk) {
    movement_warnings_.warn("The robot did not do what it was told: " + refusal.reason + ".");
  }
}

movement::Mover::Listener AiboDriver::makeListener() {
  movement::Mover::Listener listener;
  listener.on_change = [this] { motion_state_.publish(); };
  listener.on_begin = [this] { joints_.moveOn(); };
  listener.on_ended = [this](const movement::EndedMovement& ended) { logEnd(ended); };
  listener.on_warning = [this](const std::string& text) { movement_warnings_.warn(text); };
  return listener;
}

// Commands come often, and replace and stop each other, as is meant.
void AiboDriver::logEnd(const movement::EndedMovement& ended) {
  using movement::MovementEnd;
  using Kind = movement::Movement::Kind;
  const bool is_command = ended.movement.kind == Kind::kCommand || ended.movement.kind == Kind::kLookAt;
  const bool is_meant = ended.how == MovementEnd::kReplaced || ended.how == MovementEnd::kStopped;
  const bool is_as_ever = ended.how == MovementEnd::kUnknown && ended.movement.kind == Kind::kMotion;
  const std::string name = movement::describe(ended.movement);
  if (ended.how == MovementEnd::kRefused) {
    movement_warnings_.warn(name + " is refused: " + ended.reason + ".");
  } else if (ended.how == MovementEnd::kDone || is_as_ever || (is_command && is_meant)) {
    ROS_DEBUG_STREAM_NAMED("joints", name << " has ended. " << ended.reason);
  } else {
    movement_warnings_.warn(name + " ends early: " + ended.reason + ".");
  }
}

std::optional<int> AiboDriver::askedEveryNthImage() const {
  return client_.streaming() ? std::optional<int>(client_.streamFormat().every_nth_image) : std::nullopt;
}

void AiboDriver::publishPicture(const Picture& picture) {
  const ros::Time stamp = camera_.stamp(picture);
  const bool is_decoded = raw_images_.hasSubscribers();
  const sensor_msgs::CompressedImageConstPtr message = camera_.publish(picture, is_decoded);
  if (is_decoded) {
    raw_images_.publish(message);
  }
  camera_state_.update(picture, stamp, camera_.frameId());
  link_quality_.add(picture, stamp);
  meter_.add(picture.jpeg.size(), picture.first_byte_time);
  adapter_.picturePublished(std::chrono::steady_clock::now(), camera_.takenAt(picture));
}

void AiboDriver::publishTelemetry(const Telemetry& telemetry) {
  telemetry_stamper_.stamp(telemetry);  // the robot's clock is known from all of it, whether anybody listens or not
  measured_joints_.update(telemetry);
  telemetry_.publish(telemetry);
  if (footprint_) {
    footprint_->publish(telemetry);
  }
  odometry_.publish(telemetry);
  power_.update(telemetry);
}

void AiboDriver::updateConnection(const ConnectionStatus& status) {
  if (status.state == ConnectionState::kConnected) {
    mover_.connected();  // before others can know, and give orders
  }
  connection_.publish(status);
  led_states_.update(status);
  if (status.state != ConnectionState::kConnected) {
    measured_joints_.clear();
    mover_.disconnected();
    power_.clear();
    return;
  }
  if (!status.robot.design.empty() && status.robot.design != parameters_.robot) {
    // The status changes as often as the robot likes.
    design_warnings_.warn("The robot says that it is an " + status.robot.design + ", but the parameter robot is " +
                          parameters_.robot + ": commands are refused. Set the parameter, and start the driver again.");
  }
}

}  // namespace aibo_driver::node
