#include "ros/live_settings.h"

#include <ros/console.h>

#include <cmath>
#include <cstdint>
#include <utility>

namespace aibo_driver::node {

LiveSettings::LiveSettings(const ros::NodeHandle& private_handle, Targets targets)
    : targets_(std::move(targets)), in_force_(AiboDriverConfig::__getDefault__()), server_(private_handle) {
  server_.setCallback([this](AiboDriverConfig& config, std::uint32_t) { apply(config); });
}

void LiveSettings::apply(AiboDriverConfig& config) {
  // Of all numbers, these alone pass the server's check of ranges.
  if (std::isnan(config.telemetry_rate)) {
    config.telemetry_rate = in_force_.telemetry_rate;
  }
  if (std::isnan(config.speed_scale)) {
    config.speed_scale = in_force_.speed_scale;
  }
  telemetry_period_ = telemetryPeriodOf(config.telemetry_rate);
  config.telemetry_rate = telemetryRateOf(telemetry_period_);
  targets_.set_jpeg_quality(config.jpeg_quality);
  targets_.set_telemetry_period(telemetry_period_);
  targets_.set_speed_scale(config.speed_scale);
  in_force_ = config;
  ROS_INFO_STREAM("In force: jpeg_quality " << config.jpeg_quality << " of 1..100, telemetry_rate "
                                            << config.telemetry_rate << " of 0..31.25, speed_scale "
                                            << config.speed_scale << " of 0.1..1.");
}

}  // namespace aibo_driver::node
