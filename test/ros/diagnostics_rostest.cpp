// The tree that diagnostic_aggregator makes of the driver's diagnostics with config/diagnostics_aggregator.yaml. Its
// names have blanks instead of slashes.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <ros/ros.h>

#include <algorithm>
#include <string>

#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"

namespace {

using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;
using test_support::DriverProcess;
using test_support::SimulatedRobot;
using test_support::TopicListener;

bool hasGood(const DiagnosticArray& array, const std::string& name) {
  return std::any_of(array.status.begin(), array.status.end(), [&name](const DiagnosticStatus& status) {
    return status.name == name && status.level == DiagnosticStatus::OK;
  });
}

TEST(Diagnostics, AreOkInEachBranchOfTheTreeWhileTheRobotIsWell) {
  TopicListener<DiagnosticArray> tree("/diagnostics_agg");
  SimulatedRobot robot;
  DriverProcess driver("/tree", robot.port());
  for (const char* const name : {"Connection/tree aibo_driver: connection", "Camera/tree aibo_driver: stream",
                                 "Joints/tree aibo_driver: joints", "Power/tree aibo_driver: power"}) {
    EXPECT_TRUE(tree.waitFor([name](const DiagnosticArray& array) {
      return hasGood(array, std::string("/Aibo/") + name);
    })) << name;
  }
}

}  // namespace
