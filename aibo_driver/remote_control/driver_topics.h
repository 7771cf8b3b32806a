/// @file driver_topics.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_DRIVER_TOPICS_H
#define AIBO_DRIVER_REMOTE_CONTROL_DRIVER_TOPICS_H

#include <aibo_driver/Connection.h>
#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/Sound.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Header.h>

#include <QTimer>
#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "node/stop_client.h"
#include "remote_control/robot.h"
#include "sound/level.h"

namespace aibo_driver::remote_control {

/// A queue whose callbacks run on the thread that made it, which is the window's. All callbacks that have come run at
/// once, and then none for some time. Without this pause, a flood of messages would delay clicks, because Qt first
/// handles events that are posted again and again. During the pause, roscpp keeps the newest messages.
class WindowQueue : public ros::CallbackQueue {
 public:
  /// @param pause the callbacks wait for this time at most
  explicit WindowQueue(std::chrono::milliseconds pause);
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;

 private:
  QTimer timer_;
  std::atomic<bool> is_due_{false};  ///< the timer runs, or is about to run
};

/// The topics of one driver. The class turns the driver's messages into signals of the robot, and sends messages for
/// what the user wants.
///
/// Only one thread may make and change an object, and that thread may wait for the ROS master. All other functions wait
/// for nothing. Messages come on the window's thread, which also calls the publishing functions.
class DriverTopics {
 public:
  /// @param name_space the driver's namespace
  /// @param queue, measurements get the callbacks; both must outlive the object
  /// @param robot emits the signals
  /// @param connection_changed called when connection() or isHeard() may have changed
  DriverTopics(const std::string& name_space, WindowQueue* queue, WindowQueue* measurements, Robot& robot,
               const std::function<void()>& connection_changed);

  /// Subscribes to what somebody looks at, and to the driver's settings. Call this every few seconds.
  void show(const std::set<Part>& parts);

  /// The newest message about the connection. It is null if there was none.
  aibo_driver::Connection::ConstPtr connection() const;

  /// True if this object was made in the last seconds, so that the driver need not have been heard yet.
  bool areNew() const;

  /// True if the driver was heard in the last seconds. The driver sends something once a second.
  bool isHeard() const;

  /// True if the driver was ever heard.
  bool wasHeard() const;

  /// The namespace of the driver's settings (dynamic_reconfigure). It is empty while it is not known.
  std::string settings() const;

  /// The client that stops the robot, also while the ROS master does not answer.
  node::StopClient& stopClient() { return stop_client_; }

  void publishLeds(const QStringList& names, double intensity) const;
  void publishEars(bool left, bool right) const;
  void publishJoints(const JointPositions& positions) const;
  void publishVelocity(double forward, double left, double turn) const;

  /// @param place a place in the newest picture, 0..1 from left to right and from top to bottom
  /// @return false if nothing is known about the camera
  bool publishLookAt(const QPointF& place);

 private:
  template <typename Message>
  static ros::Subscriber subscribe(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue_size,
                                   const std::function<void(const Message&)>& receive);
  template <typename Message>
  void receiveAlways(const std::string& topic, const std::function<void(const Message&)>& receive);
  template <typename Message>
  void receiveWhileShown(Part part, ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue_size,
                         const std::function<void(const Message&)>& receive);
  void receiveStates();
  void receiveParts();
  void followSettings();
  void hear();
  void complain(const std::vector<EndedMovement>& ended);
  void receivePicture(const sensor_msgs::CompressedImage& message);
  void receiveJoints(const sensor_msgs::JointState& message);
  void receiveSound(const Sound& message);

  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
  ros::NodeHandle handle_;
  ros::NodeHandle measurements_handle_;
  Robot& robot_;
  const std::function<void()> connection_changed_;
  ros::Publisher leds_;
  ros::Publisher ears_;
  ros::Publisher joint_command_;
  ros::Publisher velocity_;
  ros::Publisher look_at_;
  node::StopClient stop_client_;

  mutable std::mutex mutex_;
  aibo_driver::Connection::ConstPtr connection_;      // guarded by mutex_
  std::chrono::steady_clock::time_point last_heard_;  // guarded by mutex_

  // Members that only the window's thread uses.
  std::optional<sensor_msgs::CameraInfo> camera_;    ///< the newest calibration
  ros::Time picture_stamp_;                          ///< the stamp of the newest picture
  std::optional<std_msgs::Header> asked_to_look_;    ///< the header of the last point, and of its result
  std::optional<std::vector<EndedMovement>> ended_;  ///< the movements that had ended in the newest motion_state
  JointPositions positions_;                         ///< the positions of all joints that were measured
  sound::Level level_;                               ///< the level of what was heard since it was shown last

  // Members that only the thread that made this object uses. They are last, because callbacks use all members above.
  std::map<Part, std::vector<std::function<ros::Subscriber()>>> sources_;  ///< what each part needs
  std::vector<ros::Subscriber> always_;
  std::map<Part, std::vector<ros::Subscriber>> shown_;
  std::string followed_;  ///< the namespace of the settings that are followed
  std::vector<ros::Subscriber> settings_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_DRIVER_TOPICS_H
