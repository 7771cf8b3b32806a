/// @file soak.h
#ifndef TEST_SOAK_SOAK_H
#define TEST_SOAK_SOAK_H

#include <aibo_driver/MotionState.h>
#include <ros/node_handle.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <vector>

#include "host_files/file_descriptor.h"
#include "order_audit.h"
#include "order_events.h"
#include "resource_log.h"
#include "support/proxy/fault_proxy.h"
#include "support/ros/driver_process.h"
#include "support/simulated_robot.h"
#include "wire_audit.h"

namespace soak {

struct Options {
  double minutes = 60;
  unsigned seed = 1;
  std::string folder;   ///< existing folder for logs
  std::string program;  ///< this one, which is started again as each of the users
};

/// Driver, simulated robot, a proxy between them, and five nodes that give random orders of all kinds, while links are
/// cut, processes stall and the memory stick is slow. In rounds: some seconds of orders, then silence until all
/// has ended. Then the round is judged. Needs a running ROS master and a spinner.
class Soak {
 public:
  explicit Soak(const Options& options);

  /// @return true if there was no violation
  bool run();

 private:
  test_support::FaultProxy::Options proxyOptions();
  void receive(const std_msgs::String& line);
  void receive(const sensor_msgs::JointState& joints);
  void receive(const aibo_driver::MotionState& state);

  void begin();
  void getReady();
  void goThroughARound();
  void goWrong();
  void tellUsers(unsigned round);
  void waitForUsers(unsigned round);
  Round takeRound();
  void end();
  void complain(const std::string& violation);
  void print(const std::string& violation);
  template <typename Service>
  void expectSuccess(const std::string& name, Service service = Service());
  template <typename Condition>
  bool waitFor(double seconds, const Condition& condition);
  void pass(int milliseconds);
  int uniform(int lowest, int highest) { return std::uniform_int_distribution<int>(lowest, highest)(random_); }

  const Options options_;
  std::mt19937 random_;
  OrderAudit audit_;
  ResourceLog driver_resources_;
  ResourceLog robot_resources_;
  const double begin_;

  std::mutex mutex_;  // guards what follows, down to the test's processes
  std::size_t violations_ = 0;
  std::string scene_ = "start";
  Round round_;
  std::uint64_t pictures_ = 0;  ///< that the driver has published
  WireAudit wire_;
  std::vector<aibo_driver::EndedMovement> ended_;  ///< as the newest motion_state has them
  std::vector<Moving> moving_;                     ///< the same
  std::map<unsigned, int> quiet_users_;            ///< how many, by round
  bool is_connected_ = false;

  test_support::SimulatedRobot robot_;
  test_support::FaultProxy proxy_;
  test_support::DriverProcess driver_;
  std::vector<std::unique_ptr<test_support::Process>> users_;

  ros::NodeHandle handle_;
  unsigned number_ = 1;  ///< of the round; users give orders in even ones
  double next_sample_ = 0;
  ros::Publisher rounds_;
  std::vector<ros::Subscriber> subscribers_;  // last: their callbacks use all of the above
};

}  // namespace soak

#endif  // TEST_SOAK_SOAK_H
