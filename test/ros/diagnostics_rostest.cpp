// The tree that diagnostic_aggregator makes of the driver's diagnostics with config/diagnostics_aggregator.yaml. Its
// names have blanks instead of slashes.

#include <aibo_driver/Sound.h>
#include <aibo_driver/TakePicture.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
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
#include "support/scripted_server.h"
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

double numberIn(const DiagnosticStatus& status, const std::string& key) {
  const std::string value = DiagnosticsListener::value(status, key);
  return value.empty() ? -1 : std::stod(value);
}

TEST(Diagnostics, AreOkInEachBranchOfTheTreeWhileTheRobotIsWell) {
  TopicListener<DiagnosticArray> tree("/diagnostics_agg");
  SimulatedRobot robot;
  TopicListener<sensor_msgs::CompressedImage> pictures("/tree/camera/image_raw/compressed");
  DriverProcess driver("/tree", robot.port(), {"_jpeg_quality:=40", "_frame_rate:=15", "_telemetry_rate:=15.625"});
  for (const char* const name : {"Connection/tree aibo_driver: connection", "Camera/tree aibo_driver: stream",
                                 "Joints/tree aibo_driver: joints", "Power/tree aibo_driver: power"}) {
    EXPECT_TRUE(tree.waitFor([name](const DiagnosticArray& array) {
      return hasGood(array, std::string("/Aibo/") + name);
    })) << name;
  }
  DiagnosticsListener diagnostics;
  const DiagnosticStatus connection = diagnostics.waitForNext("tree/aibo_driver: connection");
  EXPECT_EQ(connection.hardware_id, "127.0.0.1:" + std::to_string(robot.port()));
  EXPECT_EQ(DiagnosticsListener::value(connection, "host"), "127.0.0.1");
  EXPECT_EQ(numberIn(connection, "port"), robot.port());
  EXPECT_EQ(numberIn(connection, "protocol version"), 2);
  EXPECT_EQ(numberIn(connection, "connections made"), 1);
  EXPECT_EQ(numberIn(connection, "attempts failed"), 0);
  EXPECT_GT(numberIn(connection, "bytes received"), 1000);
  // In a second in which this computer was not held up.
  const auto wait_for_good = [&diagnostics](const std::string& name, const std::string& rate, double low, double high) {
    return diagnostics.waitFor("tree/aibo_driver: " + name, [=](const DiagnosticStatus& status) {
      return status.level == DiagnosticStatus::OK && numberIn(status, rate) > low && numberIn(status, rate) < high;
    });
  };
  const DiagnosticStatus stream = wait_for_good("stream", "pictures per second", 10, 20);
  EXPECT_EQ(DiagnosticsListener::value(stream, "adaptive"), "off");
  EXPECT_EQ(numberIn(stream, "quality asked for"), 40);
  EXPECT_EQ(numberIn(stream, "pictures per second asked for"), 15);
  EXPECT_EQ(numberIn(stream, "timelines begun"), 1);
  EXPECT_GT(numberIn(stream, "pictures received"), 0);
  const std::string pictures_per_second = DiagnosticsListener::value(stream, "pictures per second");
  const std::string kilobytes = DiagnosticsListener::value(stream, "KB per second");
  EXPECT_EQ(stream.message, pictures_per_second + " pictures/s, " + kilobytes + " KB/s");
  const double of_picture = static_cast<double>(pictures.waitForNext()->data.size()) / 1000;
  EXPECT_NEAR(std::stod(kilobytes) / std::stod(pictures_per_second), of_picture, 0.3 * of_picture);
  for (const std::string what : {"first byte to published, ", "delay beyond the shortest, "}) {
    const auto differs = [&what](const DiagnosticStatus& status) {
      return numberIn(status, what + "mean ms") < numberIn(status, what + "longest ms");
    };
    EXPECT_NE(diagnostics.waitFor(stream.name, differs).name, "") << what;
  }
  const DiagnosticStatus joints = wait_for_good("joints", "measurements per second", 10, 25);
  EXPECT_EQ(joints.message, DiagnosticsListener::value(joints, "measurements per second") + " measurements/s");
  EXPECT_GT(numberIn(joints, "measurements received"), 0);
  EXPECT_EQ(numberIn(joints, "impossible values dropped"), 0);
  EXPECT_EQ(numberIn(joints, "requests refused by the robot"), 0);
  EXPECT_EQ(DiagnosticsListener::value(joints, "robot"), "ERS-7");
  EXPECT_NE(DiagnosticsListener::value(joints, "server"), "");
  const DiagnosticStatus sound = diagnostics.waitForNext("tree/aibo_driver: sound");
  EXPECT_EQ(DiagnosticsListener::value(sound, "listening"), "no");
  EXPECT_EQ(DiagnosticsListener::value(sound, "playing"), "no");
}

// Waits for a status of a driver with this level and text.
DiagnosticStatus waitForStatus(DiagnosticsListener& diagnostics, const std::string& name, int level,
                               const std::string& text) {
  const DiagnosticStatus status = diagnostics.waitFor(name, [&](const DiagnosticStatus& each) {
    return each.level == level && each.message.find(text) != std::string::npos;
  });
  EXPECT_NE(status.name, "") << name << " never says: " << text;
  return status;
}

TEST(Diagnostics, WithoutARobotSayWhatIsMissingAndWhatIsIdle) {
  DiagnosticsListener diagnostics;
  const DriverProcess driver("/alone", 1);
  const std::string name = "alone/aibo_driver: ";
  const std::string dark = "no pictures: the robot is not connected";
  EXPECT_EQ(waitForStatus(diagnostics, name + "stream", DiagnosticStatus::WARN, dark).message, dark);
  const std::string unknown = "no joint positions: the robot is not connected";
  EXPECT_EQ(waitForStatus(diagnostics, name + "joints", DiagnosticStatus::WARN, unknown).message, unknown);
  waitForStatus(diagnostics, name + "power", DiagnosticStatus::OK, "idle: the robot is not connected");
  waitForStatus(diagnostics, name + "sound", DiagnosticStatus::OK, "idle: microphone has no subscriber");
  const TopicListener<aibo_driver::Sound> listener("/alone/microphone");
  const auto deaf = waitForStatus(diagnostics, name + "sound", DiagnosticStatus::WARN, "nothing is heard");
  EXPECT_EQ(DiagnosticsListener::value(deaf, "listening"), "yes");
  const auto refused = waitForStatus(diagnostics, name + "connection", DiagnosticStatus::ERROR, "not connected");
  EXPECT_EQ(numberIn(refused, "connections made"), 0);
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
  waitForStatus(diagnostics, "damage/aibo_driver: joints", DiagnosticStatus::WARN,
                "the robot sends no joint positions");
  std_srvs::SetBool off;
  ASSERT_TRUE(ros::service::call("/damage/set_streaming", off));
  const auto idle = wait_for(DiagnosticStatus::OK, "idle: the stream is off");
  EXPECT_EQ(DiagnosticsListener::value(idle, "stream wanted"), "no");
}

TEST(StreamDiagnostics, WarnOfACameraThatDoesNotRun) {
  PictureServer server(2, 1h);
  DriverProcess driver("/blind", server.port(), kWithoutRobotTime);
  DiagnosticsListener diagnostics;
  const auto blind = waitForStatus(diagnostics, "blind/aibo_driver: stream", DiagnosticStatus::WARN,
                                   "no pictures although the stream is on");
  EXPECT_EQ(DiagnosticsListener::value(blind, "streaming"), "yes");
}

TEST(StreamDiagnostics, WarnOfDataThatComesLate) {
  SimulatedRobot robot;
  FaultProxy proxy(robot.port());
  DriverProcess driver("/late", proxy.port(), {"_read_timeout:=20", test_support::kByTcp});
  DiagnosticsListener diagnostics;
  waitForStatus(diagnostics, "late/aibo_driver: stream", DiagnosticStatus::OK, "pictures/s");
  test_support::Conditions detour;
  detour.delay = 600ms;
  proxy.setConditions(detour);
  const auto late =
      waitForStatus(diagnostics, "late/aibo_driver: stream", DiagnosticStatus::WARN, "ms late on average");
  EXPECT_GT(std::stod(DiagnosticsListener::value(late, "delay beyond the shortest, longest ms")), 400);
}

TEST(StreamDiagnostics, WarnOfAStreamThatHasLessThanHalfOfTheRate) {
  PictureServer server(2, 200ms);
  std::vector<std::string> parameters = kWithoutRobotTime;
  parameters.emplace_back("_adaptive:=true");
  DriverProcess driver("/slow_stream", server.port(), parameters);
  DiagnosticsListener diagnostics;
  const auto slow = diagnostics.waitFor("slow_stream/aibo_driver: stream", [](const auto& status) {
    return status.level == DiagnosticStatus::WARN && status.message.find("only ") == 0;
  });
  EXPECT_THAT(slow.message, HasSubstr("of 30.0 pictures/s: is the radio link weak"));
  EXPECT_EQ(DiagnosticsListener::value(slow, "pictures per second asked for"), "30.0");
  driver.waitForOutput("adaptive has no effect: the age of the pictures is not known", test_support::kSafetyNet);
}

TEST(StreamDiagnostics, CountTheImagesForWhichTheDecoderHadNoTime) {
  PictureServer server(2, 0ms);
  DriverProcess driver("/hurried", server.port(), kWithoutRobotTime);
  DiagnosticsListener diagnostics;
  const boost::function<void(const sensor_msgs::ImageConstPtr&)> look = [](const sensor_msgs::ImageConstPtr&) {};
  const ros::Subscriber viewer = ros::NodeHandle().subscribe<sensor_msgs::Image>("/hurried/camera/image_raw", 1, look);
  const auto dropped = diagnostics.waitFor("hurried/aibo_driver: stream", [](const auto& status) {
    const std::string count = DiagnosticsListener::value(status, "images dropped for newer ones");
    return count != "" && count != "0";
  });
  EXPECT_NE(dropped.name, "");
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
  dynamic_reconfigure::Reconfigure call;
  call.request.config.strs.resize(1);
  call.request.config.strs[0].name = "transport";
  call.request.config.strs[0].value = "auto";
  ASSERT_TRUE(ros::service::call("/no_udp/aibo_driver/set_parameters", call));
  const auto either = waitForStatus(diagnostics, "no_udp/aibo_driver: stream", DiagnosticStatus::OK, "pictures/s");
  EXPECT_EQ(DiagnosticsListener::value(either, "transport wanted"), "auto") << "this way is as good";
}

TEST(StreamDiagnostics, SayToWhatAdaptiveHasLoweredTheStream) {
  SimulatedRobot robot;
  FaultProxy proxy(robot.port());
  test_support::Conditions slow_link;
  slow_link.bytes_per_second = 60000;  // 12 pictures a second at quality 85
  proxy.setConditions(slow_link);
  DriverProcess driver(
      "/adaptive", proxy.port(),
      {"_adaptive:=true", "_max_picture_age:=0.2", "_telemetry_rate:=0", "_read_timeout:=20", test_support::kByTcp});
  DiagnosticsListener diagnostics;
  const auto lowered = diagnostics.waitFor("adaptive/aibo_driver: stream", [](const auto& status) {
    return DiagnosticsListener::value(status, "adaptive").find("lowered to quality 50 of 85") == 0;
  });
  EXPECT_EQ(DiagnosticsListener::value(lowered, "quality asked for"), "50");
  EXPECT_THAT(driver.output(), HasSubstr("at most 200 ms are allowed: the stream is lowered"));
  aibo_driver::TakePicture picture;
  ASSERT_TRUE(ros::service::call("/adaptive/take_picture", picture));
  EXPECT_THAT(picture.response.message, HasSubstr("at quality 85."));
  const auto joints = diagnostics.waitForNext("adaptive/aibo_driver: joints");
  EXPECT_EQ(joints.level, DiagnosticStatus::OK) << "nobody has asked for measurements";
  EXPECT_THAT(joints.message, HasSubstr("idle: telemetry_rate is 0"));
  EXPECT_EQ(diagnostics.waitForNext("adaptive/aibo_driver: power").level, DiagnosticStatus::OK);
}

TEST(JointDiagnostics, AreOkAgainWhenAJointThatWasJammedFollows) {
  SimulatedRobot robot;
  DriverProcess driver("/jam", robot.port(), {"_stream_on_start:=false", "_transport:=udp", "_read_timeout:=20"});
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
  const std::string idle = "idle: the stream is off (set_streaming turns it on)";
  EXPECT_EQ(waitForStatus(diagnostics, "jam/aibo_driver: stream", DiagnosticStatus::OK, idle).message, idle);
  ASSERT_THAT(robot.type("jam head_pan"), HasSubstr("ok"));
  send_head_to(1);
  EXPECT_NE(wait_for(DiagnosticStatus::ERROR, "head_pan is jammed").name, "");
  ASSERT_THAT(robot.type("free head_pan"), HasSubstr("ok"));
  send_head_to(0.5);
  const DiagnosticStatus free = wait_for(DiagnosticStatus::OK, "measurements/s");
  EXPECT_EQ(DiagnosticsListener::value(free, "said by the robot"), "");
}

TEST(JointDiagnostics, WarnOfMeasurementsThatNoRobotSends) {
  test_support::ScriptedServer server;
  DriverProcess driver("/strange", server.port(), {"_stream_on_start:=false", "_read_timeout:=20"});
  TopicListener<DiagnosticArray> diagnostics("/diagnostics");
  test_support::ScriptedPeer robot = server.accept();
  robot.agreeToTelemetry("F J T S");
  ASSERT_TRUE(diagnostics.waitForNext());
  const auto has_said = [&diagnostics](const std::string& text) {
    return diagnostics.waitFor([&text](const DiagnosticArray& array) {
      return std::any_of(array.status.begin(), array.status.end(), [&text](const DiagnosticStatus& each) {
        return each.level == DiagnosticStatus::WARN && each.message.find(text) == 0;
      });
    }) != nullptr;
  };
  robot.send(version2_frames::makeFrame('t', 0, version2_frames::makeTelemetry(1000, {{'J', 2, 2000000000}})));
  EXPECT_TRUE(has_said("1 impossible values dropped"));
  for (unsigned frame = 1004; frame < 1804; frame += 4) {
    robot.send(version2_frames::makeFrame('t', 0, version2_frames::makeTelemetry(frame, {{'J', 2, 0}})));
  }
  EXPECT_TRUE(diagnostics.waitFor([](const DiagnosticArray& array) {
    return std::any_of(array.status.begin(), array.status.end(), [](const DiagnosticStatus& each) {
      return each.message.find("measurements dropped: the robot sends more than twice as many") != std::string::npos;
    });
  }));
  diagnostics.clear();
  EXPECT_TRUE(has_said("the robot sends no joint positions")) << "what it sent before was said";
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
