/// @file service_calls.h
#ifndef AIBO_DRIVER_NODE_SERVICE_CALLS_H
#define AIBO_DRIVER_NODE_SERVICE_CALLS_H

#include <ros/node_handle.h>
#include <ros/service_client.h>

#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "node/xmlrpc_peer.h"

namespace aibo_driver::node {

/// Calls services without waiting for them. Each call has a thread of its own, so that no call waits for another one.
///
/// A service has at most one call at a time. If a server never answers a call, the call ends with the server's process
/// or with this object. Only one thread may use this object.
class ServiceCalls {
 public:
  ServiceCalls() = default;

  /// Ends the calls that are still running. None of their functions `done` is called from then on.
  ~ServiceCalls() { cancel(); }

  ServiceCalls(const ServiceCalls&) = delete;
  ServiceCalls& operator=(const ServiceCalls&) = delete;

  /// @param name the name of the service, with its namespace
  /// @param done called on the call's thread with the answer, or with null if there is none
  /// @return false if the last call of this service has not been answered yet; in that case there is no new call
  template <typename Service>
  bool start(const std::string& name, const typename Service::Request& request,
             const std::function<void(const typename Service::Response*)>& done) {
    return run(name, [this, name, request, done](Call& call) {
      typename Service::Response response;
      ros::ServiceClient client;
      if (isAdvertised(name)) {             // without this check, roscpp would wait for a master that hangs
        constexpr bool kPersistent = true;  // needed because another thread can end only such a connection
        client = ros::NodeHandle().serviceClient<Service>(name, kPersistent);
      }
      const bool answered = shareClient(call, client) && client.call(request, response);
      if (!isEnding()) {
        done(answered ? &response : nullptr);
      }
    });
  }

  /// Ends the calls as the destructor does.
  void cancel();

 private:
  struct Call {
    std::string name;
    ros::ServiceClient client;
    std::thread thread;
    bool is_over = false;
  };

  bool run(const std::string& name, const std::function<void(Call&)>& work);
  bool shareClient(Call& call, const ros::ServiceClient& client);
  bool isEnding();

  std::mutex mutex_;
  std::list<Call> calls_;
  bool is_ending_ = false;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_SERVICE_CALLS_H
