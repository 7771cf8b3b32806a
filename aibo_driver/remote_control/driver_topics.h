/// @file driver_topics.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_DRIVER_TOPICS_H
#define AIBO_DRIVER_REMOTE_CONTROL_DRIVER_TOPICS_H

#include <aibo_driver/Connection.h>
#include <aibo_driver/EndedMovement.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Header.h>

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "node/stop_client.h"
#include "remote_control/robot.h"
#include "sound/level.h"

namespace aibo_driver::remote_control {

/// Runs a function with the window's robot on the window's thread.
using Post = std::function<void(const std::function<void(Robot&)>&)>;

/// The topics of one driver. It turns the driver's messages into signals, and the user's wishes into messages.
///
/// One thread must make and change it. That thread may wait for the ROS master. The publishing functions wait for
/// nothing, and any thread may call them.
class DriverTopics {
 public:
  /// @param handle a handle in the driver's namespace; one thread serves its callback queue
  /// @param post must work until this object is gone
  /// @param connection_changed called when connection() or isHeard() may have changed
  DriverTopics(const ros::NodeHandle& handle, const Post& post, const std::function<void()>& connection_changed);

  /// Subscribes to a part while somebody looks at it. Call this every few seconds.
  void show(Part part, bool visible);

  /// Passes on what has been measured of joints and sensors since the last call. They may come 31 times a second, which
  /// no eye can follow, and waking a thread for each message would take more time than everything else. Always call it
  /// on the same thread.
  void takeMeasurements();

  /// Subscribes to the settings that have this owner, unless it has done so already. With an empty owner, it only ends
  /// the subscription.
  void followSettings(const std::string& owner);

  /// The newest message about the connection. It is null if there was none.
  aibo_driver::Connection::ConstPtr connection() const;

  /// Whether this object was made in the last seconds, so that the driver need not have been heard yet.
  bool areNew() const;

  /// Whether the driver was heard in the last seconds. The driver sends something once a second.
  bool isHeard() const;

  /// Whether the driver was ever heard.
  bool wasHeard() const;

  std::string settingsOwner() const { return settings_owner_; }

  /// Stops the robot, also while the ROS master does not answer.
  node::StopClient& stopClient() { return stop_client_; }

  void publishLeds(const QStringList& names, double intensity) const;
  void publishEars(bool left, bool right) const;
  void publishJoints(const JointPositions& positions) const;
  void publishVelocity(double forward, double left, double turn) const;

  /// @param place a place in the newest picture, 0..1 from left to right and from top to bottom
  /// @return false if there is no picture, or if nothing is known about its camera
  bool publishLookAt(const QPointF& place);

 private:
  template <typename Message>
  void subscribe(const std::string& topic, const std::function<void(const Message&)>& receive);
  template <typename Message>
  void subscribeMeasurements(const std::string& topic, std::uint32_t queue_size,
                             const std::function<void(const Message&)>& receive);
  template <typename Message>
  void subscribeIn(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue_size,
                   const std::function<void(const Message&)>& receive);
  void subscribeStates(const std::function<void()>& connection_changed);
  void subscribeAnswers();
  void complain(const std::vector<EndedMovement>& ended);
  void showPictures(bool visible);
  void showSensors(bool visible);
  void drop(const std::vector<std::string>& topics);
  void hear(const std::function<void()>& connection_changed);
  void receivePicture(const sensor_msgs::CompressedImage& message);
  void receiveJoints(const sensor_msgs::JointState& message);

  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
  ros::CallbackQueue measurements_;  ///< they wait until takeMeasurements()
  ros::NodeHandle handle_;
  ros::NodeHandle measurements_handle_;
  const Post post_;
  ros::Publisher leds_;
  ros::Publisher ears_;
  ros::Publisher joint_command_;
  ros::Publisher velocity_;
  ros::Publisher look_at_;
  node::StopClient stop_client_;

  mutable std::mutex mutex_;
  aibo_driver::Connection::ConstPtr connection_;
  std::chrono::steady_clock::time_point last_heard_;
  std::optional<sensor_msgs::CameraInfo> camera_;  ///< the first calibration; it holds for all sizes
  ros::Time picture_stamp_;                        ///< the stamp of the newest picture
  std::optional<std_msgs::Header> asked_to_look_;  ///< the header of the last point on look_at; its result has it, too

  struct Newest {
    std::mutex mutex;
    QImage picture;  ///< the picture on its way to the window; null if there is none
  };
  const std::shared_ptr<Newest> newest_ = std::make_shared<Newest>();
  std::optional<std::vector<EndedMovement>> ended_;  ///< the movements that had ended in the newest motion_state
  JointPositions positions_;                         ///< the positions of all joints that were measured
  bool positions_are_new_ = false;
  sound::Level level_;  ///< of what was heard since takeMeasurements()
  std::string settings_owner_;
  std::map<std::string, ros::Subscriber> subscribers_;  // last, because their callbacks use all members above
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_DRIVER_TOPICS_H
