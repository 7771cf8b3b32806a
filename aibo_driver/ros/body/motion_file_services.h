/// @file motion_file_services.h
#ifndef AIBO_DRIVER_ROS_BODY_MOTION_FILE_SERVICES_H
#define AIBO_DRIVER_ROS_BODY_MOTION_FILE_SERVICES_H

#include <aibo_driver/DeleteMotion.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/UploadMotion.h>
#include <ros/node_handle.h>

#include <chrono>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver::node {

/// The services list_motions, upload_motion and delete_motion: the files on the robot's memory stick.
class MotionFileServices {
 public:
  /// A memory stick takes its time.
  static constexpr std::chrono::milliseconds kTimeout{5000};
  static constexpr std::chrono::milliseconds kUploadTimeout{15000};

  /// @param client must outlive the services
  MotionFileServices(const ros::NodeHandle& handle, RcServerClient& client);

 private:
  bool listMotions(ListMotions::Request& request, ListMotions::Response& response);
  bool uploadMotion(UploadMotion::Request& request, UploadMotion::Response& response);
  bool deleteMotion(DeleteMotion::Request& request, DeleteMotion::Response& response);

  RcServerClient& client_;
  ros::ServiceServer list_server_;
  ros::ServiceServer upload_server_;
  ros::ServiceServer delete_server_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_MOTION_FILE_SERVICES_H
