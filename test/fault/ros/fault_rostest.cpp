// The driver's node under faults of the robot, the network, the ROS master and its users.

#include <aibo_driver/Connection.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/TakePicture.h>
#include <aibo_driver/UploadMotion.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <signal.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "support/good_calibration.h"
#include "support/memory_stick.h"
#include "support/picture_server.h"
#include "support/proxy/fault_proxy.h"
#include "support/proxy/recording_proxy.h"
#include "support/resources.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/joint_listener.h"
#include "support/ros/joint_messages.h"
#include "support/ros/topic_listener.h"
#include "support/ros/topic_publishers.h"
#include "support/scripted_server.h"
#include "support/simulated_robot.h"
#include "support/sockets.h"
#include "support/temporary_folder.h"
#include "support/test_pictures.h"
#include "support/whole_campaign.h"

namespace {

using aibo_driver::Connection;
using aibo_driver::PlayMotion;
using aibo_driver::TakePicture;
using aibo_driver::UploadMotion;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test_support::Action;
using test_support::DiagnosticsListener;
using test_support::Direction;
using test_support::DriverProcess;
using test_support::FaultProxy;
using test_support::goodCalibration;
using test_support::JointListener;
using test_support::kSafetyNet;
using test_support::MemoryStick;
using test_support::PictureServer;
using test_support::Place;
using test_support::Process;
using test_support::RecordingProxy;
using test_support::Resources;
using test_support::SimulatedRobot;
using test_support::TemporaryFolder;
using test_support::TopicListener;
using test_support::TopicPublishers;
using test_support::wantsWholeCampaign;
using test_support::Welcome;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using CompressedListener = TopicListener<sensor_msgs::CompressedImage>;

template <typename Condition>
bool eventually(const Condition& condition) {
  const auto end = steady_clock::now() + kSafetyNet;
  while (!condition()) {
    if (steady_clock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(milliseconds(1));
  }
  return true;
}

/// Ends the node by Ctrl-C.
void expectEndsSoon(DriverProcess* driver) {
  const milliseconds limit = wantsWholeCampaign() ? milliseconds(1000) : milliseconds(20000);
  const auto begin = steady_clock::now();
  driver->signal(SIGINT);
  EXPECT_EQ(driver->waitForExit(kSafetyNet).value_or(-1), 0) << driver->output();
  EXPECT_LE(steady_clock::now() - begin, limit);
}

/// Waits for the node to release what it holds only for a while, such as its connection to the master.
void expectNoMoreThan(const Resources& before, const DriverProcess& driver) {
  Resources now;
  EXPECT_TRUE(eventually([&] {
    now = Resources::of(std::to_string(driver.pid()));
    return now.descriptors <= before.descriptors && now.threads <= before.threads;
  })) << now.descriptors
      << " descriptors, before " << before.descriptors << "; " << now.threads << " threads, before " << before.threads;
  if (wantsWholeCampaign()) {
    EXPECT_LE(now.resident_kilobytes, before.resident_kilobytes + 1024);
  }
}

/// A fast server, and a proxy in front of it.
class Faults : public testing::Test {
 protected:
  bool picturesFlow() {
    const std::uint64_t before = server_.lastNumber();
    return eventually([&] { return server_.lastNumber() > before + 5; });
  }

  PictureServer server_{2, milliseconds(2)};
  FaultProxy proxy_{server_.port()};
};

TEST_F(Faults, HundredsOfReconnectsLeaveNothingBehind) {
  const int rounds = wantsWholeCampaign() ? 500 : 50;
  const int warm_up = rounds / 5;
  DriverProcess driver("/reconnects", proxy_.port(), {test_support::kByTcp, "_reconnect_wait_max:=0.05"});
  Resources before;
  for (int round = 0; round < rounds; ++round) {
    ASSERT_TRUE(picturesFlow()) << "round " << round;
    if (round == warm_up) {
      before = Resources::of(std::to_string(driver.pid()));
    }
    const std::size_t connections = proxy_.connections();
    if (round % 3 == 0) {
      proxy_.add({Action::kOverwrite, Place::kPicture, 0, Direction::kToClient, 0, {0xFF}});
    } else {
      proxy_.endConnections(round % 3 == 1 ? Action::kReset : Action::kClose);
    }
    ASSERT_TRUE(eventually([&] { return proxy_.connections() > connections; })) << "round " << round;
  }
  ASSERT_TRUE(picturesFlow());
  expectNoMoreThan(before, driver);
}

/// Counts named pictures, and checks that they come in order and unchanged.
class NamedPictures {
 public:
  explicit NamedPictures(const std::string& topic)
      : subscriber_(ros::NodeHandle().subscribe(topic, 1000, &NamedPictures::see, this)) {}

  std::uint64_t last() const { return last_; }
  std::uint64_t count() const { return count_; }

 private:
  void see(const sensor_msgs::CompressedImage& picture) {
    const auto name = test_pictures::nameOf(picture.data);
    ASSERT_TRUE(name.has_value());
    EXPECT_GT(name->number, last_);
    EXPECT_EQ(picture.data, test_pictures::makeNamed(*name)) << "picture " << name->number;
    last_ = name->number;
    ++count_;
  }

  std::atomic<std::uint64_t> last_{0};
  std::atomic<std::uint64_t> count_{0};
  const ros::Subscriber subscriber_;
};

TEST(FaultsOfRobots, AThousandPicturesASecondAreAllReceived) {
  const std::uint64_t wanted = wantsWholeCampaign() ? 600000 : 2000;
  const std::uint64_t warm_up = wanted / 5;
  const std::string kStream = "fast/aibo_driver: stream";
  PictureServer server(2, milliseconds(1));
  NamedPictures pictures("/fast/camera/image_raw/compressed");
  DiagnosticsListener diagnostics;
  DriverProcess driver("/fast", server.port(), {"_read_timeout:=60"});  // no connection ends, even on a slow computer
  const auto waitForPicture = [&](std::uint64_t number) {
    while (pictures.last() < number) {
      const std::uint64_t before = pictures.last();
      ASSERT_TRUE(eventually([&] { return pictures.last() > before; })) << "after picture " << before;
    }
  };
  ASSERT_NO_FATAL_FAILURE(waitForPicture(warm_up));
  ASSERT_FALSE(diagnostics.waitForNext(kStream).name.empty());
  const Resources warm = Resources::of(std::to_string(driver.pid()));
  ASSERT_NO_FATAL_FAILURE(waitForPicture(wanted));
  expectNoMoreThan(warm, driver);
  server.setStopped(true);
  const std::uint64_t sent = server.lastNumber();
  const auto count = [](const diagnostic_msgs::DiagnosticStatus& stream, const std::string& key) {
    return std::stoull("0" + DiagnosticsListener::value(stream, key));
  };
  const auto stale = [&](const auto& stream) { return count(stream, "pictures dropped for newer ones"); };
  const auto all_have_come = [&](const auto& stream) {
    return count(stream, "pictures received") + stale(stream) + 1 >= sent;  // the last one may be incomplete
  };
  const auto stream = diagnostics.waitFor(kStream, all_have_come);
  EXPECT_FALSE(stream.name.empty()) << "some of " << sent << " pictures have not come";
  if (wantsWholeCampaign()) {
    std::printf("%llu pictures sent, %llu dropped for newer ones, %llu received by a subscriber\n",
                static_cast<unsigned long long>(sent), static_cast<unsigned long long>(stale(stream)),
                static_cast<unsigned long long>(pictures.count()));
    EXPECT_LE(1000 * stale(stream), sent);
    EXPECT_GE(100 * pictures.count(), 99 * sent);  // ROS' queues overflow when this computer is held up for 5 ms
  }
}

TEST_F(Faults, CtrlCEndsTheNodeInEveryState) {
  const std::map<std::string, Welcome> states = {{"turned_away", Welcome::kClose},
                                                 {"black_hole", Welcome::kSilence},
                                                 {"refused", Welcome::kRefuse},
                                                 {"unreachable", Welcome::kUnreachable},
                                                 {"streaming", Welcome::kServe}};
  for (const auto& state : states) {
    proxy_.setWelcome(state.second);
    TopicListener<Connection> connection("/" + state.first + "/connection");
    DriverProcess driver("/" + state.first, proxy_.port(), {test_support::kByTcp});
    ASSERT_TRUE(connection.waitFor([&](const Connection& message) {
      return state.second == Welcome::kServe ? message.state == Connection::CONNECTED : !message.reason.empty();
    })) << state.first;
    SCOPED_TRACE(state.first);
    expectEndsSoon(&driver);
  }
}

TEST_F(Faults, CtrlCEndsTheNodeInTheMiddleOfAPicture) {
  CompressedListener pictures("/middle/camera/image_raw/compressed");
  DriverProcess driver("/middle", proxy_.port(), {test_support::kByTcp, "_read_timeout:=30"});
  ASSERT_FALSE(pictures.waitForCount(1).empty());
  proxy_.add({Action::kSilence, Place::kPicture, 1000});
  ASSERT_TRUE(proxy_.waitForFaults(1, kSafetyNet));
  expectEndsSoon(&driver);
}

TEST_F(Faults, CtrlCEndsTheNodeWhileItsRobotsNameIsLookedUp) {
  TopicListener<Connection> connection("/name/connection");
  DriverProcess driver("/name", proxy_.port(),
                       {test_support::kByTcp, "_host:=no-such-robot.invalid", "_reconnect_wait_max:=0.01"});
  ASSERT_FALSE(connection.waitForCount(1).empty());
  expectEndsSoon(&driver);
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
  driver.waitForOutput("without signing off", kSafetyNet);
  EXPECT_EQ(driver.waitForExit(kSafetyNet).value_or(-1), EXIT_FAILURE);

  master.setConditions({});
  test_support::ScriptedServer server;
  DriverProcess next("/deaf_master", server.port(), {"_connect_timeout:=60", "_read_timeout:=60"}, environment);
  test_support::ScriptedPeer robot = server.accept();
  master.setConditions(silence);
  next.signal(SIGINT);
  robot.waitUntilClosed();
  next.signal(SIGINT);
  EXPECT_EQ(next.waitForExit(kSafetyNet).value_or(-1), 128 + SIGINT) << "a second Ctrl-C ends it at once";
}

TEST_F(Faults, PicturesGoOnWhileServicesWaitAndCtrlCEndsTheNode) {
  CompressedListener pictures("/waiting/camera/image_raw/compressed");
  DriverProcess driver("/waiting", proxy_.port(), {test_support::kByTcp, "_read_timeout:=60"});
  ASSERT_FALSE(pictures.waitForCount(1).empty());
  const MemoryStick stick("");
  PlayMotion play;
  play.request.name = "nod";
  play.request.repetitions = 1;
  UploadMotion upload;
  upload.request.file = stick.path("OPEN-R/MW/DATA/P/WAG.MTN");
  proxy_.add({Action::kPause, Place::kHere, 0, Direction::kToServer, 0, {}, std::chrono::minutes(10)});
  // The node may end without answering.
  const auto plays = std::async(std::launch::async, [&] { ros::service::call("/waiting/play_motion", play); });
  const auto uploads = std::async(std::launch::async, [&] { ros::service::call("/waiting/upload_motion", upload); });
  ASSERT_TRUE(proxy_.waitForFaults(1, kSafetyNet));
  pictures.clear();
  EXPECT_FALSE(pictures.waitForCount(100).empty());
  for (const auto* waiting : {&plays, &uploads}) {
    EXPECT_EQ(waiting->wait_for(milliseconds(0)), std::future_status::timeout);
  }
  expectEndsSoon(&driver);
}

TEST(FaultsOfUsers, CtrlCEndsTheNodeDuringATrajectory) {
  const SimulatedRobot robot;
  JointListener joints("/middle_motion");
  TopicPublishers topics("/middle_motion");
  DriverProcess driver("/middle_motion", robot.port(), {"_stream_on_start:=false"});
  ASSERT_FALSE(joints.messages().waitForCount(1).empty());
  topics.publish("joint_trajectory", test_support::trajectory({{"head_pan", 1.0}}, 20));
  ASSERT_TRUE(joints.messages().waitFor(
      [](const auto& message) { return test_support::positionOf(message, "head_pan").value_or(0) > 0.05; }));
  expectEndsSoon(&driver);
}

TEST_F(Faults, SubscribersComeAndGo) {
  const int rounds = wantsWholeCampaign() ? 1000 : 40;
  DriverProcess driver("/subscribers", proxy_.port(), {test_support::kByTcp});
  const auto come_and_go = [](int count) {
    for (int i = 0; i < count; ++i) {
      const CompressedListener compressed("/subscribers/camera/image_raw/compressed");
      const TopicListener<sensor_msgs::Image> images("/subscribers/camera/image_raw");
      std::this_thread::sleep_for(milliseconds(i % 10));
    }
  };
  ASSERT_TRUE(picturesFlow());
  come_and_go(rounds / 4);
  EXPECT_FALSE(CompressedListener("/subscribers/camera/image_raw/compressed").waitForCount(1).empty());
  const Resources before = Resources::of(std::to_string(driver.pid()));
  come_and_go(rounds - rounds / 4);
  EXPECT_FALSE(TopicListener<sensor_msgs::Image>("/subscribers/camera/image_raw").waitForCount(1).empty());
  EXPECT_TRUE(eventually([&] {
    const Resources now = Resources::of(std::to_string(driver.pid()));
    return now.descriptors <= before.descriptors + 2 && now.threads <= before.threads;
  })) << "descriptors or threads leaked";
  EXPECT_TRUE(driver.isRunning());
}

TEST_F(Faults, ASubscriberThatHangsDelaysNobodyElse) {
  CompressedListener pictures("/hangs/camera/image_raw/compressed");
  TopicListener<sensor_msgs::Image> decoded("/hangs/decoder/image_raw");
  DriverProcess driver("/hangs", proxy_.port(), {test_support::kByTcp});
  Process decoder({AIBO_IMAGE_DECODER, "__ns:=/hangs/decoder",
                   "/hangs/decoder/image_raw/compressed:=/hangs/camera/image_raw/compressed"});
  ASSERT_FALSE(decoded.waitForCount(1).empty());
  decoder.signal(SIGSTOP);
  pictures.clear();
  for (int i = 0; i < 10; ++i) {
    ASSERT_FALSE(pictures.waitForCount(pictures.count() + 50).empty());
  }
  EXPECT_TRUE(picturesFlow());
  decoded.clear();
  const auto meanwhile = pictures.waitForCount(1);
  decoder.signal(SIGCONT);
  const auto is_new = [&](const sensor_msgs::Image& image) {
    return image.header.stamp > meanwhile.back()->header.stamp;
  };
  ASSERT_TRUE(decoded.waitFor(is_new));
  std::size_t stale = 0;
  for (const auto& image : decoded.waitForCount(1)) {
    stale += is_new(*image) ? 0 : 1;
  }
  EXPECT_LT(stale, meanwhile.size() / 2) << "it decodes stale pictures";
  EXPECT_TRUE(driver.isRunning());
}

TEST_F(Faults, SubscribersHearANodeThatIsKilledAndStartedAgain) {
  CompressedListener pictures("/respawn/camera/image_raw/compressed");
  auto driver =
      std::make_unique<DriverProcess>("/respawn", proxy_.port(), std::vector<std::string>{test_support::kByTcp});
  for (int round = 0; round < 3; ++round) {
    pictures.clear();
    ASSERT_FALSE(pictures.waitForCount(3).empty()) << "round " << round;
    driver->kill();
    driver = std::make_unique<DriverProcess>("/respawn", proxy_.port(), std::vector<std::string>{test_support::kByTcp});
  }
  pictures.clear();
  EXPECT_FALSE(pictures.waitForCount(3).empty());
}

template <typename Service>
std::future<typename Service::Response> callInBackground(const std::string& name, typename Service::Request request) {
  return std::async(std::launch::async, [name, request]() mutable {
    typename Service::Response response;
    EXPECT_TRUE(ros::service::call(name, request, response)) << "the call itself failed";
    return response;
  });
}

double farthest(const sensor_msgs::JointState& a, const sensor_msgs::JointState& b) {
  double distance = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    distance = std::max(distance, std::abs(a.position[i] - b.position.at(i)));
  }
  return distance;
}

/// Waits until all joints stand still.
/// @return true if none moves for a second after that
bool jointsHold(JointListener& joints) {
  joints.messages().waitForNext();  // the first message has no velocities yet
  joints.messages().clear();
  const auto standing = joints.messages().waitFor([](const sensor_msgs::JointState& message) {
    return std::all_of(message.velocity.begin(), message.velocity.end(),
                       [](double velocity) { return std::abs(velocity) < 0.05; });
  });
  joints.messages().clear();
  const auto later = joints.messages().waitForCount(30);
  return standing && later.size() >= 30 && std::all_of(later.begin(), later.end(), [&](const auto& message) {
           return farthest(*standing, *message) < JointListener::kTolerance;
         });
}

TEST(FaultsOfUsers, CallsThatTheNetworkCutsOffFailAndAreNotRepeated) {
  const SimulatedRobot robot;
  RecordingProxy proxy(robot.port());
  JointListener joints("/cut_off");
  TopicListener<Connection> connection("/cut_off/connection");
  DriverProcess driver("/cut_off", proxy.port(), {"_stream_on_start:=false", "_read_timeout:=60"});
  ASSERT_FALSE(joints.messages().waitForCount(1).empty());
  proxy.setMute(true);
  PlayMotion::Request motion;
  motion.name = "nod";
  motion.repetitions = 1000;
  auto played = callInBackground<PlayMotion>("/cut_off/play_motion", motion);
  auto taken = callInBackground<TakePicture>("/cut_off/take_picture", {});
  ASSERT_TRUE(proxy.waitForRequest("P", kSafetyNet));
  ASSERT_TRUE(proxy.waitForRequest("F", kSafetyNet));

  const std::size_t connections = proxy.connections();
  connection.clear();
  proxy.cut();
  const PlayMotion::Response no_motion = played.get();
  EXPECT_FALSE(no_motion.success);
  EXPECT_NE(no_motion.message, "");
  const TakePicture::Response no_picture = taken.get();
  EXPECT_FALSE(no_picture.success);
  EXPECT_NE(no_picture.message, "");

  proxy.setMute(false);
  ASSERT_TRUE(connection.waitFor([](const Connection& message) { return message.state == Connection::CONNECTED; }));
  EXPECT_TRUE(jointsHold(joints)) << "the motion goes on though nobody could stop it";
  EXPECT_THAT(proxy.requestsFromDriver("FPJ", connections), IsEmpty());
  EXPECT_TRUE(callInBackground<PlayMotion>("/cut_off/play_motion", motion).get().success);
  EXPECT_TRUE(driver.isRunning());
}

TEST(FaultsOfUsers, CommandsOfAnotherTypeAreRefusedAndOthersCarriedOut) {
  TopicListener<rosgraph_msgs::Log> log("/rosout");
  const SimulatedRobot robot;
  JointListener joints("/types");
  DriverProcess driver("/types", robot.port(), {"_stream_on_start:=false"});
  ASSERT_FALSE(joints.messages().waitForCount(1).empty());
  for (const std::string topic :
       {"joint_command", "joint_trajectory", "head_pan_position_controller/command", "leds", "ears"}) {
    constexpr bool kLatched = true;
    ros::Publisher publisher = ros::NodeHandle("/types").advertise<std_msgs::String>(topic, 10, kLatched);
    publisher.publish(std_msgs::String());
    const std::string complaint = "wants topic /types/" + topic + " to have datatype/md5sum";
    EXPECT_TRUE(log.waitFor([&](const auto& entry) { return entry.msg.find(complaint) != std::string::npos; }));
  }
  TopicPublishers topics("/types");
  std_msgs::Float64 position;
  position.data = 0.5;
  topics.publish("head_pan_position_controller/command", position);
  EXPECT_TRUE(joints.waitForPosition("head_pan", 0.5));
  EXPECT_TRUE(driver.isRunning());
}

TEST_F(Faults, NonsenseCameraInfoIsRefusedAndTheOldOneKept) {
  using sensor_msgs::CameraInfo;
  const TemporaryFolder folder;
  const std::vector<std::string> parameters = {"_camera_info_url:=file://" + folder.path().string() + "/new/aibo.yaml"};
  const auto set = [](const CameraInfo& info) {
    sensor_msgs::SetCameraInfo service;
    service.request.camera_info = info;
    EXPECT_TRUE(ros::service::call("/nonsense/camera/set_camera_info", service));
    EXPECT_FALSE(service.response.status_message.empty());
    return static_cast<bool>(service.response.success);
  };
  TopicListener<CameraInfo> camera_infos("/nonsense/camera/camera_info");
  const auto old_one_is_kept = [&] {
    camera_infos.clear();
    const auto info = camera_infos.waitForNext();
    return info && info->K == goodCalibration().K && info->D == goodCalibration().D && info->width == 208;
  };
  auto driver = std::make_unique<DriverProcess>("/nonsense", proxy_.port(), parameters);
  ASSERT_FALSE(camera_infos.waitForCount(1).empty());
  EXPECT_TRUE(set(goodCalibration()));
  CameraInfo nonsense = goodCalibration();
  nonsense.D[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(set(nonsense));
  EXPECT_FALSE(set(CameraInfo()));
  EXPECT_TRUE(old_one_is_kept());
  driver.reset();
  driver = std::make_unique<DriverProcess>("/nonsense", proxy_.port(), parameters);
  EXPECT_TRUE(old_one_is_kept()) << "it was not saved";
}

/// A roscore of its own, and a proxy that hears what it is asked.
class Master {
 public:
  Master() : port_(freePort()), proxy_port_(freePort()) { start(); }
  ~Master() { stop(); }

  /// @param first a command for the master before it is heard through the proxy
  void start(const std::vector<std::string>& first = {}) {
    process_ =
        std::make_unique<Process>(std::vector<std::string>{"roscore", "-p", std::to_string(port_)}, environment());
    try {
      process_->waitForOutput("started core service", std::chrono::seconds(60));
    } catch (...) {
      stop();
      throw;
    }
    if (!first.empty()) {
      EXPECT_EQ(Process(first, environment()).waitForExit(kSafetyNet), 0);
    }
    FaultProxy::Options options;
    options.target_port = port_;
    options.port = proxy_port_;
    options.tap = [this](std::size_t, Direction direction, const std::uint8_t* data, std::size_t size) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (direction == Direction::kToServer) {
        questions_.append(data, data + size);
      }
    };
    proxy_.emplace(options);
  }

  /// By SIGINT, because SIGKILL would leave its children behind.
  void stop() {
    if (process_) {
      process_->signal(SIGINT);
      process_->waitForExit(kSafetyNet);
      process_.reset();
    }
    proxy_.reset();
  }

  std::map<std::string, std::string> environment() const { return environmentAt(port_); }
  /// For programs that use the proxy.
  std::map<std::string, std::string> heardEnvironment() const { return environmentAt(proxy_port_); }

  /// Waits until the proxy has heard this question again.
  bool waitForQuestion(const std::string& method) {
    const auto last = [&] {
      const std::lock_guard<std::mutex> lock(mutex_);
      return questions_.rfind(method);
    };
    return eventually([&last, before = last()] { return last() != before; });
  }

 private:
  static int freePort() { return test_support::portOf(test_support::bindTo("127.0.0.1", 0)); }
  static std::map<std::string, std::string> environmentAt(int port) {
    return {{"ROS_MASTER_URI", "http://127.0.0.1:" + std::to_string(port)}};
  }

  const int port_;
  const int proxy_port_;
  std::unique_ptr<Process> process_;
  std::mutex mutex_;
  std::string questions_;
  std::optional<FaultProxy> proxy_;
};

/// Measures the rate of a topic once a second.
class RateMeter {
 public:
  RateMeter(const Master& master, const std::string& topic)
      : process_({"rostopic", "hz", topic}, master.environment()) {}

  /// Waits for messages that come after this call.
  void expectMessages() {
    const std::size_t before = process_.output().size();
    EXPECT_TRUE(eventually([&] { return process_.output().find("average rate", before) != std::string::npos; }))
        << process_.output();
  }

 private:
  Process process_;
};

/// A driver that outlives its ROS master.
class FaultsOfMaster : public Faults {
 protected:
  /// @param driver the command that starts the driver, without parameters
  void expectToOutliveTheMaster(const std::string& name_space, std::vector<std::string> driver) {
    driver.insert(driver.end(), {"__ns:=" + name_space, "_port:=" + std::to_string(proxy_.port()), "_read_timeout:=60",
                                 test_support::kByTcp});
    Process process(driver, master_.heardEnvironment());
    const std::string topic = name_space + "/camera/image_raw/compressed";
    RateMeter early(master_, topic);
    early.expectMessages();
    Process change({"rosparam", "set", name_space + "/aibo_driver/changed", "after_the_start"}, master_.environment());
    EXPECT_EQ(change.waitForExit(kSafetyNet), 0);
    for (int question = 0; question < 2; ++question) {  // the driver remembers its parameters after each
      ASSERT_TRUE(master_.waitForQuestion("getSystemState"));
    }
    master_.stop();
    const std::size_t connections = proxy_.connections();
    proxy_.endConnections(Action::kReset);
    ASSERT_TRUE(eventually([&] { return proxy_.connections() > connections; }))
        << "it does not reconnect without a master";
    early.expectMessages();
    EXPECT_THAT(process.output(), Not(HasSubstr("does not know this node"))) << "no master has said so";

    const std::size_t reconnected = proxy_.connections();
    master_.start();
    // It tells the new master of itself before the driver does.
    const Process user({"rostopic", "pub", "-r", "10", name_space + "/joint_command", "sensor_msgs/JointState",
                        "{name: [third_leg], position: [0]}"},
                       master_.environment());
    process.waitForOutput("knows this node again", kSafetyNet);
    process.waitForOutput("has no joint 'third_leg'", kSafetyNet);
    RateMeter(master_, topic).expectMessages();
    early.expectMessages();
    expectAnswer({"rosservice", "call", name_space + "/set_streaming", "true"}, "success: True");
    expectAnswer({"rostopic", "info", name_space + "/joint_command"},
                 "Subscribers:[^:]*" + name_space + "/aibo_driver");
    expectAnswer({"rosparam", "get", name_space + "/aibo_driver/port"}, std::to_string(proxy_.port()));
    expectAnswer({"rosparam", "get", name_space + "/aibo_driver/changed"}, "after_the_start");
    EXPECT_EQ(proxy_.connections(), reconnected);
    EXPECT_TRUE(process.isRunning());

    master_.stop();
    const std::size_t before = process.output().size();
    master_.start({"rosparam", "set", name_space + "/aibo_driver/changed", "by_another"});
    EXPECT_TRUE(
        eventually([&] { return process.output().find("knows this node again", before) != std::string::npos; }));
    expectAnswer({"rosparam", "get", name_space + "/aibo_driver/changed"}, "by_another");
    master_.stop();
    process.signal(SIGINT);
    EXPECT_EQ(process.waitForExit(kSafetyNet).value_or(-1), 0) << "it does not end without a master";
  }

 private:
  void expectAnswer(const std::vector<std::string>& command, const std::string& answer) const {
    Process(command, master_.environment()).waitForOutput(answer, kSafetyNet);
  }

  Master master_;
};

TEST_F(FaultsOfMaster, ANewMasterKnowsTheNode) {
  expectToOutliveTheMaster("/master", {AIBO_DRIVER_NODE});
}

TEST_F(FaultsOfMaster, ANewMasterKnowsTheNodelet) {
  expectToOutliveTheMaster(
      "/master", test_support::nodeletHost({"standalone", "aibo_driver/AiboDriverNodelet", "__name:=aibo_driver"}));
}

}  // namespace
