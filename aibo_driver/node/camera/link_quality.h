/// @file link_quality.h
#ifndef AIBO_DRIVER_NODE_CAMERA_LINK_QUALITY_H
#define AIBO_DRIVER_NODE_CAMERA_LINK_QUALITY_H

#include <aibo_driver/LinkQuality.h>

#include "camera/link_meter.h"

namespace aibo_driver::node {

/// The message of the topic `link_quality`, without a stamp.
/// @param asked_rate the pictures a second that the robot is asked for now
LinkQuality toMessage(const camera::LinkMeter::Reading& reading, double asked_rate);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_LINK_QUALITY_H
