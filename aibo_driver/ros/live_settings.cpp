#include "ros/live_settings.h"

#include <ros/console.h>

#include <cmath>
#include <cstdint>

#include "ros/driver_parameters.h"

namespace aibo_driver::node {

LiveSettings::LiveSettings(const ros::NodeHandle& private_handle, RcServerClient& client,
                           joints::JointTable& joint_table)
    : client_(client),
      joint_table_(joint_table),
      in_force_(AiboDriverConfig::__getDefault__()),
      server_(private_handle) {
  server_.setCallback([this](AiboDriverConfig& config, std::uint32_t) { apply(config); });
}

void LiveSettings::apply(AiboDriverConfig& config) {
  // NaN is the one number out of range that passes the server's check.
  if (std::isnan(config.telemetry_rate)) {
    config.telemetry_rate = in_force_.telemetry_rate;
  }
  if (std::isnan(config.speed_scale)) {
    config.speed_scale = in_force_.speed_scale;
  }
  telemetry_period_ = telemetryPeriodOf(config.telemetry_rate);
  config.telemetry_rate = telemetryRateOf(telemetry_period_);
  client_.setJpegQuality(config.jpeg_quality);
  client_.setTelemetryPeriod(telemetry_period_);
  joint_table_.setSpeedScale(config.speed_scale);
  in_force_ = config;
  ROS_INFO_STREAM("Settings in force: jpeg_quality " << config.jpeg_quality << " of 1..100, telemetry_rate "
                                                     << config.telemetry_rate << " of 0..31.25, speed_scale "
                                                     << config.speed_scale << " of 0.1..1.");
}

}  // namespace aibo_driver::node
