// The tree that diagnostic_aggregator makes of the driver's diagnostics with config/diagnostics_aggregator.yaml. Its
// names have blanks instead of slashes.

#include <aibo_driver/Sound.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "support/picture_server.h"
#include "support/proxy/fault_proxy.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_publishers.h"
#include "support/scripted_server.h"
#include "support/simulated_robot.h"
#include "support/version2_frames.h"

namespace {

using namespace std::chrono_literals;
using diagnostic_msgs::DiagnosticStatus;
using test_support::Bytes;
using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::FaultProxy;
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
  DiagnosticStatus waitFor(const std::string& what, int level, const std::string& text = "") {
    const DiagnosticStatus status = listener_.waitFor(node_ + what, [&](const DiagnosticStatus& each) {
      return each.level == level && each.message.find(text) != std::string::npos;
    });
    EXPECT_NE(status.name, "") << what << " never says: " << text;
    return status;
  }

  /// Waits for a status in which this is so.
  bool waitUntil(const std::string& what, const std::function<bool(const DiagnosticStatus&)>& is_so) {
    return !listener_.waitFor(node_ + what, is_so).name.empty();
  }

 private:
  const std::string node_;
  DiagnosticsListener listener_;
};

TEST(Diagnostics, AreOkInEachBranchOfTheTreeWhileTheRobotIsWell) {
  TopicListener<diagnostic_msgs::DiagnosticArray> tree("/diagnostics_agg");
  SimulatedRobot robot;
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
  const DiagnosticStatus connection = watch.waitFor("connection", DiagnosticStatus::OK);
  EXPECT_EQ(connection.hardware_id, "127.0.0.1:" + std::to_string(robot.port()));
  EXPECT_EQ(numberIn(connection, "protocol version"), 2);
  for (const auto& [count, value] : {std::pair("connections made", 1),
                                     {"attempts failed", 0},
                                     {"streams given up for silence", 0},
                                     {"protocol errors", 0}}) {
    EXPECT_EQ(numberIn(connection, count), value) << count;
  }
  EXPECT_GT(numberIn(connection, "bytes received"), 0);
  const DiagnosticStatus stream = watch.waitFor("stream", DiagnosticStatus::OK, "pictures/s, ");
  EXPECT_EQ(stream.message, DiagnosticsListener::value(stream, "pictures per second") + " pictures/s, " +
                                DiagnosticsListener::value(stream, "KB per second") + " KB/s");
  EXPECT_EQ(numberIn(stream, "quality asked for"), 40);
  EXPECT_EQ(DiagnosticsListener::value(stream, "adaptive"), "off");
  EXPECT_EQ(numberIn(stream, "pictures per second asked for"), 15);
  EXPECT_GT(numberIn(stream, "pictures received"), 0);
  for (const char* const count :
       {"pictures damaged", "pictures nobody asked for", "images decoded", "images not decodable"}) {
    EXPECT_EQ(numberIn(stream, count), 0) << count;
  }
  const DiagnosticStatus joints = watch.waitFor("joints", DiagnosticStatus::OK, " measurements/s");
  EXPECT_EQ(DiagnosticsListener::value(joints, "robot"), "ERS-7");
  EXPECT_GT(numberIn(joints, "measurements received"), 0);
  for (const char* const count :
       {"measurements dropped, more than asked for", "impossible values dropped", "requests refused by the robot"}) {
    EXPECT_EQ(numberIn(joints, count), 0) << count;
  }
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
  const auto refused = watch.waitFor("connection", DiagnosticStatus::ERROR, "not connected");
  EXPECT_GT(numberIn(refused, "attempts failed"), 0);
  EXPECT_NE(DiagnosticsListener::value(refused, "reason"), "");
  EXPECT_NE(DiagnosticsListener::value(refused, "what to check"), "");
}

TEST(Diagnostics, TheFirstAttemptIsOnlyAWarning) {
  const test_support::ScriptedServer silent;
  Watch watch("first");
  DriverProcess driver("/first", silent.port(), {"_connect_timeout:=60", "_read_timeout:=60"});
  watch.waitFor("connection", DiagnosticStatus::WARN, "connecting to 127.0.0.1:" + std::to_string(silent.port()));
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
  watch.waitFor("stream", DiagnosticStatus::OK, "pictures/s");
  for (const auto& [spoil, count] : {std::pair(&cut, "pictures damaged"), {&cutBeforeItsEnd, "images not decodable"}}) {
    server.spoilNext(spoil);
    watch.waitFor("stream", DiagnosticStatus::WARN, "1 damaged pictures dropped");
    const DiagnosticStatus later = watch.waitFor("stream", DiagnosticStatus::OK, "pictures/s");
    EXPECT_EQ(DiagnosticsListener::value(later, count), "1") << "it is still counted";
  }
}

TEST(StreamDiagnostics, AreOkWhileNobodyWantsPictures) {
  Watch watch("idle");
  const DriverProcess driver("/idle", 1);
  watch.waitFor("stream", DiagnosticStatus::OK, "idle: no camera topic has a subscriber");
  std_srvs::SetBool off;
  ASSERT_TRUE(ros::service::call("/idle/set_streaming", off));
  watch.waitFor("stream", DiagnosticStatus::OK, "idle: the stream is off");
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
  FaultProxy proxy(robot.port());
  DriverProcess driver("/late", proxy.port(),
                       {kStreams, "_read_timeout:=20", "_telemetry_rate:=0", test_support::kByTcp});
  Watch watch("late");
  watch.waitFor("joints", DiagnosticStatus::OK, "idle: telemetry_rate is 0");
  watch.waitFor("stream", DiagnosticStatus::OK, "pictures/s");
  test_support::Conditions detour;
  detour.delay = 600ms;
  proxy.setConditions(detour);
  const auto late = watch.waitFor("stream", DiagnosticStatus::WARN, "ms late on average");
  EXPECT_GT(numberIn(late, "delay beyond the shortest, longest ms"), 400);
}

// The client knows the proxy's address, and the datagrams come from the robot's, as behind a NAT.
TEST(StreamDiagnostics, SayWhyPicturesComeByTcpAlthoughUdpIsWanted) {
  SimulatedRobot robot({"--bind", "127.0.0.3"});
  FaultProxy::Options way;
  way.target_host = "127.0.0.3";
  way.target_port = robot.port();
  FaultProxy proxy(way);
  DriverProcess driver("/no_udp", proxy.port(), {kStreams, "_transport:=udp", "_read_timeout:=20"});
  const auto fallen_back = Watch("no_udp").waitFor("stream", DiagnosticStatus::WARN,
                                                   "pictures come by TCP, not by UDP: no datagram has come");
  EXPECT_EQ(DiagnosticsListener::value(fallen_back, "transport"), "tcp");
  EXPECT_NE(DiagnosticsListener::value(fallen_back, "datagrams from strangers"), "0");
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
    return watch.waitUntil("joints", [&](const DiagnosticStatus& status) {
      topics.publish("head_pan_position_controller/command", command);
      return status.level == level && status.message.find(text) != std::string::npos;
    });
  };
  ASSERT_THAT(robot.type("jam head_pan"), testing::HasSubstr("ok"));
  EXPECT_TRUE(moves_until(1, DiagnosticStatus::ERROR, "head_pan is jammed"));
  ASSERT_THAT(robot.type("free head_pan"), testing::HasSubstr("ok"));
  EXPECT_TRUE(moves_until(0.5, DiagnosticStatus::OK, "measurements/s"));
}

TEST(JointDiagnostics, WarnOfMeasurementsThatWereDropped) {
  test_support::PictureServer server(2, 20ms);
  const DriverProcess driver("/drops", server.port(),
                             {"_telemetry_rate:=1", "_stream_on_start:=false", "_read_timeout:=20"});
  Watch watch("drops");
  server.setTelemetry(true);  // 31 times a second
  const auto too_many = watch.waitFor("joints", DiagnosticStatus::WARN, " measurements dropped: the robot sends more");
  EXPECT_GT(numberIn(too_many, "measurements dropped, more than asked for"), 0);
  server.flood([frame = 0U]() mutable {
    constexpr int kImpossible = 2'147'000'000;  // microradian
    return version2_frames::makeFrame('t', 0, version2_frames::makeTelemetry(frame += 4, {{'J', 1, kImpossible}}));
  });
  const auto impossible = watch.waitFor("joints", DiagnosticStatus::WARN, " impossible values dropped");
  EXPECT_GT(numberIn(impossible, "impossible values dropped"), 0);
}

TEST(JointDiagnostics, WarnOfARobotThatIsStoppedOrLimp) {
  Watch watch("warned");
  const SimulatedRobot robot;
  const DriverProcess driver("/warned", robot.port());
  watch.waitFor("joints", DiagnosticStatus::OK, "measurements/s");
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
