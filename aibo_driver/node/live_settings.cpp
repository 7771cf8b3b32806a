#include "node/live_settings.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "camera/camera_options.h"
#include "node/driver_parameters.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

LiveSettings::LiveSettings(const ros::NodeHandle& private_handle, aibo_client::RcServerClient& client,
                           camera::StreamAdapter& adapter, movement::JointTable& joint_table)
    : client_(client),
      adapter_(adapter),
      joint_table_(joint_table),
      warnings_([](const std::string& text) { ROS_WARN_STREAM(text); }),
      in_force_log_([](const std::string& text) { ROS_INFO_STREAM(text); }),
      in_force_(AiboDriverConfig::__getDefault__()),
      server_(private_handle) {
  AiboDriverConfig least = in_force_;
  AiboDriverConfig most = in_force_;
  visitLiveNumbers([&](const char*, const char*, auto member, auto lowest, auto highest) {
    least.*member = lowest;
    most.*member = highest;
  });
  server_.setConfigMin(least);
  server_.setConfigMax(most);
  server_.setCallback([this](AiboDriverConfig& config, std::uint32_t) { apply(config); });
}

void LiveSettings::apply(AiboDriverConfig& config) {
  visitLiveNumbers([&](const char* name, const char*, auto member, auto lowest, auto highest) {
    auto& value = config.*member;
    if (value >= lowest && value <= highest) {
      return;
    }
    std::ostringstream text;
    text << "The " << name << " " << value << " is not in the range of " << lowest << ".." << highest << ": ";
    value = std::isnan(value) ? in_force_.*member : std::clamp(value, lowest, highest);
    text << value << " is used.";
    warnings_.warn(text.str());
  });
  applyToCamera(config);
  telemetry_period_ = telemetryPeriodOf(config.telemetry_rate);
  config.telemetry_rate = telemetryRateOf(telemetry_period_);
  client_.setTelemetryPeriod(telemetry_period_);
  joint_table_.setSpeedScale(config.speed_scale);
  client_.guardWalks(config.guard);
  in_force_ = config;
  std::ostringstream text;
  text << "Settings in force: jpeg_quality " << config.jpeg_quality << " of 1..100, resolution " << config.resolution
       << ", frame_rate " << config.frame_rate << " of 2..30, transport " << config.transport << ", adaptive "
       << (config.adaptive ? "on" : "off") << ", max_picture_age " << config.max_picture_age
       << " of 0.05..2, telemetry_rate " << config.telemetry_rate << " of 0..31.25, speed_scale " << config.speed_scale
       << " of 0.1..1, guard " << (config.guard ? "on" : "off") << ".";
  in_force_log_.say(text.str());
}

void LiveSettings::applyToCamera(AiboDriverConfig& config) {
  if (!camera::resolutionOf(config.resolution)) {
    warnings_.warn("The resolution '" + text::plainLine(config.resolution) + "' is not one of " +
                   camera::kResolutionNames + ": it stays at " + in_force_.resolution + ".");
    config.resolution = in_force_.resolution;
  }
  camera::StreamAdapter::Wish stream;
  stream.jpeg_quality = config.jpeg_quality;
  stream.format.resolution = *camera::resolutionOf(config.resolution);
  stream.format.every_nth_image = camera::everyNthImageOf(config.frame_rate);
  stream.adaptive = config.adaptive;
  stream.max_picture_age = config.max_picture_age;
  config.frame_rate = camera::frameRateOf(stream.format.every_nth_image);
  adapter_.setWish(stream);
  if (!camera::transportOf(config.transport)) {
    warnings_.warn("The transport '" + text::plainLine(config.transport) + "' is not one of " +
                   camera::kTransportNames + ": it stays at " + in_force_.transport + ".");
    config.transport = in_force_.transport;
  }
  client_.setPictureTransport(*camera::transportOf(config.transport));
  aibo_client::CameraSettings camera;
  camera.white_balance = config.white_balance;
  camera.gain = config.gain;
  camera.shutter_speed = config.shutter_speed;
  camera.auto_exposure = config.auto_exposure;
  camera.auto_white_balance = config.auto_white_balance;
  client_.setCameraSettings(camera);
}

}  // namespace aibo_driver::node
