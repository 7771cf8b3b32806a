/// @file master_watch.h
#ifndef AIBO_DRIVER_ROS_MASTER_WATCH_H
#define AIBO_DRIVER_ROS_MASTER_WATCH_H

#include <xmlrpcpp/XmlRpcValue.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace aibo_driver::node {

/// Tells a restarted ROS master about this process.
///
/// roscpp registers topics and services once. A roscore that was restarted since knows none of them: who listens
/// already goes on, but who comes later finds nobody. So every few seconds the master is asked whether it knows this
/// process; if it says no, topics, services and parameters are registered with it again. Robot and subscribers notice
/// nothing. A master that does not answer is left alone until it does.
class MasterWatch {
 public:
  /// Begins to watch, in a thread of its own, when all services of this process are advertised.
  /// @param parameters name of the node or nodelet, whose parameters a new master gets unless it has some already
  explicit MasterWatch(const std::string& parameters);

  /// Ends at once, whatever the master does.
  ~MasterWatch();

  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

 private:
  struct Server {
    std::string host;
    int port;
  };

  void run();
  void look();
  void remember(const Server& master);
  void introduceTo(const Server& master);
  void registerService(const Server& master, const std::string& name);
  std::optional<XmlRpc::XmlRpcValue> ask(const Server& server, const char* method,
                                         const std::vector<XmlRpc::XmlRpcValue>& arguments);
  bool isEnding();

  const std::string parameters_name_;
  const std::string sign_;  ///< a service that every node has: while the master knows it, it knows all the others, too
  XmlRpc::XmlRpcValue parameters_;     ///< as the master last had them
  std::vector<std::string> services_;  ///< what this process advertised when the watch began, except the sign

  std::mutex mutex_;
  std::condition_variable ending_changed_;
  bool ending_ = false;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_MASTER_WATCH_H
