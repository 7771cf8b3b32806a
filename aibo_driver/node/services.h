/// @file services.h
/// The driver's services, in groups that share a callback queue. service.h has what they share.
///
/// If a call cannot be carried out, success is false and message says why. The call itself never fails. All arguments
/// must outlive the services.
#ifndef AIBO_DRIVER_NODE_SERVICES_H
#define AIBO_DRIVER_NODE_SERVICES_H

#include <ros/advertise_service_options.h>
#include <sensor_msgs/CompressedImage.h>

#include <functional>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "camera/stream_policy.h"
#include "movement/mover.h"
#include "node/driver_parameters.h"
#include "robot_model/robot_model.h"
#include "sound/player.h"

namespace aibo_driver::node {

/// Services that have not been advertised yet.
using Services = std::vector<ros::AdvertiseServiceOptions>;

/// stop, release and motors. Their calls must not wait for another service.
Services stopServices(movement::Mover& mover);

/// The name of a motion's file. The name of the motion is enough: see files::motionFileName().
/// @throw InvalidArgumentException no name is given
std::string motionNamed(const std::string& name);

/// play_motion and stop_motion. Each call waits until the robot has begun or stopped.
Services motionServices(movement::Mover& mover);

/// stand, sit and rest. Each call waits until the robot has taken the posture, at most 30 s. A newer posture ends an
/// older one, so several threads should serve these services.
Services postureServices(movement::Mover& mover);

/// list_motions, upload_motion, delete_motion, shut_down and reboot. They wait for the robot's memory stick or its
/// power supply, at most 15 s.
/// @param mover is asked whether the robot may be switched off, which lets a standing robot fall
Services robotServices(aibo_client::RcServerClient& client, const movement::Mover& mover);

/// take_picture_on_robot, list_pictures, fetch_picture and delete_picture: pictures on the robot's memory stick. The
/// name of a picture is enough: see files::pictureFileName(). Each call waits at most 15 s.
/// @param default_quality see takePictureServices()
Services stickPictureServices(const DriverParameters& parameters, aibo_client::RcServerClient& client,
                              const std::function<int()>& default_quality);

/// How many calls of take_picture wait for the robot at a time.
constexpr int kMostPictureCalls = 4;

/// take_picture, which waits for the robot. While kMostPictureCalls wait, further calls are refused at once.
/// @param default_quality returns the quality of a picture if the caller gives none, 1..100; any thread may call it
/// @param to_message makes the message in the answer; any thread may call it
Services takePictureServices(
    const DriverParameters& parameters, aibo_client::RcServerClient& client,
    const std::function<int()>& default_quality,
    const std::function<sensor_msgs::CompressedImage(const aibo_client::Picture&)>& to_message);

/// set_streaming and toggle_streaming, which do not wait.
Services streamServices(const DriverParameters& parameters, const aibo_client::RcServerClient& client,
                        camera::StreamPolicy& policy);

/// Gives a table to a channel of the colour detection; null takes the channel's table away.
using SetColorTable = std::function<void(int channel, const aibo_client::ColorTablePtr& table)>;

/// load_color_table, which does not wait.
Services colorTableServices(const robot_model::RobotModel& model, const aibo_client::RcServerClient& client,
                            const SetColorTable& set_table);

/// Loads tables for the channels 0, 1 and so on.
/// @param tables files or names for camera::loadColorTable(), separated by blanks or commas
/// @throw InvalidArgumentException a table cannot be loaded
void loadColorTables(const std::string& tables, const robot_model::RobotModel& model, const SetColorTable& set_table);

/// play_sound, say and set_volume. Their calls wait for espeak-ng and for the robot.
Services soundServices(aibo_client::RcServerClient& client, sound::Player& player);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_SERVICES_H
