// The tree that diagnostic_aggregator makes of the driver's diagnostics with config/diagnostics_aggregator.yaml. Its
// names have blanks instead of slashes.

#include <aibo_driver/Sound.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "ros/diagnostics_listener.h"
#include "support/memory_stick.h"
#include "support/picture_server.h"
#include "support/proxy/fault_proxy.h"
#include "support/ros/driver_process.h"
#include "support/ros/topics.h"
#include "support/scripted_server.h"
#include "support/simulated_robot.h"
#include "support/test_pictures.h"
#include "support/version2_frames.h"

namespace {

using namespace std::chrono_literals;
using diagnostic_msgs::DiagnosticStatus;
using test_support::Bytes;
using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::kStreams;
using test_support::SimulatedRobot;
using test_support::TopicListener;

double numberIn(const DiagnosticStatus& status, const std::string& key) {
  const std::string value = DiagnosticsListener::value(status, key);
  return value.empty() ? -1 : std::stod(value);
}

/// The statuses of the driver in a namespace.
class Watch {
 public:
  explicit Watch(const std::string& driver) : node_(driver + "/aibo_driver: ") {}

  /// Waits for a status of this level and with this text.
  /// @param meanwhile called for each status that comes
  DiagnosticStatus waitFor(
      const std::string& what, int level, const std::string& text = "",
      const std::function<void()>& meanwhile = [] {}) {
    std::string last = "nothing";
    const DiagnosticStatus status = listener_.waitFor(node_ + what, [&](const DiagnosticStatus& each) {
      last = each.message;
      meanwhile();
      return each.level == level && each.message.find(text) != std::string::npos;
    });
    EXPECT_NE(status.name, "") << what << " never says: " << text << "; at last it says: " << last;
    return status;
  }

 private:
  const std::string node_;
  DiagnosticsListener listener_;
};

TEST(Diagnostics, AreOkInEachBranchOfTheTreeWhileTheRobotIsWell) {
  TopicListener<diagnostic_msgs::DiagnosticArray> tree("/diagnostics_agg");
  const test_support::MemoryStick stick("ALLOW_MICROPHONE=yes\n");
  SimulatedRobot robot({"--memory-stick", stick.path().string()});
  DriverProcess driver("/tree", robot.port(), {kStreams, "_jpeg_quality:=40", "_frame_rate:=15", "_read_timeout:=20"});
  for (const char* const name :
       {"Connection/tree aibo_driver: connection", "Camera/tree aibo_driver: stream", "Joints/tree aibo_driver: joints",
        "Power/tree aibo_driver: power", "Sound/tree aibo_driver: sound"}) {
    EXPECT_TRUE(tree.waitFor([name](const diagnostic_msgs::DiagnosticArray& array) {
      return std::any_of(array.status.begin(), array.status.end(), [name](const DiagnosticStatus& status) {
        return status.name == std::string("/Aibo/") + name && status.level == DiagnosticStatus::OK;
      });
    })) << name;
  }
  Watch watch("tree");
  EXPECT_EQ(watch.waitFor("connection", DiagnosticStatus::OK).hardware_id, "127.0.0.1:" + std::to_string(robot.port()));
  const DiagnosticStatus stream = watch.waitFor("stream", DiagnosticStatus::OK, "pictures/s, ");
  EXPECT_EQ(stream.message, DiagnosticsListener::value(stream, "pictures per second") + " pictures/s, " +
                                DiagnosticsListener::value(stream, "KB per second") + " KB/s");
  EXPECT_EQ(numberIn(stream, "quality asked for"), 40);
  EXPECT_EQ(numberIn(stream, "pictures per second asked for"), 15);
  const TopicListener<aibo_driver::Sound> listener("/tree/microphone");
  watch.waitFor("sound", DiagnosticStatus::OK, "listening");
}

TEST(Diagnostics, DuringTheFirstAttemptToConnectNothingHasGoneWrong) {
  Watch watch("attempt");
  const test_support::ScriptedServer silent;
  const DriverProcess driver("/attempt", silent.port(), {"_connect_timeout:=60"});
  watch.waitFor("connection", DiagnosticStatus::WARN, "connecting to");
}

TEST(Diagnostics, WithoutARobotSayWhatIsMissingAndWhatIsIdle) {
  Watch watch("alone");
  const DriverProcess driver("/alone", 1, {kStreams});
  watch.waitFor("stream", DiagnosticStatus::WARN, "no pictures: the robot is not connected");
  watch.waitFor("joints", DiagnosticStatus::WARN, "no joint positions: the robot is not connected");
  watch.waitFor("power", DiagnosticStatus::OK, "idle: the robot is not connected");
  watch.waitFor("sound", DiagnosticStatus::OK, "idle: microphone has no subscriber");
  const TopicListener<aibo_driver::Sound> listener("/alone/microphone");
  watch.waitFor("sound", DiagnosticStatus::WARN, "nothing is heard");
  std_srvs::SetBool off;
  ASSERT_TRUE(ros::service::call("/alone/set_streaming", off));
  watch.waitFor("stream", DiagnosticStatus::OK, "idle: the stream is off");
  const auto refused = watch.waitFor("connection", DiagnosticStatus::ERROR, "not connected");
  EXPECT_GT(numberIn(refused, "attempts failed"), 0);
  EXPECT_NE(DiagnosticsListener::value(refused, "reason"), "");
  EXPECT_NE(DiagnosticsListener::value(refused, "what to check"), "");
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
const std::vector<std::string> kWithoutRobotTime = {kStreams, "_use_robot_time:=false", "_read_timeout:=20"};

TEST(StreamDiagnostics, ReportDamageOnceAndAreOkAgainAfterwards) {
  test_support::PictureServer server(2, 20ms);
  DriverProcess driver("/damage", server.port(), kWithoutRobotTime);
  Watch watch("damage");
  TopicListener<sensor_msgs::Image> viewer("/damage/camera/image_raw");
  watch.waitFor("joints", DiagnosticStatus::WARN, "the robot sends no joint positions");
  watch.waitFor("stream", DiagnosticStatus::OK, "pictures/s");
  for (const auto& [spoil, count] : {std::pair(&cut, "pictures damaged"), {&cutBeforeItsEnd, "images not decodable"}}) {
    const Bytes damaged = version2_frames::makePicture(spoil(test_pictures::makeNumbered(1)), 1);
    server.flood([next = version2_frames::makeFrame('f', 0, damaged)]() mutable { return std::exchange(next, {}); });
    watch.waitFor("stream", DiagnosticStatus::WARN, "1 damaged pictures dropped");
    const DiagnosticStatus later = watch.waitFor("stream", DiagnosticStatus::OK, "pictures/s");
    EXPECT_EQ(DiagnosticsListener::value(later, count), "1") << "it is still counted";
  }
}

TEST(StreamDiagnostics, WarnOfAStreamThatIsSlowOrStandsStill) {
  const std::pair<std::chrono::milliseconds, const char*> rows[] = {
      // between two pictures, and what is said
      {1h, "no pictures although the stream is on"},
      {200ms, "of 30.0 pictures/s: is the radio link weak"},
  };
  for (const auto& [interval, warning] : rows) {
    test_support::PictureServer server(2, interval);
    DriverProcess driver("/slow_stream", server.port(), kWithoutRobotTime);
    Watch("slow_stream").waitFor("stream", DiagnosticStatus::WARN, warning);
  }
}

TEST(StreamDiagnostics, WarnOfDataThatComesLate) {
  SimulatedRobot robot;
  test_support::FaultProxy proxy(robot.port());
  DriverProcess driver("/late", proxy.port(),
                       {kStreams, "_frame_rate:=2", "_read_timeout:=20", "_telemetry_rate:=0", test_support::kByTcp});
  Watch watch("late");
  watch.waitFor("joints", DiagnosticStatus::OK, "idle: telemetry_rate is 0");
  watch.waitFor("power", DiagnosticStatus::OK, "idle");
  watch.waitFor("stream", DiagnosticStatus::OK, "pictures/s");
  test_support::Conditions detour;
  detour.delay = 400ms;
  proxy.setConditions(detour);
  const auto late = watch.waitFor("stream", DiagnosticStatus::WARN, "ms late on average");
  EXPECT_GT(numberIn(late, "delay beyond the shortest, longest ms"), 250);
}

TEST(JointDiagnostics, AreAnErrorUntilAJointThatWasJammedFollowsAgain) {
  SimulatedRobot robot;
  DriverProcess driver("/jam", robot.port(), {"_stream_on_start:=false", "_read_timeout:=20"});
  Watch watch("jam");
  test_support::TopicPublishers topics("/jam");
  watch.waitFor("joints", DiagnosticStatus::OK, "measurements/s");
  // Again and again, because a driver that stalls drops commands.
  const auto moves_until = [&](double position, int level, const std::string& text) {
    std_msgs::Float64 command;
    command.data = position;
    watch.waitFor("joints", level, text, [&] { topics.publish("head_pan_position_controller/command", command); });
  };
  ASSERT_THAT(robot.type("jam head_pan"), testing::HasSubstr("ok"));
  moves_until(1, DiagnosticStatus::ERROR, "head_pan is jammed");
  ASSERT_THAT(robot.type("free head_pan"), testing::HasSubstr("ok"));
  moves_until(0.5, DiagnosticStatus::OK, "measurements/s");
}

TEST(JointDiagnostics, AreAnErrorForARobotOfAnotherKind) {
  const SimulatedRobot robot;
  DriverProcess driver("/wrong", robot.port(), {"_robot:=ERS-210"});
  Watch("wrong").waitFor("joints", DiagnosticStatus::ERROR, "the robot says that it is an ERS-7");
  EXPECT_NO_THROW(driver.waitForOutput("There is no model .URDF. of the ERS-210"));
  EXPECT_NO_THROW(driver.waitForOutput("The robot says that it is an ERS-7, .*: commands are refused"));
}

TEST(JointDiagnostics, WarnOfARobotThatIsStoppedOrLimp) {
  Watch watch("warned");
  const SimulatedRobot robot;
  const DriverProcess driver("/warned", robot.port());
  watch.waitFor("joints", DiagnosticStatus::OK, "measurements/s");
  watch.waitFor("stream", DiagnosticStatus::OK, "idle: no camera topic has a subscriber");
  const auto call = [](const char* service) {
    std_srvs::Trigger trigger;
    EXPECT_TRUE(ros::service::call(std::string("/warned/") + service, trigger));
  };
  call("stop");
  watch.waitFor("joints", DiagnosticStatus::WARN, "stopped by " + ros::this_node::getName());
  call("release");
  std_srvs::SetBool off;
  EXPECT_TRUE(ros::service::call("/warned/motors", off));
  watch.waitFor("joints", DiagnosticStatus::WARN, "motors are off");
}

}  // namespace
