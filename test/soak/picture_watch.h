/// @file picture_watch.h
#ifndef TEST_SOAK_PICTURE_WATCH_H
#define TEST_SOAK_PICTURE_WATCH_H

#include <ros/node_handle.h>
#include <sensor_msgs/CompressedImage.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "client/file_descriptor.h"
#include "picture_audit.h"
#include "violations.h"

namespace soak {

/// Follows the pictures that the driver publishes and the picture log of the robot. Any thread.
class PictureWatch {
 public:
  /// @param topic of the compressed pictures
  /// @param picture_log path of a named pipe for the robot's picture log, which is created
  /// @throw std::system_error the pipe cannot be created
  PictureWatch(const std::string& topic, const std::string& picture_log, Violations* violations);

  /// Waits for a picture whose image was taken at this time or later.
  /// @return how long after this time it was published; nothing if it did not come within `patience`
  std::optional<std::chrono::duration<double>> waitForPictureOf(PictureAudit::Time time, std::chrono::seconds patience);

  /// Begins a calm period, in which pictures that are left out are counted.
  void beginCalm();

  /// Waits for all pictures that were sent in the calm period, and ends it.
  void endCalm();

  /// See PictureAudit::setDamaging().
  void setDamaging(bool damaging);

  /// Reads the picture log, so that the pipe never fills up.
  void readLog();

  PictureAudit audit() const;

 private:
  void onPicture(const sensor_msgs::CompressedImage& picture);
  void readLogLocked();

  Violations* const violations_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  PictureAudit audit_;
  aibo_client::FileDescriptor log_;
  std::string unfinished_line_;
  ros::Subscriber subscriber_;
};

}  // namespace soak

#endif  // TEST_SOAK_PICTURE_WATCH_H
