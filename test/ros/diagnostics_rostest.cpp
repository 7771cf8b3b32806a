// The tree that diagnostic_aggregator makes of the driver's diagnostics with config/diagnostics_aggregator.yaml. Its
// names have blanks instead of slashes.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "support/picture_server.h"
#include "support/proxy/fault_proxy.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/ros/topic_publishers.h"
#include "support/simulated_robot.h"

namespace {

using namespace std::chrono_literals;
using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;
using test_support::Action;
using test_support::Bytes;
using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::FaultProxy;
using test_support::PictureServer;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using test_support::TopicPublishers;
using ::testing::HasSubstr;

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

Bytes cut(Bytes jpeg) {
  jpeg.resize(jpeg.size() / 2);
  return jpeg;
}

/// Only a decoder sees that something is missing.
Bytes cutBeforeItsEnd(Bytes jpeg) {
  jpeg.erase(jpeg.begin() + static_cast<std::ptrdiff_t>(2 * jpeg.size() / 3), jpeg.end() - 2);
  return jpeg;
}

// The frame numbers of a PictureServer do not keep pace with the time.
const std::vector<std::string> kWithoutRobotTime = {"_use_robot_time:=false", "_read_timeout:=20"};

TEST(StreamDiagnostics, ReportDamageOnceAndAreOkAgainAfterwards) {
  PictureServer server(2, 20ms);
  DriverProcess driver("/damage", server.port(), kWithoutRobotTime);
  DiagnosticsListener diagnostics;
  const auto wait_for = [&diagnostics](int level, const std::string& text) {
    return diagnostics.waitFor("damage/aibo_driver: stream", [=](const auto& s) {
      return s.level == level && s.message.find(text) != std::string::npos;
    });
  };
  EXPECT_NE(wait_for(DiagnosticStatus::OK, "pictures/s").name, "");
  server.spoilNext(cut);
  EXPECT_NE(wait_for(DiagnosticStatus::WARN, "1 damaged pictures dropped").name, "");
  const DiagnosticStatus later = wait_for(DiagnosticStatus::OK, "pictures/s");
  EXPECT_EQ(DiagnosticsListener::value(later, "pictures damaged"), "1") << "it is still counted";
  TopicListener<sensor_msgs::Image> viewer("/damage/camera/image_raw");
  ASSERT_NE(viewer.waitForNext(), nullptr);
  server.spoilNext(cutBeforeItsEnd);
  EXPECT_NE(wait_for(DiagnosticStatus::WARN, "1 damaged pictures dropped").name, "");
  const DiagnosticStatus last = wait_for(DiagnosticStatus::OK, "pictures/s");
  EXPECT_EQ(DiagnosticsListener::value(last, "images not decodable"), "1") << "it is still counted";
}

TEST(StreamDiagnostics, WarnOfAStreamThatHasLessThanHalfOfTheRate) {
  PictureServer server(2, 200ms);
  DriverProcess driver("/slow_stream", server.port(), kWithoutRobotTime);
  DiagnosticsListener diagnostics;
  const auto slow = diagnostics.waitFor("slow_stream/aibo_driver: stream", [](const auto& status) {
    return status.level == DiagnosticStatus::WARN && status.message.find("only ") == 0;
  });
  EXPECT_THAT(slow.message, HasSubstr("of 30.0 pictures/s: is the radio link weak"));
  EXPECT_EQ(DiagnosticsListener::value(slow, "pictures per second asked for"), "30.0");
}

// The client knows the proxy's address, and the datagrams come from the robot's, as behind a NAT.
TEST(StreamDiagnostics, SayWhyPicturesComeByTcpAlthoughUdpIsWanted) {
  SimulatedRobot robot({"--bind", "127.0.0.3"});
  FaultProxy::Options way;
  way.target_host = "127.0.0.3";
  way.target_port = robot.port();
  FaultProxy proxy(way);
  DriverProcess driver("/no_udp", proxy.port(), {"_transport:=udp", "_read_timeout:=20"});
  DiagnosticsListener diagnostics;
  const auto fallen_back = diagnostics.waitFor("no_udp/aibo_driver: stream", [](const auto& status) {
    return status.message.find("pictures come by TCP, not by UDP: no datagram has come") != std::string::npos;
  });
  EXPECT_EQ(fallen_back.level, DiagnosticStatus::WARN);
  EXPECT_EQ(DiagnosticsListener::value(fallen_back, "transport"), "tcp");
  EXPECT_NE(DiagnosticsListener::value(fallen_back, "datagrams from strangers"), "0");
  TopicListener<sensor_msgs::CompressedImage> pictures("/no_udp/camera/image_raw/compressed");
  EXPECT_TRUE(pictures.waitForNext());
}

TEST(StreamDiagnostics, SayToWhatAdaptiveHasLoweredTheStream) {
  SimulatedRobot robot;
  FaultProxy proxy(robot.port());
  test_support::Conditions slow_link;
  slow_link.bytes_per_second = 60000;  // 12 pictures a second at quality 85
  proxy.setConditions(slow_link);
  DriverProcess driver("/adaptive", proxy.port(),
                       {"_adaptive:=true", "_telemetry_rate:=0", "_read_timeout:=20", test_support::kByTcp});
  DiagnosticsListener diagnostics;
  const auto lowered = diagnostics.waitFor("adaptive/aibo_driver: stream", [](const auto& status) {
    return DiagnosticsListener::value(status, "adaptive").find("lowered to quality 50 of 85") == 0;
  });
  EXPECT_EQ(DiagnosticsListener::value(lowered, "quality asked for"), "50");
}

TEST(JointDiagnostics, AreOkAgainWhenAJointThatWasJammedFollows) {
  SimulatedRobot robot;
  DriverProcess driver("/jam", robot.port(), {"_stream_on_start:=false", "_read_timeout:=20"});
  DiagnosticsListener diagnostics;
  TopicPublishers topics("/jam");
  const auto wait_for = [&](int level, const std::string& text) {
    return diagnostics.waitFor("jam/aibo_driver: joints", [&](const auto& s) {
      return s.level == level && s.message.find(text) != std::string::npos;
    });
  };
  const auto send_head_to = [&topics](double position) {
    std_msgs::Float64 command;
    command.data = position;
    topics.publish("head_pan_position_controller/command", command);
  };
  EXPECT_NE(wait_for(DiagnosticStatus::OK, "measurements/s").name, "");
  ASSERT_THAT(robot.type("jam head_pan"), HasSubstr("ok"));
  send_head_to(1);
  EXPECT_NE(wait_for(DiagnosticStatus::ERROR, "head_pan is jammed").name, "");
  ASSERT_THAT(robot.type("free head_pan"), HasSubstr("ok"));
  send_head_to(0.5);
  const DiagnosticStatus free = wait_for(DiagnosticStatus::OK, "measurements/s");
  EXPECT_EQ(DiagnosticsListener::value(free, "said by the robot"), "");
}

TEST(JointDiagnostics, WarnOfARobotThatIsStoppedOrLimp) {
  DiagnosticsListener diagnostics;
  const SimulatedRobot robot;
  const DriverProcess driver("/warned", robot.port());
  const auto wait_for = [&diagnostics](int level, const std::string& text) {
    return diagnostics
        .waitFor("warned/aibo_driver: joints",
                 [=](const DiagnosticStatus& each) {
                   return each.level == level && each.message.find(text) != std::string::npos;
                 })
        .message;
  };
  wait_for(DiagnosticStatus::OK, "measurements/s");
  std_srvs::Trigger stop;
  ASSERT_TRUE(ros::service::call("/warned/stop", stop));
  EXPECT_THAT(wait_for(DiagnosticStatus::WARN, "stopped by"), HasSubstr(ros::this_node::getName()));
  std_srvs::Trigger release;
  ASSERT_TRUE(ros::service::call("/warned/release", release));
  std_srvs::SetBool off;
  ASSERT_TRUE(ros::service::call("/warned/motors", off));
  EXPECT_NE(wait_for(DiagnosticStatus::WARN, "motors are off"), "");
}

TEST(PowerDiagnostics, ForgetTheChargeOfARobotWhenAnotherOneThatReportsNoneTakesItsPlace) {
  SimulatedRobot robot;
  PictureServer without_sensors(2, 20ms);
  FaultProxy proxy(robot.port());
  DriverProcess driver("/charge", proxy.port());
  DiagnosticsListener diagnostics;
  const auto wait_for = [&diagnostics](const std::string& text) {
    return diagnostics.waitFor("charge/aibo_driver: power",
                               [&text](const auto& s) { return s.message.find(text) != std::string::npos; });
  };
  EXPECT_EQ(wait_for("battery at").level, DiagnosticStatus::OK);
  proxy.setTarget("127.0.0.1", without_sensors.port());
  proxy.endConnections(Action::kClose);
  const DiagnosticStatus after = wait_for("does not report its battery");
  EXPECT_EQ(after.level, DiagnosticStatus::WARN);
  EXPECT_EQ(DiagnosticsListener::value(after, "charge, %"), "");
}

}  // namespace
