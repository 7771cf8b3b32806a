#include "node/live_settings.h"

#include <ros/console.h>

#include <cmath>
#include <cstdint>
#include <sstream>

#include "node/camera/camera_options.h"
#include "node/driver_parameters.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

LiveSettings::LiveSettings(const ros::NodeHandle& private_handle, aibo_client::RcServerClient& client,
                           StreamAdapter& adapter, movement::JointTable& joint_table)
    : client_(client),
      adapter_(adapter),
      joint_table_(joint_table),
      warnings_([](const std::string& text) { ROS_WARN_STREAM(text); }),
      in_force_log_([](const std::string& text) { ROS_INFO_STREAM(text); }),
      in_force_(AiboDriverConfig::__getDefault__()),
      server_(private_handle) {
  server_.setCallback([this](AiboDriverConfig& config, std::uint32_t) { apply(config); });
}

void LiveSettings::apply(AiboDriverConfig& config) {
  // NaN is the only number out of range that passes the server's check.
  if (std::isnan(config.telemetry_rate)) {
    config.telemetry_rate = in_force_.telemetry_rate;
  }
  if (std::isnan(config.speed_scale)) {
    config.speed_scale = in_force_.speed_scale;
  }
  if (std::isnan(config.frame_rate)) {
    config.frame_rate = in_force_.frame_rate;
  }
  if (std::isnan(config.max_picture_age)) {
    config.max_picture_age = in_force_.max_picture_age;
  }
  applyToCamera(config);
  telemetry_period_ = telemetryPeriodOf(config.telemetry_rate);
  config.telemetry_rate = telemetryRateOf(telemetry_period_);
  client_.setTelemetryPeriod(telemetry_period_);
  joint_table_.setSpeedScale(config.speed_scale);
  in_force_ = config;
  std::ostringstream text;
  text << "Settings in force: jpeg_quality " << config.jpeg_quality << " of 1..100, resolution " << config.resolution
       << ", frame_rate " << config.frame_rate << " of 2..30, transport " << config.transport << ", adaptive "
       << (config.adaptive ? "on" : "off") << ", max_picture_age " << config.max_picture_age
       << " of 0.05..2, telemetry_rate " << config.telemetry_rate << " of 0..31.25, speed_scale " << config.speed_scale
       << " of 0.1..1.";
  in_force_log_.say(text.str());
}

void LiveSettings::applyToCamera(AiboDriverConfig& config) {
  if (!resolutionOf(config.resolution)) {
    warnings_.warn("The resolution '" + text::plainLine(config.resolution) + "' is not one of " + kResolutionNames +
                   ": it stays at " + in_force_.resolution + ".");
    config.resolution = in_force_.resolution;
  }
  StreamAdapter::Wish stream;
  stream.jpeg_quality = config.jpeg_quality;
  stream.format.resolution = *resolutionOf(config.resolution);
  stream.format.every_nth_image = everyNthImageOf(config.frame_rate);
  stream.adaptive = config.adaptive;
  stream.max_picture_age = config.max_picture_age;
  config.frame_rate = frameRateOf(stream.format.every_nth_image);
  adapter_.setWish(stream);
  if (!transportOf(config.transport)) {
    warnings_.warn("The transport '" + text::plainLine(config.transport) + "' is not one of " + kTransportNames +
                   ": it stays at " + in_force_.transport + ".");
    config.transport = in_force_.transport;
  }
  client_.setPictureTransport(*transportOf(config.transport));
  aibo_client::CameraSettings camera;
  camera.white_balance = config.white_balance;
  camera.gain = config.gain;
  camera.shutter_speed = config.shutter_speed;
  camera.auto_exposure = config.auto_exposure;
  camera.auto_white_balance = config.auto_white_balance;
  client_.setCameraSettings(camera);
}

}  // namespace aibo_driver::node
