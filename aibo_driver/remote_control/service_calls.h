/// @file service_calls.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_SERVICE_CALLS_H
#define AIBO_DRIVER_REMOTE_CONTROL_SERVICE_CALLS_H

#include <ros/node_handle.h>
#include <ros/service_client.h>

#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

namespace aibo_driver::remote_control {

/// Calls services without waiting for them: each call has a thread of its own, so that none waits for another one.
///
/// A service is called once at a time. A call that its server never answers ends with the server's process, or with
/// this object. From one thread.
class ServiceCalls {
 public:
  ServiceCalls() = default;

  /// Ends the calls that are under way. None of their functions is called from then on.
  ~ServiceCalls() { cancel(); }

  ServiceCalls(const ServiceCalls&) = delete;
  ServiceCalls& operator=(const ServiceCalls&) = delete;

  /// @param name of the service, with its namespace
  /// @param done is called on the call's thread with the answer, or with null if there is none
  /// @return false if the last call of this service has not been answered; then nothing is done
  template <typename Service>
  bool start(const std::string& name, const typename Service::Request& request,
             const std::function<void(const typename Service::Response*)>& done) {
    return run(name, [this, name, request, done](Call& call) {
      // Only a connection that persists can be ended from another thread.
      constexpr bool kPersistent = true;
      typename Service::Response response;
      ros::ServiceClient client = handle_.serviceClient<Service>(name, kPersistent);
      const bool answered = publishClient(call, client) && client.call(request, response);
      if (!isEnding()) {
        done(answered ? &response : nullptr);
      }
    });
  }

  /// As the destructor.
  void cancel();

 private:
  struct Call {
    std::string name;
    ros::ServiceClient client;
    std::thread thread;
    bool is_over = false;
  };

  bool run(const std::string& name, const std::function<void(Call&)>& work);
  bool publishClient(Call& call, const ros::ServiceClient& client);
  bool isEnding();

  std::mutex mutex_;
  ros::NodeHandle handle_;
  std::list<Call> calls_;
  bool is_ending_ = false;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_SERVICE_CALLS_H
