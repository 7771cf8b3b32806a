/// @file stop_client.h
#ifndef AIBO_DRIVER_NODE_STOP_CLIENT_H
#define AIBO_DRIVER_NODE_STOP_CLIENT_H

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server_link.h>
#include <std_srvs/Trigger.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace aibo_driver::node {

/// Stops a robot. All programs that offer a stop use it.
///
/// The connection to the driver's service `stop` is open before it is needed. So a stop needs no ROS master, and no
/// descriptor that the driver might lack. In addition to the call, each stop sends a velocity of 0 and a trajectory
/// without points to the driver.
class StopClient {
 public:
  using Response = std_srvs::Trigger::Response;

  /// Begins to connect in a thread of its own, which connects again whenever this is necessary.
  /// @param handle a handle in the driver's namespace
  explicit StopClient(const ros::NodeHandle& handle);

  /// Ends the calls that are still running. None of their functions `done` is called from then on.
  ~StopClient();

  StopClient(const StopClient&) = delete;
  StopClient& operator=(const StopClient&) = delete;

  /// Stops the robot without waiting for anything, not even for earlier calls. Any thread may call it.
  /// @param done called on the call's thread with the answer, or with null if nobody answers
  void stop(const std::function<void(const Response*)>& done);

  /// The name of the service, with its namespace.
  const std::string& service() const { return service_; }

 private:
  // The class ros::ServiceClient is of no use here. It counts as valid for ever if its connection was refused at once,
  // as happens while the master still knows a driver that was killed.
  using Connection = std::shared_ptr<ros::ServiceServerLink>;

  struct Call {
    std::function<void(const Response*)> done;
    Connection connection;
    std::future<void> end;
  };

  static bool isOpen(const Connection& connection);
  static Connection connect(const std::string& service);

  void keepConnection();
  void run(Call* call);
  bool waitForConnection(Call* call);

  const std::string service_;
  const ros::Publisher velocity_;
  const ros::Publisher trajectory_;

  std::promise<void> end_;
  const std::shared_future<void> ended_{end_.get_future()};
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_ending_ = false;
  bool is_wanted_ = false;      ///< a call waits for a connection
  std::uint64_t attempts_ = 0;  ///< how many attempts to connect have ended
  Connection connection_;       ///< null before the first connection
  std::list<Call> calls_;
  std::thread keeper_;  // last, because it uses all members above
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_STOP_CLIENT_H
