#include "node/aibo_driver.h"

#include <aibo_driver/LinkQuality.h>
#include <ros/console.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <string>

#include "aibo_client/exceptions.h"
#include "camera/camera_options.h"
#include "node/connection_message.h"
#include "node/node.h"
#include "text/plain_text.h"
#include "text/sentence.h"

namespace aibo_driver::node {

using aibo_client::EndedHow;
using aibo_client::LogLevel;

namespace {

// Calls of stop and of motors do not wait for each other.
constexpr int kStopThreads = 2;

// Calls of take_picture delay no posture, and are refused at once when too many wait. A call for a new posture must not
// wait for the call before it, because it ends that one.
constexpr int kPoolThreads = kMostPictureCalls + 4;

// The time between two diagnostic messages, as REP 107 says, and between two messages of link_quality. One timer serves
// both, because each timer wakes two threads several times.
constexpr double kReportPeriod = 1.0;  // s

constexpr std::chrono::milliseconds kAtOnce{10};  // a timer needs some time

// Even a silent connection takes a descriptor of this process, and without a free descriptor the process accepts no
// other connection. The usual limit is 1024, and a process may raise it.
void raiseDescriptorLimit() {
  constexpr rlim_t kEnough = 65536;  // one address cannot make more connections
  rlimit limit = {};
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < kEnough) {
    limit.rlim_cur = std::min(limit.rlim_max, kEnough);
    ::setrlimit(RLIMIT_NOFILE, &limit);
  }
}

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

// actionlib publishes the state of each action, latched, at every change. Unless this parameter says otherwise, it also
// repeats the state five times a second. Even once a second, the repetitions took half of an idle driver's wake-ups.
// Some repetitions are needed: roscpp sends a message before it keeps it as the latched one, so a node that subscribes
// in between does not get it.
void repeatStateOfActionsRarely(const ros::NodeHandle& handle) {
  constexpr const char* kParameter = "actionlib_status_frequency";
  constexpr double kEveryFiveSeconds = 0.2;
  std::string found;
  if (!handle.searchParam(kParameter, found)) {
    handle.setParam(kParameter, kEveryFiveSeconds);
  }
}

// For the connection and its adaptive stream.
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

/// @param asked_rate the pictures a second that the robot is asked for now
LinkQuality linkQuality(const camera::LinkMeter::Reading& reading, double asked_rate,
                        const aibo_client::ConnectionStatus& status) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  LinkQuality quality;
  quality.header.stamp = ros::Time::now();
  quality.pictures_per_second = static_cast<float>(reading.picturesPerSecond());
  quality.pictures_per_second_asked = static_cast<float>(asked_rate);
  quality.kilobytes_per_second = static_cast<float>(reading.kilobytesPerSecond());
  quality.age = static_cast<float>(reading.mean_age.value_or(kUnknown));
  quality.longest_age = static_cast<float>(reading.worst_age.value_or(kUnknown));
  quality.lost = static_cast<float>(reading.loss.value_or(kUnknown));
  if (status.state == aibo_client::ConnectionState::kConnected) {
    quality.transport = camera::nameOf(status.transport);
  }
  return quality;
}

// A handle with one handle's names, and with callbacks on the other's queue.
ros::NodeHandle onQueueOf(const ros::NodeHandle& queue, ros::NodeHandle names) {
  names.setCallbackQueue(queue.getCallbackQueue());
  return names;
}

}  // namespace

AiboDriver::AiboDriver(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, const std::string& name)
    : own_thread_(inDriverNamespace(handle, "aibo"), receipts_),
      handle_(own_thread_.handle()),
      only_driver_(handle_),
      parameters_(readDriverParameters(handle_, private_handle)),
      model_(*robot_model::findRobotModel(parameters_.robot.c_str())),
      stop_threads_(handle_, receipts_, kStopThreads),
      order_thread_(handle_, receipts_),
      motion_thread_(handle_, receipts_),
      stick_thread_(handle_, receipts_),
      sound_thread_(handle_, receipts_),
      pool_(handle_, receipts_, kPoolThreads),
      telemetry_stamper_(usedRobotClock(), parameters_.time_offset),
      joint_table_(parameters_.robot, parameters_.joint_speed_limit, parameters_.motion_speed_limit),
      measured_joints_(joint_table_),
      power_(model_),
      policy_(
          parameters_.stream_on_start, parameters_.stream_on_demand,
          [this] { return camera_.hasSubscribers() || raw_images_.hasSubscribers(); },
          [this](bool on) { client_.setStreaming(on); }),
      settings_namespace_(private_handle.getNamespace()),
      connection_(handle_, "connection"),
      streaming_(handle_, "streaming"),
      camera_(ros::NodeHandle(handle_, "camera"), parameters_, usedRobotClock(), [this] { policy_.decide(); }),
      raw_images_(ros::NodeHandle(handle_, "camera"), "image_raw", [this] { policy_.decide(); }),
      colors_(handle_, parameters_, usedRobotClock(),
              [this](const aibo_client::ColorDetection& detection) { client_.setColorDetection(detection); }),
      microphone_(handle_, parameters_, usedRobotClock(),
                  [this](const aibo_client::MicrophoneSettings& settings) { client_.setMicrophone(settings); }),
      telemetry_(handle_, parameters_, model_, joint_table_, measured_joints_, telemetry_stamper_),
      odometry_(handle_, parameters_, telemetry_stamper_),
      leds_(model_),
      led_states_(handle_, "led_states"),
      client_(parameters_.client, makeCallbacks()),
      player_(client_),
      adapter_(client_, logForClient),
      link_quality_(handle_.advertise<LinkQuality>("link_quality", 1)),
      settings_(onQueueOf(handle_, private_handle), client_, adapter_, joint_table_),
      mover_(joint_table_, measured_joints_, client_, parameters_.approach_speed),
      stop_memory_(handle_),
      motion_state_(handle_, mover_, stop_memory_),
      joints_(joint_table_, mover_),
      body_pose_(joint_table_, measured_joints_, mover_),
      walk_(parameters_.walk, client_, mover_),
      goal_walks_(parameters_, client_, mover_, [this] { return odometry_.here(); }),
      leds_and_ears_(model_, client_, mover_),
      diagnostics_(handle_, private_handle, name,
                   {parameters_, client_, policy_, adapter_, raw_images_, settings_, robot_clock_, power_, mover_,
                    microphone_, player_}),
      report_timer_(handle_.createSteadyTimer(ros::WallDuration(kReportPeriod),
                                              [this](const ros::SteadyTimerEvent&) { report(); })) {
  raiseDescriptorLimit();
  connection_.publish(toMessage(aibo_client::ConnectionStatus(), parameters_.client, settings_namespace_));
  publishStreaming(false);
  led_states_.publish(leds_.states());
  if (parameters_.publish_footprint && parameters_.robot == "ERS-7") {
    footprint_.emplace(handle_, parameters_, model_, joint_table_, measured_joints_, telemetry_stamper_);
  }
  warnOfUnknown(parameters_, private_handle.getNamespace());
  mover_.setListener(makeListener());
  stayStopped();
  warnOfMissingModel(parameters_.robot);
  joints_.subscribe(order_thread_.handle());
  body_pose_.subscribe(order_thread_.handle());
  walk_.subscribe(order_thread_.handle());
  goal_walks_.subscribe(order_thread_.handle());
  leds_and_ears_.subscribe(order_thread_.handle());
  advertiseServices();
  startActions();
  if (parameters_.get_up) {
    letItGetUp(name);
  }
  policy_.decide();
  client_.setMicrophone(microphone_.settings());
  client_.start();
  for (CallbackThreads* const each : threads_) {
    each->start();
  }
}

// The client stops first, because that ends a service that waits for the robot. The threads stop before the members go,
// because roscpp 1.15 does not wait for the callback of a timer or a service that it removes (ros_comm #2283).
AiboDriver::~AiboDriver() {
  client_.stop();
  player_.finish();
  for (CallbackThreads* const each : threads_) {
    each->stop();
  }
}

void AiboDriver::advertiseServices() {
  const auto wished_quality = [this] { return adapter_.wishedQuality(); };
  advertise(handle_, streamServices(parameters_, client_, policy_));
  const auto set_table = [this](int channel, const aibo_client::ColorTablePtr& table) {
    client_.setColorTable(channel, table);
    colors_.setTable(channel, table);
  };
  loadColorTables(parameters_.color_tables, model_, set_table);
  advertise(handle_, colorTableServices(model_, client_, set_table));
  advertise(stop_threads_.handle(), stopServices(mover_));
  advertise(motion_thread_.handle(), motionServices(mover_));
  advertise(pool_.handle(), postureServices(mover_));
  advertise(stick_thread_.handle(), robotServices(client_, mover_));
  advertise(stick_thread_.handle(), stickPictureServices(parameters_, client_, wished_quality));
  advertise(sound_thread_.handle(), soundServices(client_, player_));
  advertise(pool_.handle(),
            takePictureServices(parameters_, client_, wished_quality,
                                [this](const aibo_client::Picture& p) { return camera_.toMessage(p); }));
}

void AiboDriver::advertise(ros::NodeHandle handle, Services services) {
  for (ros::AdvertiseServiceOptions& each : services) {
    services_.push_back(handle.advertiseService(each));
  }
}

void AiboDriver::startActions() {
  repeatStateOfActionsRarely(handle_);
  actions_.push_back(startPlayMotion(motion_thread_.handle(), mover_));
  actions_.push_back(startFollowTrajectory(order_thread_.handle(), joint_table_, measured_joints_, mover_));
  actions_.push_back(startPlaySound(sound_thread_.handle(), player_));
  actions_.push_back(startGoTo(order_thread_.handle(), goal_walks_, mover_));
  actions_.push_back(startTakePosture(motion_thread_.handle(), mover_));
}

aibo_client::Callbacks AiboDriver::makeCallbacks() {
  aibo_client::Callbacks callbacks;
  callbacks.on_picture = [this](const aibo_client::PicturePtr& picture) { publishPicture(*picture); };
  callbacks.on_status = [this](const aibo_client::ConnectionStatus& status) { updateConnection(status); };
  callbacks.on_streaming = [this](bool streaming) { publishStreaming(streaming); };
  callbacks.on_telemetry = [this](const aibo_client::Telemetry& telemetry) { publishTelemetry(telemetry); };
  callbacks.on_colors = [this](const aibo_client::DetectedColors& colors) { colors_.publish(colors); };
  callbacks.on_heard = [this](const aibo_client::HeardSound& sound) { microphone_.publish(sound); };
  callbacks.on_sound_ended = [this](const aibo_client::SoundEnd& end) { player_.ended(end); };
  callbacks.on_leds_accepted = [this](const std::vector<aibo_client::LedCommand>& leds) {
    if (leds_.accept(leds)) {
      led_states_.publish(leds_.states());
    }
  };
  callbacks.on_steered = [this](const aibo_client::WalkVelocity& in_force, std::uint64_t order, std::uint64_t walk) {
    mover_.steered(in_force, order, walk);
  };
  callbacks.on_ended = [this](const aibo_client::ActivityEnd& end) {
    odometry_.motionEnded(end);
    mover_.ended(end);
  };
  callbacks.on_refused = [this](const aibo_client::Refusal& refusal) { refused(refusal); };
  callbacks.on_motors_and_posture = [this](const aibo_client::MotorsAndPosture& state) {
    odometry_.update(state);
    mover_.robotChanged(state);
    if (get_up_) {
      get_up_->update(state, mover_.state().overruled);
    }
  };
  callbacks.log = logForClient;
  return callbacks;
}

// Refuses orders after a restart of the driver. Without a driver, the robot holds still by itself.
void AiboDriver::stayStopped() {
  const std::optional<std::string>& node = stop_memory_.left();
  if (!node) {
    return;
  }
  ROS_WARN_STREAM("The robot stays stopped: " << *node << " has stopped it, and the last driver has ended since. Call "
                                              << handle_.resolveName("release") << " to let it move.");
  try {
    mover_.stop({*node, std::chrono::steady_clock::now()});
  } catch (const aibo_client::Exception&) {
    // There is no connection yet, so nothing has to hold. From now on, only rest moves the robot.
  }
}

// Lets the robot get up, on a thread that may wait for the robot's answer.
void AiboDriver::letItGetUp(const std::string& source) {
  get_up_timer_ = makeOneShotTimer(pool_.handle(), kAtOnce, [this, source] {
    ROS_INFO("The robot has fallen, and is told to get up.");
    mover_.takePosture({source, std::chrono::steady_clock::now()}, aibo_client::Posture::kStand);
  });
  get_up_.emplace(source, [this] { restart(&get_up_timer_); });
}

// Refused orders are not logged here, because the end of each movement is logged.
void AiboDriver::refused(const aibo_client::Refusal& refusal) {
  using Request = aibo_client::RefusedRequest;
  static const std::map<Request, std::string> kOthers = {{Request::kSpeedLimits, "joint speed limits"},
                                                         {Request::kLeds, "LEDs"},
                                                         {Request::kEars, "ears"},
                                                         {Request::kMicrophone, "microphone"}};
  mover_.refused(refusal);
  if (const auto other = kOthers.find(refusal.request); other != kOthers.end()) {
    warnings_.warn("The request for the " + other->second + " was refused: " + text::sentence(refusal.reason));
  }
}

movement::Mover::Listener AiboDriver::makeListener() {
  movement::Mover::Listener listener;
  listener.on_change = [this] { motion_state_.publish(); };
  listener.on_begin = [this] { joints_.moveOn(); };
  listener.on_ended = [this](const movement::EndedMovement& ended) {
    logEnd(ended);
    if (get_up_) {
      get_up_->ended(ended, std::chrono::steady_clock::now());
    }
  };
  return listener;
}

// Logs the end of a movement, without a warning if it is normal: commands come often, and replace and stop each other.
void AiboDriver::logEnd(const movement::EndedMovement& ended) {
  using Kind = movement::Movement::Kind;
  const bool is_command = ended.movement.kind == Kind::kCommand || ended.movement.kind == Kind::kLookAt;
  const bool is_meant = ended.how == EndedHow::kReplaced || ended.how == EndedHow::kStopped;
  const bool is_as_ever = ended.how == EndedHow::kUnknown && (is_command || ended.movement.kind == Kind::kMotion);
  const std::string name = "The " + movement::describe(ended.movement);
  if (ended.how == EndedHow::kRefused) {
    warnings_.warn(name + " is refused: " + text::sentence(ended.reason));
  } else if (ended.how == EndedHow::kDone || is_as_ever || (is_command && is_meant)) {
    ROS_DEBUG_STREAM_NAMED("joints", name << " has ended. " << ended.reason);
  } else {
    warnings_.warn(name + " ends early: " + text::sentence(ended.reason));
  }
}

int AiboDriver::askedEveryNthImage() const {
  return client_.streaming() ? client_.streamFormat().every_nth_image : 0;
}

void AiboDriver::publishPicture(const aibo_client::Picture& picture) {
  const auto [stamp, taken] = camera_.momentOf(picture);
  const bool is_decoded = raw_images_.hasSubscribers();
  const sensor_msgs::CompressedImageConstPtr message = camera_.publish(picture, stamp, is_decoded);
  if (is_decoded) {
    raw_images_.publish(message);
  }
  const auto now = std::chrono::steady_clock::now();
  meter_.add(picture, (ros::Time::now() - stamp).toSec(), askedEveryNthImage(), now);
  adapter_.picturePublished(now, taken);
}

void AiboDriver::report() {
  const int every_nth = askedEveryNthImage();
  const double asked_rate = every_nth > 0 ? camera::frameRateOf(every_nth) : 0;
  const camera::LinkMeter::Reading reading = meter_.read(std::chrono::steady_clock::now(), asked_rate);
  if (link_quality_.getNumSubscribers() > 0) {
    link_quality_.publish(linkQuality(reading, asked_rate, client_.status()));
  }
  diagnostics_.publish(reading, asked_rate);
}

void AiboDriver::publishTelemetry(const aibo_client::Telemetry& telemetry) {
  // The stamper needs all telemetry to learn the robot's clock, even if nobody listens.
  telemetry_stamper_.stamp(telemetry);
  measured_joints_.update(telemetry);
  telemetry_.publish(telemetry);
  if (footprint_) {
    footprint_->publish(telemetry);
  }
  odometry_.publish(telemetry);
  power_.update(telemetry);
}

void AiboDriver::publishStreaming(bool streaming) {
  std_msgs::Bool message;
  message.data = static_cast<std::uint8_t>(streaming);
  streaming_.publish(message);
}

void AiboDriver::updateConnection(const aibo_client::ConnectionStatus& status) {
  if (status.state == aibo_client::ConnectionState::kConnected) {
    // The mover is told first, because others may give orders as soon as they know of the connection.
    mover_.connected();
  }
  connection_.publish(toMessage(status, parameters_.client, settings_namespace_));
  if (leds_.update(status)) {
    led_states_.publish(leds_.states());
  }
  if (status.state != aibo_client::ConnectionState::kConnected) {
    measured_joints_.clear();
    mover_.disconnected();
    return;
  }
  if (!status.robot.design.empty() && status.robot.design != parameters_.robot) {
    // The robot can change its status as often as it likes, so the warning is limited.
    design_warnings_.warn("The robot says that it is an " + status.robot.design + ", but the parameter robot is " +
                          parameters_.robot + ": commands are refused. Set the parameter, and start the driver again.");
  }
}

}  // namespace aibo_driver::node
