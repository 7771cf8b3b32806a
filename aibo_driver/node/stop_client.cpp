#include "node/stop_client.h"

#include <geometry_msgs/Twist.h>
#include <ros/connection.h>
#include <ros/param.h>
#include <ros/serialization.h>
#include <ros/service_manager.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <chrono>

#include "node/xmlrpc_peer.h"

namespace aibo_driver::node {
namespace {

using Lock = std::unique_lock<std::mutex>;

// How often the thread checks the connection.
constexpr std::chrono::seconds kLookAfter{1};

template <typename Message>
ros::Publisher advertise(ros::NodeHandle handle, const std::string& topic) {
  return handle.advertise<Message>(topic, 1);
}

bool read(const ros::SerializedMessage& answer, StopClient::Response* response) {
  try {
    ros::serialization::deserializeMessage(answer, *response);
    return true;
  } catch (const ros::Exception&) {
    return false;  // the peer was no driver
  }
}

}  // namespace

StopClient::StopClient(const ros::NodeHandle& handle)
    : service_(handle.resolveName("stop")),
      velocity_(advertise<geometry_msgs::Twist>(handle, "cmd_vel")),
      trajectory_(advertise<trajectory_msgs::JointTrajectory>(handle, "joint_trajectory")),
      keeper_(&StopClient::keepConnection, this) {
  // roscpp asks the master for this parameter before it logs its first line, and all other lines wait for the answer.
  // The line about a stop must not wait, so the parameter is read now.
  bool ignored = false;
  ros::param::getCached("/rosout_disable_topics_generation", ignored);
}

StopClient::~StopClient() {
  {
    const Lock lock(mutex_);
    is_ending_ = true;
    for (Call& call : calls_) {
      if (call.connection) {
        call.connection->getConnection()->drop(ros::Connection::Destructing);
      }
    }
  }
  end_.set_value();
  changed_.notify_all();
  keeper_.join();
  calls_.clear();  // waits until the calls have ended
}

bool StopClient::isOpen(const Connection& connection) {
  return connection && !connection->getConnection()->isDropped();
}

/// @return a connection, which ends with the last pointer to it; null if nobody serves the service
StopClient::Connection StopClient::connect(const std::string& service) {
  constexpr bool kPersistent = true;
  const ros::ServiceManagerPtr& manager = ros::ServiceManager::instance();
  const std::string type = ros::service_traits::md5sum<std_srvs::Trigger>();
  const ros::ServiceServerLinkPtr link = manager->createServiceServerLink(service, kPersistent, type, type, {});
  if (!link) {
    return nullptr;
  }
  return {link.get(), [link, manager](const ros::ServiceServerLink*) {
            link->getConnection()->drop(ros::Connection::Destructing);
            manager->removeServiceServerLink(link);
          }};
}

void StopClient::keepConnection() {
  Lock lock(mutex_);
  while (!is_ending_) {
    is_wanted_ = false;
    if (!isOpen(connection_)) {
      lock.unlock();
      const Connection made = isAdvertised(service_, ended_) ? connect(service_) : nullptr;
      lock.lock();
      connection_ = made;
      ++attempts_;
      changed_.notify_all();
    }
    changed_.wait_for(lock, kLookAfter, [this] { return is_ending_ || is_wanted_; });
  }
}

void StopClient::stop(const std::function<void(const Response*)>& done) {
  {
    const Lock lock(mutex_);
    calls_.remove_if(
        [](const Call& call) { return call.end.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
    Call& call = calls_.emplace_back();
    call.done = done;
    call.end = std::async(std::launch::async, [this, &call] { run(&call); });
  }
  velocity_.publish(geometry_msgs::Twist());
  trajectory_.publish(trajectory_msgs::JointTrajectory());
}

void StopClient::run(Call* call) {
  Response response;
  bool answered = false;
  // The first connection may be to a driver that has been restarted since, so there is a second attempt.
  for (int attempt = 0; attempt < 2 && !answered && waitForConnection(call); ++attempt) {
    ros::SerializedMessage answer;
    answered = call->connection->call(ros::serialization::serializeMessage(std_srvs::Trigger::Request()), answer) &&
               read(answer, &response);
  }
  {
    const Lock lock(mutex_);
    if (is_ending_) {
      return;
    }
  }
  call->done(answered ? &response : nullptr);
}

/// @return false if an attempt to connect has failed that began after this call, or if calls have to end
bool StopClient::waitForConnection(Call* call) {
  Lock lock(mutex_);
  const std::uint64_t enough = attempts_ + 2;  // the attempt that is running may have begun before this call
  while (!is_ending_ && !isOpen(connection_) && attempts_ < enough) {
    is_wanted_ = true;
    changed_.notify_all();
    changed_.wait(lock);
  }
  call->connection = connection_;
  return !is_ending_ && isOpen(connection_);
}

}  // namespace aibo_driver::node
