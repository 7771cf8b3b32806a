// The driver's node under faults of the network, the ROS master, the clock and its users.

#include <aibo_driver/Connection.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/UploadMotion.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "support/memory_stick.h"
#include "support/picture_server.h"
#include "support/proxy/fault_proxy.h"
#include "support/ros/driver_process.h"
#include "support/ros/topics.h"
#include "support/safety_net.h"
#include "support/scripted_server.h"
#include "support/sockets.h"

namespace {

using aibo_driver::Connection;
using std::chrono::milliseconds;
using test_support::Action;
using test_support::Direction;
using test_support::DriverProcess;
using test_support::eventually;
using test_support::FaultProxy;
using test_support::kSafetyNet;
using test_support::MemoryStick;
using test_support::PictureServer;
using test_support::Place;
using test_support::Process;
using test_support::TopicListener;
using test_support::Welcome;

using CompressedListener = TopicListener<sensor_msgs::CompressedImage>;

// No connection ends because this computer is slow.
constexpr const char* kPatient = "_read_timeout:=60";

/// Ends the node, by Ctrl-C unless told otherwise.
void expectEnds(DriverProcess* driver, int signal = SIGINT) {
  driver->signal(signal);
  EXPECT_EQ(driver->waitForExit(kSafetyNet).value_or(-1), 0) << driver->output();
}

/// A fast server, and a proxy in front of it.
class Faults : public testing::Test {
 protected:
  PictureServer server_{2, milliseconds(2)};
  FaultProxy proxy_{server_.port()};
};

TEST_F(Faults, ASignalEndsTheNodeWhateverTheRobotDoes) {
  const std::tuple<std::string, Welcome, int> rows[] = {{"turned_away", Welcome::kReset, SIGINT},
                                                        {"black_hole", Welcome::kSilence, SIGINT},
                                                        {"refused", Welcome::kRefuse, SIGINT},
                                                        {"refused_and_terminated", Welcome::kRefuse, SIGTERM},
                                                        {"half_a_picture", Welcome::kServe, SIGINT}};
  for (const auto& [name, welcome, signal] : rows) {
    proxy_.setWelcome(welcome);
    TopicListener<Connection> connection("/" + name + "/connection");
    const bool is_served = welcome == Welcome::kServe;
    DriverProcess driver("/" + name, proxy_.port(),
                         {test_support::kByTcp, test_support::kStreams, is_served ? kPatient : "_read_timeout:=0.5"});
    EXPECT_TRUE(connection.waitFor([&](const Connection& message) {
      return is_served ? message.state == Connection::CONNECTED : !message.reason.empty();
    })) << name;
    if (is_served) {
      proxy_.add({Action::kSilence, Place::kPicture, 1000});
      EXPECT_TRUE(proxy_.waitForFaults());
    }
    SCOPED_TRACE(name);
    expectEnds(&driver, signal);
  }
}

TEST_F(Faults, CtrlCEndsTheNodeWhoseMasterDoesNotAnswer) {
  FaultProxy master(static_cast<int>(ros::master::getPort()));
  CompressedListener pictures("/deaf_master/camera/image_raw/compressed");
  const char* const sanitizer = std::getenv("TSAN_OPTIONS");
  const std::map<std::string, std::string> environment = {
      {"ROS_MASTER_URI", "http://127.0.0.1:" + std::to_string(master.port())},
      {"TSAN_OPTIONS",
       std::string(sanitizer == nullptr ? "" : sanitizer) + ":report_thread_leaks=0"}};  // intended here
  DriverProcess driver("/deaf_master", proxy_.port(), {test_support::kByTcp}, environment);
  ASSERT_FALSE(pictures.waitForCount(1).empty());
  test_support::Conditions silence;
  silence.paused = true;
  master.setConditions(silence);
  driver.signal(SIGINT);
  driver.waitForOutput("without unregistering");
  EXPECT_EQ(driver.waitForExit(kSafetyNet).value_or(-1), EXIT_FAILURE);

  master.setConditions({});
  test_support::ScriptedServer server;
  DriverProcess next("/deaf_master", server.port(), {"_connect_timeout:=60", kPatient}, environment);
  test_support::ScriptedPeer robot = server.accept();
  master.setConditions(silence);
  next.signal(SIGINT);
  robot.waitUntilClosed();
  next.signal(SIGINT);
  EXPECT_EQ(next.waitForExit(kSafetyNet).value_or(-1), 128 + SIGINT) << "a second Ctrl-C ends it at once";
}

TEST_F(Faults, PicturesGoOnWhileServicesWaitAndCtrlCEndsTheNode) {
  CompressedListener pictures("/waiting/camera/image_raw/compressed");
  DriverProcess driver("/waiting", proxy_.port(), {test_support::kByTcp, kPatient});
  ASSERT_FALSE(pictures.waitForCount(1).empty());
  const MemoryStick stick("");
  aibo_driver::PlayMotion play;
  play.request.name = "nod";
  play.request.repetitions = 1;
  aibo_driver::UploadMotion upload;
  upload.request.file = stick.path("OPEN-R/MW/DATA/P/WAG.MTN");
  proxy_.add({Action::kPause, Place::kByte, 0, Direction::kToServer, {}, std::chrono::minutes(10)});
  // The node may end without answering.
  const auto plays = std::async(std::launch::async, [&] { ros::service::call("/waiting/play_motion", play); });
  const auto uploads = std::async(std::launch::async, [&] { ros::service::call("/waiting/upload_motion", upload); });
  ASSERT_TRUE(proxy_.waitForFaults());
  pictures.clear();
  EXPECT_FALSE(pictures.waitForCount(100).empty());
  expectEnds(&driver);
}

TEST_F(Faults, ASubscriberThatHangsDelaysNobodyElse) {
  CompressedListener pictures("/hangs/camera/image_raw/compressed");
  TopicListener<sensor_msgs::Image> decoded("/hangs/decoder/image_raw");
  DriverProcess driver("/hangs", proxy_.port(), {test_support::kByTcp, kPatient});
  Process decoder({AIBO_IMAGE_DECODER, "__ns:=/hangs/decoder",
                   "/hangs/decoder/image_raw/compressed:=/hangs/camera/image_raw/compressed"});
  ASSERT_FALSE(decoded.waitForCount(1).empty());
  decoder.signal(SIGSTOP);
  pictures.clear();
  for (int i = 0; i < 10; ++i) {
    ASSERT_FALSE(pictures.waitForCount(pictures.count() + 50).empty());
  }
  const ros::Time hung_until = pictures.waitForCount(1).back()->header.stamp;
  decoder.signal(SIGCONT);
  EXPECT_TRUE(decoded.waitFor([&](const sensor_msgs::Image& image) { return image.header.stamp > hung_until; }));
}

TEST_F(Faults, PicturesGoOnInSimulatedTimeThatJumps) {
  ros::param::set("/use_sim_time", true);
  const ros::Publisher time = ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 10);
  CompressedListener pictures("/jumps/camera/image_raw/compressed");
  DriverProcess driver("/jumps", proxy_.port(), {kPatient});
  for (const double seconds : {1000.0, 500.0, 100000.0}) {
    rosgraph_msgs::Clock message;
    message.clock = ros::Time(seconds);
    EXPECT_TRUE(eventually([&] {
      message.clock += ros::Duration(0.01);
      time.publish(message);
      const auto all = pictures.waitForCount(0);
      return !all.empty() && std::abs(all.back()->header.stamp.toSec() - seconds) < 60;
    })) << "no picture with the new time after the jump to "
        << seconds;
  }
  EXPECT_TRUE(driver.isRunning());
  ros::param::del("/use_sim_time");
}

TEST_F(Faults, ADriverOutlivesItsMasterAndItsSubscribersDoToo) {
  const int port = test_support::portOf(test_support::bindTo("127.0.0.1", 0));
  const std::map<std::string, std::string> environment{{"ROS_MASTER_URI", "http://127.0.0.1:" + std::to_string(port)}};
  Process master({"roscore", "-p", std::to_string(port)}, environment);
  master.waitForOutput("started core service");
  Process driver(
      {AIBO_DRIVER_NODE, "__ns:=/master", "_port:=" + std::to_string(proxy_.port()), kPatient, test_support::kByTcp},
      environment);
  const Process listener({"rostopic", "hz", "/master/camera/image_raw/compressed"}, environment);
  const auto hears_pictures = [&listener] {
    const std::size_t before = listener.output().size();
    return eventually([&] { return listener.output().find("average rate", before) != std::string::npos; });
  };
  EXPECT_TRUE(hears_pictures());
  master.signal(SIGINT);  // SIGKILL would leave its children behind
  master.waitForExit(kSafetyNet);
  const std::size_t connections = proxy_.connections();
  proxy_.endConnections(Action::kReset);
  EXPECT_TRUE(eventually([&] { return proxy_.connections() > connections; })) << "it does not reconnect";
  EXPECT_TRUE(hears_pictures());
  driver.signal(SIGINT);
  EXPECT_EQ(driver.waitForExit(kSafetyNet).value_or(-1), 0) << "it does not end without a master";
}

}  // namespace
