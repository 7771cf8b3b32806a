/// @file web_node.h
#ifndef AIBO_DRIVER_WEB_WEB_NODE_H
#define AIBO_DRIVER_WEB_WEB_NODE_H

#include <ros/node_handle.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/property_tree/ptree_fwd.hpp>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "node/service_calls.h"
#include "node/stop_client.h"
#include "tools/teleop/key_steering.h"
#include "web/page_server.h"
#include "web/steering.h"

namespace aibo_driver::web {

/// Shows a driver's robot on pages in browsers, and passes on what people want there.
///
/// One thread serves the pages. It waits neither for the ROS master nor for the driver: messages come from roscpp's
/// thread, services are called on threads of their own, and one thread subscribes to pictures.
class WebNode : private PageListener {
 public:
  /// @param handle in the driver's namespace
  /// @param parameters has the parameters of docs/ros_interface.md
  /// @throw std::exception a parameter is wrong, or its port is in use; the message says so
  WebNode(const ros::NodeHandle& handle, const ros::NodeHandle& parameters);
  ~WebNode() override;

 private:
  using Order = boost::property_tree::ptree;

  template <typename Message>
  void show(const std::string& topic);
  void showSteerer();
  void showClock();
  void keepTime();
  void followPictures();

  void opened(Page page) override;
  void received(Page page, const std::string& text) override;
  void closed(Page page) override;

  void obey(Page page, const Order& order);
  void obeyInTime(Page page, const std::string& what, const Order& order);
  bool mayMove(Page page, bool walks);
  void steer(Page page, const Order& order);
  void look(Page page, const Order& order);
  void endSteering(bool has_to_stand);
  void stop(Page page);
  void takePicture(Page page);
  void listMotions(Page page);
  template <typename Service>
  void call(Page page, const std::string& what, const std::string& service, const typename Service::Request& request,
            const std::function<void(const typename Service::Response&)>& done = {});

  void publishVelocity(double forward, double left, double turn);
  void say(Page page, bool is_good, const std::string& words);

  ros::NodeHandle handle_;
  const teleop::Speeds speeds_;
  boost::asio::io_context context_{1};
  PageServer server_;
  boost::asio::steady_timer hold_;
  boost::asio::steady_timer second_;
  ros::Publisher velocity_;
  ros::Publisher joints_;
  node::StopClient stop_;

  // Members that only the thread that serves the pages uses.
  Steering steering_;
  node::ServiceCalls calls_;

  std::vector<ros::Subscriber> states_;
  std::atomic<bool> wants_pictures_{false};
  ros::Subscriber pictures_;  ///< only the next thread uses it
  boost::asio::thread_pool subscribing_{1};
  std::thread serving_;
};

}  // namespace aibo_driver::web

#endif  // AIBO_DRIVER_WEB_WEB_NODE_H
