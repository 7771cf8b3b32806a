/// @file aibo_driver.h
#ifndef AIBO_DRIVER_NODE_AIBO_DRIVER_H
#define AIBO_DRIVER_NODE_AIBO_DRIVER_H

#include <aibo_driver/Connection.h>
#include <aibo_driver/LedStates.h>
#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <std_msgs/Bool.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "camera/link_meter.h"
#include "camera/stream_adapter.h"
#include "camera/stream_policy.h"
#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "movement/mover.h"
#include "node/actions.h"
#include "node/body/footprint_publisher.h"
#include "node/body/led_memory.h"
#include "node/body/leds_and_ears.h"
#include "node/body/power_status.h"
#include "node/body/telemetry_publishers.h"
#include "node/callback_threads.h"
#include "node/camera/camera_publisher.h"
#include "node/camera/color_publisher.h"
#include "node/camera/raw_image_publisher.h"
#include "node/driver_diagnostics.h"
#include "node/driver_parameters.h"
#include "node/joints/joint_commander.h"
#include "node/joints/motion_state_publisher.h"
#include "node/live_settings.h"
#include "node/only_driver.h"
#include "node/robot_stamper.h"
#include "node/services.h"
#include "node/sound/microphone_publisher.h"
#include "node/state_publisher.h"
#include "node/stop_memory.h"
#include "node/walk/body_pose_commander.h"
#include "node/walk/goal_walks.h"
#include "node/walk/odometry_publisher.h"
#include "node/walk/walk_commander.h"
#include "robot_model/robot_model.h"
#include "robot_time/robot_clock.h"
#include "sound/player.h"
#include "text/throttled_warnings.h"
#include "walk/get_up.h"

namespace aibo_driver::node {

/// The whole driver. The node and the nodelet wrap it. docs/ros_interface.md describes it from outside.
///
/// Three kinds of work have threads of their own, so that none delays another: what stops the robot, what orders it to
/// move, and what waits. The queue of the handle serves everything else, which does not wait.
class AiboDriver {
 public:
  /// Begins to connect and to publish. If the robot is not there, the driver goes on trying.
  /// @param handle the driver's namespace; the root namespace means /aibo
  /// @param private_handle the namespace of the parameters
  /// @param name the name of the node or nodelet, with its namespace, for the diagnostics
  /// @throw InvalidArgumentException a parameter is wrong; the message names it and what is allowed
  /// @throw std::runtime_error another driver has this namespace; the message names its node
  AiboDriver(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, const std::string& name);

  /// Ends the driver within a second.
  ~AiboDriver();

  AiboDriver(const AiboDriver&) = delete;
  AiboDriver& operator=(const AiboDriver&) = delete;

 private:
  aibo_client::Callbacks makeCallbacks();
  void publishPicture(const aibo_client::Picture& picture);

  /// Publishes link_quality and the diagnostics.
  void report();

  /// The robot is asked for every nth image; 0 while the stream is off.
  int askedEveryNthImage() const;

  void publishTelemetry(const aibo_client::Telemetry& telemetry);
  void publishStreaming(bool streaming);
  void updateConnection(const aibo_client::ConnectionStatus& status);
  void advertiseServices();
  void advertise(ros::NodeHandle handle, Services services);
  void startActions();
  void stayStopped();
  void letItGetUp(const std::string& source);
  void refused(const aibo_client::Refusal& refusal);
  movement::Mover::Listener makeListener();
  void logEnd(const movement::EndedMovement& ended);

  /// The robot's clock; null if the stamps should not use it.
  robot_time::RobotClock* usedRobotClock() { return parameters_.use_robot_time ? &robot_clock_ : nullptr; }

  // Each member uses only the members before it. ROS may call back as soon as a topic or service is advertised.
  ReceiptClock receipts_;
  const SignsOfLife signs_of_life_{receipts_};
  /// The thread for settings, reports, and subscribers that come and go. It is not in the pool, because callers that
  /// wait there would delay it.
  CallbackThreads own_thread_;
  ros::NodeHandle handle_;
  const OnlyDriver only_driver_;
  const DriverParameters parameters_;
  const robot_model::RobotModel& model_;

  CallbackThreads stop_threads_;   ///< for stop, release and motors, which wait for nothing else
  CallbackThreads order_thread_;   ///< for all orders to move that do not wait for the robot, LEDs and ears, in order
  CallbackThreads motion_thread_;  ///< for what waits until the robot plays a motion, or begins a posture
  CallbackThreads stick_thread_;   ///< for what waits for the memory stick, up to 15 s
  CallbackThreads sound_thread_;   ///< for what waits for espeak-ng, and until the robot plays
  CallbackThreads pool_;           ///< for take_picture and the services of postures, whose calls wait side by side

  /// All members that have threads.
  const std::array<CallbackThreads*, 7> threads_{&own_thread_,   &stop_threads_, &order_thread_, &motion_thread_,
                                                 &stick_thread_, &sound_thread_, &pool_};

  // The client's callbacks need these members.
  text::ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("joints", text); }};
  text::ThrottledWarnings design_warnings_{[](const std::string& text) { ROS_WARN_STREAM(text); }};
  robot_time::RobotClock robot_clock_;
  RobotStamper telemetry_stamper_;
  movement::JointTable joint_table_;
  movement::MeasuredJoints measured_joints_;
  PowerStatus power_;
  camera::LinkMeter meter_;
  camera::StreamPolicy policy_;
  const std::string settings_namespace_;
  StatePublisher<Connection> connection_;
  StatePublisher<std_msgs::Bool> streaming_;
  CameraPublisher camera_;
  RawImagePublisher raw_images_;
  ColorPublisher colors_;
  MicrophonePublisher microphone_;
  TelemetryPublishers telemetry_;
  std::optional<FootprintPublisher> footprint_;  ///< only for an ERS-7, and only if publish_footprint is set
  OdometryPublisher odometry_;
  LedMemory leds_;
  StatePublisher<LedStates> led_states_;
  ros::SteadyTimer get_up_timer_;      ///< runs out on pool_ when the robot is to get up
  std::optional<walk::GetUp> get_up_;  ///< only if the parameter get_up is set

  aibo_client::RcServerClient client_;
  sound::Player player_;  ///< plays nothing before the client runs

  // These members need the client.
  camera::StreamAdapter adapter_;
  ros::Publisher link_quality_;
  LiveSettings settings_;
  movement::Mover mover_;
  StopMemory stop_memory_;
  MotionStatePublisher motion_state_;
  JointCommander joints_;
  BodyPoseCommander body_pose_;
  WalkCommander walk_;
  GoalWalks goal_walks_;
  LedsAndEars leds_and_ears_;
  std::vector<ros::ServiceServer> services_;
  std::vector<Action> actions_;
  DriverDiagnostics diagnostics_;
  ros::SteadyTimer report_timer_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_AIBO_DRIVER_H
