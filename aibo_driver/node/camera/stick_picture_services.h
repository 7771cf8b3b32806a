/// @file stick_picture_services.h
#ifndef AIBO_DRIVER_NODE_CAMERA_STICK_PICTURE_SERVICES_H
#define AIBO_DRIVER_NODE_CAMERA_STICK_PICTURE_SERVICES_H

#include <aibo_driver/DeletePicture.h>
#include <aibo_driver/FetchPicture.h>
#include <aibo_driver/ListPictures.h>
#include <aibo_driver/TakePictureOnRobot.h>
#include <ros/node_handle.h>

#include <chrono>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "node/driver_parameters.h"

namespace aibo_driver::node {

/// The services for pictures on the robot's memory stick: take_picture_on_robot, list_pictures, fetch_picture and
/// delete_picture.
///
/// Each call waits for the robot's answer. If something cannot be done, success is false and message says why. The call
/// itself never fails. The name of a picture is enough: see files::pictureFileName().
class StickPictureServices {
 public:
  /// How long each call waits for the robot. A memory stick is slow.
  static constexpr std::chrono::milliseconds kTimeout{15000};

  /// @param client must outlive the services
  StickPictureServices(const DriverParameters& parameters, aibo_client::RcServerClient& client);

  /// @param handle its callbacks may wait for the memory stick
  void advertise(const ros::NodeHandle& handle);

  // These functions carry out the services. All of them return true, because roscpp wants that.
  bool takePicture(TakePictureOnRobot::Request& request, TakePictureOnRobot::Response& response);
  bool listPictures(ListPictures::Request& request, ListPictures::Response& response);
  bool fetchPicture(FetchPicture::Request& request, FetchPicture::Response& response);
  bool deletePicture(DeletePicture::Request& request, DeletePicture::Response& response);

 private:
  const std::string picture_folder_;  ///< the folder in which save_to may write
  const std::string frame_id_;
  aibo_client::RcServerClient& client_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_STICK_PICTURE_SERVICES_H
