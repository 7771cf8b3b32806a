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

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// Hands on what is to be done with the robot of the window, on the window's thread.
using Post = std::function<void(const std::function<void(Robot&)>&)>;

/// The topics of one driver: turns its messages into signals, and wishes into messages.
///
/// To be made and to be changed by one thread, which may wait for the ROS master. The publishing functions wait for
/// nothing and may be called from any thread.
class DriverTopics {
 public:
  /// @param handle in the driver's namespace; one thread serves its callback queue
  /// @param post must work until this object is gone
  /// @param connection_changed is called when connection() or isHeard() may have changed
  DriverTopics(const ros::NodeHandle& handle, const Post& post, const std::function<void()>& connection_changed);

  /// Subscribes to a part while somebody looks at it. To be called every few seconds.
  void show(Part part, bool visible);

  /// Hands on what has been measured of joints and sensors since the last call. They come up to 31 times a second each,
  /// which no eye follows, and to wake a thread for each would take more time than all else that they need.
  /// On one thread, always the same.
  void takeMeasurements();

  /// Subscribes to the settings that have this owner; does nothing if it has done so. Empty: to none.
  void followSettings(const std::string& owner);

  /// The newest message about the connection; null if there was none.
  aibo_driver::Connection::ConstPtr connection() const;

  /// Whether the driver was heard in the last seconds. It says something once a second.
  bool isHeard() const;

  std::string settingsOwner() const { return settings_owner_; }

  void publishLeds(const QStringList& names, double intensity) const;
  void publishEars(bool left, bool right) const;
  void publishJoints(const JointPositions& positions) const;
  void publishVelocity(double forward, double left, double turn) const;

  /// @param place of the newest picture, 0..1 from left to right and from top to bottom
  /// @return false if no picture, or nothing of its camera, is known
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

  ros::CallbackQueue measurements_;  ///< until takeMeasurements()
  ros::NodeHandle handle_;
  ros::NodeHandle measurements_handle_;
  const Post post_;
  ros::Publisher leds_;
  ros::Publisher ears_;
  ros::Publisher joint_command_;
  ros::Publisher velocity_;
  ros::Publisher look_at_;

  mutable std::mutex mutex_;
  aibo_driver::Connection::ConstPtr connection_;
  std::chrono::steady_clock::time_point last_heard_;
  std::optional<sensor_msgs::CameraInfo> camera_;  ///< its first message; other sizes of pictures have the same view
  ros::Time picture_stamp_;                        ///< of the newest

  struct Newest {
    std::mutex mutex;
    QImage picture;  ///< on its way to the window; null if none is
  };
  const std::shared_ptr<Newest> newest_ = std::make_shared<Newest>();
  std::atomic<bool> asked_to_look_{false};
  std::optional<std::vector<EndedMovement>> ended_;  ///< as the newest motion_state has them
  JointPositions positions_;                         ///< all that were measured
  bool positions_are_new_ = false;
  std::string settings_owner_;
  std::map<std::string, ros::Subscriber> subscribers_;  // last: their callbacks use all of the above
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_DRIVER_TOPICS_H
