/// @file robot_server.h
#ifndef TEST_FAULT_CAMPAIGN_ROBOT_SERVER_H
#define TEST_FAULT_CAMPAIGN_ROBOT_SERVER_H

#include <chrono>
#include <cstdint>
#include <memory>

#include "support/proxy/fault.h"

namespace fault_bench {

/// The robot's own server with a simulated ERS-7, on a thread of its own. Every function may be called from any thread.
class RobotServer {
 public:
  /// @param mark of its thread, for system calls that fail (syscalls.h)
  explicit RobotServer(int mark);
  ~RobotServer();

  RobotServer(const RobotServer&) = delete;
  RobotServer& operator=(const RobotServer&) = delete;

  /// On 127.0.0.1.
  int port() const;

  /// The OPEN-R frame (8 ms) that it is now.
  std::uint32_t frame() const;

  /// The longest time from one camera image to the next, since this was called last.
  std::chrono::milliseconds takeLongestImageGap();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_ROBOT_SERVER_H
