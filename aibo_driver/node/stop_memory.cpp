#include "node/stop_memory.h"

#include <ros/param.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <chrono>
#include <utility>

#include "node/xmlrpc_peer.h"
#include "text/plain_text.h"

namespace aibo_driver::node {
namespace {

using Lock = std::unique_lock<std::mutex>;

constexpr std::chrono::seconds kWriteAgain{2};

// Checks what it reads, because anybody can write parameters.
std::optional<std::string> readStoppedBy(const std::string& parameter) {
  XmlRpc::XmlRpcValue value;
  if (!ros::param::get(parameter, value)) {
    return std::nullopt;
  }
  return value.getType() == XmlRpc::XmlRpcValue::TypeString ? text::plainLine(value) : "somebody";
}

}  // namespace

StopMemory::StopMemory(const ros::NodeHandle& handle)
    : parameter_(handle.resolveName("stopped_by")), left_(readStoppedBy(parameter_)), thread_(&StopMemory::run, this) {}

StopMemory::~StopMemory() {
  {
    const Lock lock(mutex_);
    is_ending_ = true;
  }
  end_.set_value();
  changed_.notify_all();
  thread_.join();
}

void StopMemory::remember(const std::optional<std::string>& stopped_by) {
  const Lock lock(mutex_);
  if (stopped_by != std::exchange(stopped_by_, stopped_by)) {
    has_changed_ = true;
    changed_.notify_all();
  }
}

void StopMemory::run() {
  std::optional<std::string> written = left_;
  Lock lock(mutex_);
  while (true) {
    changed_.wait_for(lock, kWriteAgain, [this] { return is_ending_ || has_changed_; });
    if (is_ending_) {
      return;
    }
    has_changed_ = false;
    const std::optional<std::string> stopped_by = stopped_by_;
    if (stopped_by || written) {
      lock.unlock();
      if (write(stopped_by)) {
        written = stopped_by;
      }
      lock.lock();
    }
  }
}

/// @return false if the ROS master does not answer
bool StopMemory::write(const std::optional<std::string>& stopped_by) const {
  try {
    const XmlRpcPeer master = XmlRpcPeer::master(ended_);
    if (stopped_by) {
      master.call("setParam", {parameter_, *stopped_by});
    } else {
      master.call("deleteParam", {parameter_});
    }
    return true;
  } catch (const NoAnswer&) {
    return false;
  }
}

}  // namespace aibo_driver::node
