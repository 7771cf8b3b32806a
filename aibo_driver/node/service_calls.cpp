#include "node/service_calls.h"

#include <algorithm>

namespace aibo_driver::node {

void ServiceCalls::cancel() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
    for (Call& call : calls_) {
      call.client.shutdown();
    }
  }
  for (Call& call : calls_) {
    call.thread.join();
  }
  calls_.clear();
}

bool ServiceCalls::run(const std::string& name, const std::function<void(Call&)>& work) {
  const std::lock_guard<std::mutex> lock(mutex_);
  calls_.remove_if([](Call& call) {
    if (call.is_over) {
      call.thread.join();
    }
    return call.is_over;
  });
  const auto has_name = [&name](const Call& call) { return call.name == name; };
  if (is_ending_ || std::any_of(calls_.begin(), calls_.end(), has_name)) {
    return false;
  }
  Call& call = calls_.emplace_back();
  call.name = name;
  call.thread = std::thread([this, &call, work] {
    work(call);
    const std::lock_guard<std::mutex> ending(mutex_);
    call.is_over = true;
  });
  return true;
}

// From now on, cancel() can end the call.
bool ServiceCalls::shareClient(Call& call, const ros::ServiceClient& client) {
  const std::lock_guard<std::mutex> lock(mutex_);
  call.client = client;
  return !is_ending_;
}

bool ServiceCalls::isEnding() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_ending_;
}

}  // namespace aibo_driver::node
