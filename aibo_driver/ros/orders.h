/// @file orders.h
/// Who asks the driver for something, and since when.
#ifndef AIBO_DRIVER_ROS_ORDERS_H
#define AIBO_DRIVER_ROS_ORDERS_H

#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/service_callback_helper.h>

#include <boost/function.hpp>

#include <string>

#include "movement/movement.h"
#include "ros/callback_threads.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

/// Of a message. To be called in its callback.
template <typename Message>
movement::Order orderOf(const ros::MessageEvent<Message const>& event) {
  return {text::plainLine(event.getPublisherName()), receivedAt()};  // a stranger's choice
}

/// Of a goal of an action, or of its cancelling. To be called in its callback.
/// @param goal_id as actionlib's clients make it: the node, a number and a time, with hyphens between them
movement::Order orderOfGoal(const std::string& goal_id);

/// Advertises a service.
/// @param serve is called with the order, the request and the response, and returns true, as roscpp wants
template <typename Service, typename Serve>
ros::ServiceServer advertiseOrder(ros::NodeHandle& handle, const std::string& name, const Serve& serve) {
  using Event = ros::ServiceEvent<typename Service::Request, typename Service::Response>;
  const boost::function<bool(Event&)> callback = [serve](Event& event) {
    return serve(movement::Order{text::plainLine(event.getCallerName()), receivedAt()}, event.getRequest(),
                 event.getResponse());
  };
  return handle.advertiseService(name, callback);
}

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_ORDERS_H
