/// @file service.h
#ifndef AIBO_DRIVER_NODE_SERVICE_H
#define AIBO_DRIVER_NODE_SERVICE_H

#include <ros/advertise_service_options.h>

#include <cstddef>
#include <exception>
#include <string>

#include "movement/movement.h"
#include "node/callback_threads.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

/// One call of a service. The response has at least the members success and message.
template <typename Service>
struct ServiceCall {
  const typename Service::Request& request;
  typename Service::Response& response;
  movement::Order order;  ///< the order, with the node that calls and the time when the call came
  std::string failure;    ///< says what was not done; the message begins with it if the call fails
};

/// Makes a service whose calls always get an answer. The answer's message quotes callers and the robot, so it is plain
/// text (text::plainText()) of at most 4000 bytes.
/// @param failure see ServiceCall::failure
/// @param work called with a `ServiceCall<Service>&`. It carries out the call and returns a message that says so. If it
///   throws, success is false, and the message says why. `work` may also set success to false itself
template <typename Service, typename Work>
ros::AdvertiseServiceOptions service(const std::string& name, const std::string& failure, const Work& work) {
  using Event = ros::ServiceEvent<typename Service::Request, typename Service::Response>;
  const auto serve = [failure, work](Event& event) {
    typename Service::Response& response = event.getResponse();
    ServiceCall<Service> call = {
        event.getRequest(), response, {text::plainLine(event.getCallerName()), receivedAt()}, failure};
    response.success = true;
    try {
      response.message = work(call);
    } catch (const std::exception& error) {
      response.success = false;
      response.message = call.failure + ": " + error.what();
    }
    constexpr std::size_t kLongest = 4000;
    response.message = text::plainText(response.message.substr(0, kLongest));
    return true;  // the call itself never fails
  };
  ros::AdvertiseServiceOptions options;
  options.initBySpecType<Event>(name, serve);
  return options;
}

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_SERVICE_H
