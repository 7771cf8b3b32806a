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

/// A queue whose callbacks run on the thread that made it, the window's: all that have come at once, and then none for
/// some time. Without this pause, a flood of messages would keep the window from clicks, because Qt handles events that
/// are posted again and again first. roscpp keeps the newest messages meanwhile.
class WindowQueue : public ros::CallbackQueue {
 public:
  /// @param pause the callbacks wait for this time at most
  explicit WindowQueue(std::chrono::milliseconds pause);
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;

 private:
  QTimer timer_;
  std::atomic<bool> is_due_{false};  ///< the timer runs, or is about to
};

/// The topics of one driver. It emits the robot's signals for the driver's messages, and sends messages for what the
/// user wants.
///
/// One thread must make and change it. That thread may wait for the ROS master. All other functions wait for nothing.
/// Messages come on the window's thread, which also calls the publishing functions.
class DriverTopics {
 public:
  /// @param name_space the driver's namespace
  /// @param queue, measurements get the callbacks; both must outlive this object
  /// @param robot emits the signals
  /// @param connection_changed called when connection() or isHeard() may have changed
  DriverTopics(const std::string& name_space, WindowQueue* queue, WindowQueue* measurements, Robot& robot,
               const std::function<void()>& connection_changed);

  /// Subscribes to what somebody looks at, and to the driver's settings. Call this every few seconds.
  void show(const std::set<Part>& parts);

  /// The newest message about the connection. It is null if there was none.
  aibo_driver::Connection::ConstPtr connection() const;

  /// Whether this object was made in the last seconds, so that the driver need not have been heard yet.
  bool areNew() const;

  /// Whether the driver was heard in the last seconds. The driver sends something once a second.
  bool isHeard() const;

  /// Whether the driver was ever heard.
  bool wasHeard() const;

  /// Where the driver has its settings (dynamic_reconfigure). It is empty while this is not known.
  std::string settings() const;

  /// Stops the robot, also while the ROS master does not answer.
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

  // The window's thread uses these members.
  std::optional<sensor_msgs::CameraInfo> camera_;    ///< the newest calibration
  ros::Time picture_stamp_;                          ///< the stamp of the newest picture
  std::optional<std_msgs::Header> asked_to_look_;    ///< that of the last point on look_at; its result has it, too
  std::optional<std::vector<EndedMovement>> ended_;  ///< the movements that had ended in the newest motion_state
  JointPositions positions_;                         ///< of all joints that were measured
  sound::Level level_;                               ///< of what was heard since it was shown last

  // The thread that made this object uses these members. They are last, because callbacks use all members above.
  std::map<Part, std::vector<std::function<ros::Subscriber()>>> sources_;  ///< what a part needs
  std::vector<ros::Subscriber> always_;
  std::map<Part, std::vector<ros::Subscriber>> shown_;
  std::string followed_;  ///< the settings that are followed
  std::vector<ros::Subscriber> settings_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_DRIVER_TOPICS_H
