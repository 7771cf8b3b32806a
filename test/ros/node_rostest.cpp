// The nodes and nodelets as a user starts them.

#include <aibo_driver/Connection.h>
#include <gmock/gmock.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/this_node.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <signal.h>
#include <trajectory_msgs/JointTrajectory.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "node/xmlrpc_peer.h"
#include "support/proxy/recording_proxy.h"
#include "support/raw_client.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"

namespace {

using test_support::DriverProcess;
using test_support::kSafetyNet;
using test_support::nodeletHost;
using test_support::Process;
using test_support::RecordingProxy;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using CompressedListener = TopicListener<sensor_msgs::CompressedImage>;
using ImageListener = TopicListener<sensor_msgs::Image>;

TEST(Node, StartedBareIsFoundUnderAibo) {
  SimulatedRobot robot;
  CompressedListener pictures("/aibo/camera/image_raw/compressed");
  DriverProcess driver("/", robot.port());
  EXPECT_FALSE(pictures.waitForCount(1).empty());
  EXPECT_TRUE(ros::service::exists("/aibo/take_picture", false));
  driver.waitForOutput("under /aibo", kSafetyNet);
}

TEST(Node, StartedInItsNamespaceDoesNotDoubleIt) {
  SimulatedRobot robot;
  CompressedListener pictures("/aibo/camera/image_raw/compressed");
  DriverProcess driver("/aibo", robot.port());
  EXPECT_FALSE(pictures.waitForCount(1).empty());
  EXPECT_FALSE(ros::service::exists("/aibo/aibo/take_picture", false));
}

/// The topics, services and actions that the driver has according to its document. Actions are named by their goals.
std::set<std::string> documentedNames() {
  std::ifstream document(ROS_INTERFACE);
  const std::regex row("\\| (`[a-zJ][^|]*`) \\| [a-z_]+/[A-Z][^|]*\\|.*");
  const std::regex name("`([A-Za-z_/]+)`");
  std::set<std::string> names;
  std::string heading;
  std::smatch found;
  for (std::string line; std::getline(document, line);) {
    heading = line.rfind("#", 0) == 0 ? line : heading;
    if (std::regex_match(line, found, row)) {
      const std::string cell = found[1];
      for (std::sregex_iterator each(cell.begin(), cell.end(), name); each != std::sregex_iterator(); ++each) {
        names.insert(each->str(1) + (heading == "### Actions" ? "/goal" : ""));
      }
    }
  }
  names.erase("JOINT_position_controller/command");
  names.insert("head_pan_position_controller/command");
  return names;
}

/// All topics and services that the master knows.
std::set<std::string> namesOfMaster() {
  XmlRpc::XmlRpcValue answer;
  XmlRpc::XmlRpcValue state;
  EXPECT_TRUE(ros::master::execute("getSystemState", ros::this_node::getName(), answer, state, false));
  std::set<std::string> names;
  for (int kind = 0; kind < state.size(); ++kind) {  // published, subscribed, services
    for (int i = 0; i < state[kind].size(); ++i) {
      names.insert(static_cast<std::string&>(state[kind][i][0]));
    }
  }
  return names;
}

TEST(Node, HasWhatItsDocumentLists) {
  const std::set<std::string> names = documentedNames();
  EXPECT_GT(names.size(), 50U);
  DriverProcess driver("/document", 1, {}, {}, AIBO_DRIVER_NODE_WITH_ALL);
  std::vector<std::string> missing;
  const auto end = std::chrono::steady_clock::now() + kSafetyNet;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::set<std::string> known = namesOfMaster();
    missing.clear();
    std::copy_if(names.begin(), names.end(), std::back_inserter(missing),
                 [&known](const std::string& name) { return known.count("/document/" + name) == 0; });
  } while (!missing.empty() && std::chrono::steady_clock::now() < end);
  EXPECT_THAT(missing, IsEmpty());
}

/// Where a node takes connections for its topics.
int topicPortOf(const std::string& node, const std::string& topic) {
  using aibo_driver::node::XmlRpcPeer;
  std::string host;
  std::uint32_t port = 0;
  auto uri = XmlRpcPeer::master().call("lookupNode", {node});
  if (!uri || !ros::network::splitURI(*uri, host, port)) {
    throw std::runtime_error("the master does not know " + node);
  }
  XmlRpc::XmlRpcValue protocols;
  protocols[0][0] = "TCPROS";
  auto answer = XmlRpcPeer(host, port).call("requestTopic", {topic, protocols});
  return answer ? static_cast<int>((*answer)[2]) : 0;
}

/// A header of TCPROS: each field and the whole begin with their sizes.
std::string tcprosHeader(const std::vector<std::string>& fields) {
  const auto sized = [](const std::string& bytes) {
    const auto size = static_cast<std::uint32_t>(bytes.size());
    return std::string(reinterpret_cast<const char*>(&size), sizeof size) + bytes;
  };
  std::string all;
  for (const std::string& field : fields) {
    all += sized(field);
  }
  return sized(all);
}

TEST(Log, OfStrangersIsPlainAndShort) {
  TopicListener<rosgraph_msgs::Log> rosout("/rosout");
  DriverProcess driver("/logs", 1);
  ASSERT_TRUE(TopicListener<aibo_driver::Connection>("/logs/connection").waitForNext());
  const int port = topicPortOf("/logs/aibo_driver", "/logs/connection");
  const std::string wrong = tcprosHeader({"callerid=/me", "topic=/logs/connection", "type=aibo_driver/Connection",
                                          "md5sum=\x1b[2J\n[FATAL] forged" + std::string(20'000, 'x')});
  for (int i = 0; i < 3000; ++i) {
    test_support::RawClient stranger(port);
    stranger.send(wrong);
    while (const auto bytes = stranger.receive(kSafetyNet)) {
      if (bytes->empty()) {
        break;  // the driver has closed the connection
      }
    }
  }
  const std::string printed = driver.output();
  ASSERT_LT(printed.size(), 1'000'000U);
  EXPECT_EQ(printed.find("\x1b[2J"), std::string::npos);
  EXPECT_NE(printed.find("?[2J?[FATAL] forged"), std::string::npos);
  std::size_t said = 0;
  for (const auto& each : rosout.waitForCount(0)) {
    said += each->name == "/logs/aibo_driver" ? each->msg.size() : 0;
    EXPECT_THAT(each->msg, Not(HasSubstr("\x1b")));
  }
  EXPECT_LT(said, 1'000'000U);
}

TEST(LookAround, StartedBareCommandsTheDriverUnderAibo) {
  SimulatedRobot robot;
  TopicListener<trajectory_msgs::JointTrajectory> trajectories("/aibo/joint_trajectory");
  DriverProcess driver("/", robot.port());
  Process look_around({AIBO_LOOK_AROUND, "__ns:=/"});
  EXPECT_FALSE(trajectories.waitForCount(1).empty());
  look_around.waitForOutput("under /aibo", kSafetyNet);
}

TEST(Monitor, StartedBareWatchesTheDriverUnderAiboAndTheNextOne) {
  SimulatedRobot robot;
  auto driver = std::make_unique<DriverProcess>("/", robot.port());
  Process monitor({AIBO_MONITOR, "__ns:=/"});
  monitor.waitForOutput("under /aibo", kSafetyNet);
  monitor.waitForOutput("driver: [0-9.]+ % of one", kSafetyNet);
  driver.reset();
  monitor.waitForOutput("no pictures: [^\\n]*\\nno pictures: ", kSafetyNet);
  driver = std::make_unique<DriverProcess>("/", robot.port());
  monitor.waitForOutput("% of one[^%]*no pictures[^%]*driver: [0-9.]+ % of one", kSafetyNet);
}

TEST(Monitor, WithoutADriverEndsAfterItsTimeAndSaysThatNoPictureCame) {
  for (const char* time : {"_seconds:=1", "_first_picture_timeout:=1"}) {
    Process monitor({AIBO_MONITOR, "__ns:=/nobody", time});
    EXPECT_EQ(monitor.waitForExit(kSafetyNet), 1) << time;
    monitor.waitForOutput("no driver in namespace /nobody", kSafetyNet);
    monitor.waitForOutput("no picture came within 1 s", kSafetyNet);
  }
}

TEST(Monitor, RefusesTimesThatCannotBe) {
  for (const char* time : {"seconds", "first_picture_timeout"}) {
    Process monitor({AIBO_MONITOR, "__ns:=/nobody", std::string("_") + time + ":=-1"});
    monitor.waitForOutput(std::string("aibo_monitor: Parameter .*/") + time + " is -1.*; it must be a number, 0\\.\\.",
                          kSafetyNet);
    EXPECT_EQ(monitor.waitForExit(kSafetyNet), 1);
  }
}

TEST(Node, EndsWithAnErrorThatNamesABadParameterAndItsRange) {
  DriverProcess driver("/bad", 54321, {"_jpeg_quality:=101"});
  const auto status = driver.waitForExit(kSafetyNet);
  ASSERT_TRUE(status.has_value());
  EXPECT_NE(*status, 0);
  driver.waitForOutput("/bad/aibo_driver/jpeg_quality is 101; it must be a whole number, 1\\.\\.100", kSafetyNet);
}

TEST(Node, EndsWithAnErrorIfTheHostOrAColourTableIsWrong) {
  const std::pair<std::string, std::string> wrong[] = {
      {"_host:=robot:54321", "which has a port in it; host has to be 'robot' and port 54321"},
      {"_color_tables:=pink_ball no_such_table", "color_tables names the table 'no_such_table'"}};
  for (const auto& [parameter, problem] : wrong) {
    DriverProcess driver("/wrong", 54321, {parameter});
    driver.waitForOutput(problem, kSafetyNet);
    EXPECT_NE(driver.waitForExit(kSafetyNet).value_or(0), 0) << parameter;
    ros::param::del("/wrong");
  }
}

TEST(Node, EndsWithAnErrorIfTheUnderscoreOfAParameterIsMissing) {
  DriverProcess driver("/forgotten", 54321, {"host:=192.168.1.20"});
  EXPECT_EQ(driver.waitForExit(kSafetyNet), EXIT_FAILURE);
  driver.waitForOutput("a parameter has an underscore", kSafetyNet);
}

TEST(Node, WarnsIfOtherNodesCannotReachIt) {
  DriverProcess driver("/unreachable", 54321, {}, {{"ROS_IP", "192.0.2.1"}});  // an address for documents (RFC 5737)
  driver.waitForOutput("192\\.0\\.2\\.1, which is not an address of this computer.*ROS_IP", kSafetyNet);
}

TEST(Node, WarnsOfACalibrationThatDoesNotExist) {
  DriverProcess driver("/uncalibrated", 54321, {"_camera_info_url:=file:///nowhere/x.yaml"});
  driver.waitForOutput("WARN.*camera_info_url names /nowhere/x.yaml, but there is no such file", kSafetyNet);
}

TEST(Node, WarnsOfAMisspeltParameter) {
  DriverProcess driver("/misspelt", 54321, {"_jpg_quality:=50"});
  driver.waitForOutput("WARN.*The driver has no parameter /misspelt/aibo_driver/jpg_quality, and ignores it",
                       kSafetyNet);
}

TEST(Node, EndsByItselfOnCtrlCWithAndWithoutARobot) {
  SimulatedRobot robot;
  CompressedListener pictures("/ctrl_c/camera/image_raw/compressed");
  DriverProcess streaming("/ctrl_c", robot.port());
  ASSERT_FALSE(pictures.waitForCount(1).empty());
  streaming.signal(SIGINT);
  EXPECT_EQ(streaming.waitForExit(kSafetyNet), 0);

  robot.kill();
  DriverProcess alone("/ctrl_c", robot.port());
  alone.waitForOutput(std::to_string(robot.port()), kSafetyNet);
  alone.signal(SIGINT);
  EXPECT_EQ(alone.waitForExit(kSafetyNet), 0);
}

TEST(Node, TwoDriversServeTwoRobots) {
  SimulatedRobot left_robot;
  SimulatedRobot right_robot;
  RecordingProxy left_proxy(left_robot.port());
  RecordingProxy right_proxy(right_robot.port());
  CompressedListener left_pictures("/left/camera/image_raw/compressed");
  CompressedListener right_pictures("/right/camera/image_raw/compressed");
  DriverProcess left("/left", left_proxy.port(), {test_support::kByTcp});
  DriverProcess right("/right", right_proxy.port(), {"_jpeg_quality:=40", test_support::kByTcp});
  const auto left_published = left_pictures.waitForCount(10);
  const auto right_published = right_pictures.waitForCount(10);
  ASSERT_GE(left_published.size(), 10u);
  ASSERT_GE(right_published.size(), 10u);
  EXPECT_THAT(left_proxy.picturesFromRobot(), Contains(left_published.back()->data));
  EXPECT_THAT(right_proxy.picturesFromRobot(), Contains(right_published.back()->data));
  EXPECT_NE(left_published.back()->data, right_published.back()->data);
  for (const char* const warning :
       {"has no parameter", "There is no model", "commands are refused", "does not stop a walk",
        "not an address of this computer", "camera_info_url names"}) {
    EXPECT_THAT(left.output(), Not(HasSubstr(warning))) << "nothing is wrong";
  }
}

// How many nodes publish a topic, as the master sees it.
int publishersOf(const std::string& topic) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue state;
  request[0] = ros::this_node::getName();
  EXPECT_TRUE(ros::master::execute("getSystemState", request, response, state, false));
  for (int i = 0; i < state[0].size(); ++i) {
    if (state[0][i][0] == XmlRpc::XmlRpcValue(topic)) {
      return state[0][i][1].size();
    }
  }
  return 0;
}

TEST(Node, ASecondDriverInANamespaceRefusesToStartAndTheFirstKeepsItsNames) {
  SimulatedRobot robot;
  DriverProcess first("/one", robot.port());
  ASSERT_TRUE(ros::service::waitForService("/one/set_streaming", ros::Duration(kSafetyNet.count())));
  DriverProcess second("/one", robot.port(), {"__name:=second"});
  EXPECT_EQ(second.waitForExit(kSafetyNet), 1);
  second.waitForOutput("a driver in the namespace /one already: the node /one/aibo_driver", kSafetyNet);
  Process nodelet(nodeletHost({"standalone", "aibo_driver/AiboDriverNodelet", "__ns:=/one", "__name:=third"}));
  nodelet.waitForOutput("a driver in the namespace /one already: the node /one/aibo_driver", kSafetyNet);
  EXPECT_TRUE(ros::service::exists("/one/stop", false));
  EXPECT_EQ(publishersOf("/one/connection"), 1);

  first.signal(SIGSTOP);
  DriverProcess impatient("/one", robot.port(), {"__name:=second"});
  EXPECT_EQ(impatient.waitForExit(kSafetyNet), 1);
  impatient.waitForOutput("It does not answer. If 127.0.0.1 is switched off.*rosnode cleanup", kSafetyNet);
  first.kill();  // the master still knows it
  DriverProcess next("/one", robot.port(), {"__name:=second"});
  CompressedListener pictures("/one/camera/image_raw/compressed");
  EXPECT_FALSE(pictures.waitForCount(1).empty()) << next.output();
  DriverProcess after("/one", robot.port(), {"__name:=third"});
  EXPECT_EQ(after.waitForExit(kSafetyNet), 1);
  after.waitForOutput("a driver in the namespace /one already: the node /one/second", kSafetyNet);
}

// As a node does that had the same names and has ended.
TEST(Node, RegistersAServiceAndATopicAgainThatWereTakenFromIt) {
  const auto tell_master = [](const char* method, const std::string& name, const std::string& uri) {
    XmlRpc::XmlRpcValue request;
    XmlRpc::XmlRpcValue response;
    XmlRpc::XmlRpcValue answer;
    request[0] = std::string("/taken/aibo_driver");
    request[1] = name;
    request[2] = uri;
    EXPECT_TRUE(ros::master::execute(method, request, response, answer, false));
    EXPECT_EQ(static_cast<int>(answer), 1) << name << " was not registered";
  };
  const auto ask_master = [](const char* method, const std::string& name) {
    XmlRpc::XmlRpcValue request;
    XmlRpc::XmlRpcValue response;
    XmlRpc::XmlRpcValue answer;
    request[0] = ros::this_node::getName();
    request[1] = name;
    EXPECT_TRUE(ros::master::execute(method, request, response, answer, false));
    return static_cast<std::string>(answer);
  };
  SimulatedRobot robot;
  DriverProcess driver("/taken", robot.port());
  ASSERT_TRUE(ros::service::waitForService("/taken/stop", ros::Duration(kSafetyNet.count())));
  tell_master("unregisterPublisher", "/taken/connection", ask_master("lookupNode", "/taken/aibo_driver"));
  driver.waitForOutput("has lost 1 topics and services of this node, such as /taken/connection", kSafetyNet);
  tell_master("unregisterService", "/taken/stop", ask_master("lookupService", "/taken/stop"));
  driver.waitForOutput("has lost 1 topics and services of this node, such as /taken/stop", kSafetyNet);
  EXPECT_TRUE(ros::service::waitForService("/taken/stop", ros::Duration(kSafetyNet.count())));
  EXPECT_EQ(publishersOf("/taken/connection"), 1);
}

Process startNodelet(const std::string& type, const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"standalone", type};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return Process(nodeletHost(all));
}

TEST(Nodelet, PublishesThePictures) {
  SimulatedRobot robot;
  CompressedListener pictures("/nodelet/camera/image_raw/compressed");
  ImageListener images("/nodelet/camera/image_raw");
  const Process nodelet =
      startNodelet("aibo_driver/AiboDriverNodelet", {"__ns:=/nodelet", "_port:=" + std::to_string(robot.port())});
  EXPECT_FALSE(pictures.waitForCount(1).empty()) << nodelet.output();
  EXPECT_FALSE(images.waitForCount(1).empty()) << nodelet.output();
}

TEST(Nodelet, StartedInTheRootNamespaceIsFoundUnderAibo) {
  SimulatedRobot robot;
  CompressedListener pictures("/aibo/camera/image_raw/compressed");
  {
    const Process alone =
        startNodelet("aibo_driver/AiboDriverNodelet", {"__ns:=/", "_port:=" + std::to_string(robot.port())});
    EXPECT_FALSE(pictures.waitForCount(1).empty()) << alone.output();
  }
  pictures.clear();
  const Process manager(nodeletHost({"manager", "__ns:=/", "__name:=root_manager"}));
  const Process loaded(nodeletHost({"load", "aibo_driver/AiboDriverNodelet", "root_manager", "__ns:=/",
                                    "__name:=aibo_driver", "_port:=" + std::to_string(robot.port())}));
  EXPECT_FALSE(pictures.waitForCount(1).empty()) << manager.output() << loaded.output();
  EXPECT_TRUE(ros::service::exists("/aibo/take_picture", false));
}

TEST(Nodelet, WithABadParameterIsNotLoadedAndSaysWhy) {
  Process nodelet = startNodelet("aibo_driver/AiboDriverNodelet", {"__ns:=/bad_nodelet", "_port:=0"});
  nodelet.waitForOutput("port is 0; it must be a whole number, 1\\.\\.65535", kSafetyNet);
}

// The manager stays when one of its nodelets is unloaded. From then on nothing of the nodelet may be called: neither by
// the manager's other threads, which report subscribers that come and go, nor by the nodelet's own threads.
class NodeletManager {
 public:
  NodeletManager() : process_(nodeletHost({"manager", "__ns:=/unload", "__name:=manager"})) {
    EXPECT_TRUE(ros::service::waitForService("/unload/manager/load_nodelet", ros::Duration(kSafetyNet.count())));
  }

  static bool load(const std::string& name, const std::string& type) {
    nodelet::NodeletLoad load;
    load.request.name = name;
    load.request.type = type;
    return ros::service::call("/unload/manager/load_nodelet", load) && load.response.success;
  }

  void waitForOutput(const std::string& pattern) { process_.waitForOutput(pattern, kSafetyNet); }

  void loadAndUnload(const std::string& name, const std::string& type, const std::string& image_topic, int rounds) {
    for (int round = 0; round < rounds; ++round) {
      ASSERT_TRUE(load(name, type)) << output(round);
      const ImageListener first(image_topic);
      const ImageListener second(image_topic);
      if (round % 2 == 0) {
        ImageListener waiting(image_topic);
        ASSERT_FALSE(waiting.waitForCount(1).empty()) << output(round);
      }
      nodelet::NodeletUnload unload;
      unload.request.name = name;
      ASSERT_TRUE(ros::service::call("/unload/manager/unload_nodelet", unload) && unload.response.success)
          << output(round);
      ASSERT_TRUE(process_.isRunning()) << output(round);
    }
  }

 private:
  std::string output(int round) const { return "round " + std::to_string(round) + ": " + process_.output(); }

  Process process_;
};

TEST(Nodelet, IsUnloadedWhileSubscribersComeAndTheManagerGoesOn) {
  SimulatedRobot robot;
  ros::param::set("/unload/aibo_driver/port", robot.port());
  ros::param::set("/unload/aibo_driver/stream_on_demand", true);
  NodeletManager().loadAndUnload("/unload/aibo_driver", "aibo_driver/AiboDriverNodelet", "/unload/camera/image_raw",
                                 10);
}

TEST(Nodelet, ASecondDriverInTheNamespaceOfAnotherOfItsManagerIsNotLoaded) {
  SimulatedRobot robot;
  ros::param::set("/unload/aibo_driver/port", robot.port());
  NodeletManager manager;
  EXPECT_TRUE(NodeletManager::load("/unload/aibo_driver", "aibo_driver/AiboDriverNodelet"));
  EXPECT_FALSE(NodeletManager::load("/unload/second", "aibo_driver/AiboDriverNodelet"));
  manager.waitForOutput("namespace /unload already: another nodelet of /unload/manager");
}

// A picture of a robot, published again as if from a bag.
class Decoder : public ::testing::Test {
 protected:
  Decoder() {
    CompressedListener pictures("/source/camera/image_raw/compressed");
    SimulatedRobot robot;
    DriverProcess driver("/source", robot.port());
    const auto received = pictures.waitForCount(1);
    if (!received.empty()) {
      picture_ = *received.front();
    }
    picture_.header.stamp = ros::Time(1234, 5678);
    publisher_ = ros::NodeHandle().advertise<sensor_msgs::CompressedImage>("/bag/camera/image_raw/compressed", 10);
  }

  // Publishes until an image comes, as a bag would.
  sensor_msgs::ImageConstPtr publishUntilDecoded(ImageListener& images) {
    for (int i = 0; i < 300; ++i) {
      publisher_.publish(picture_);
      const auto decoded = images.waitForCount(1, std::chrono::milliseconds(100));
      if (!decoded.empty()) {
        return decoded.front();
      }
    }
    return nullptr;
  }

  bool waitForSubscribers(std::uint32_t count) const {
    const auto end = std::chrono::steady_clock::now() + kSafetyNet;
    while (publisher_.getNumSubscribers() != count && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return publisher_.getNumSubscribers() == count;
  }

  void decodesWhileItHasSubscribers() {
    auto images = std::make_unique<ImageListener>("/bag/camera/image_raw");
    const sensor_msgs::ImageConstPtr image = publishUntilDecoded(*images);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->header.stamp, picture_.header.stamp);
    EXPECT_EQ(image->header.frame_id, picture_.header.frame_id);
    EXPECT_EQ(image->encoding, "bgr8");
    EXPECT_EQ(image->width, 208u);
    EXPECT_TRUE(waitForSubscribers(1));
    images.reset();
    EXPECT_TRUE(waitForSubscribers(0)) << "still subscribed although image_raw has no subscriber";
  }

  sensor_msgs::CompressedImage picture_;
  ros::Publisher publisher_;
};

TEST_F(Decoder, NodeSubscribesOnlyWhileItHasSubscribersAndKeepsTheHeader) {
  Process decoder({AIBO_IMAGE_DECODER, "__ns:=/bag/camera"});
  decoder.waitForOutput("/bag/camera/image_raw/compressed", kSafetyNet);
  EXPECT_EQ(publisher_.getNumSubscribers(), 0u);
  decodesWhileItHasSubscribers();
  decodesWhileItHasSubscribers();
  EXPECT_TRUE(decoder.isRunning());
}

TEST_F(Decoder, NodeletDoesTheSame) {
  const Process decoder = startNodelet("aibo_driver/ImageDecoderNodelet", {"__ns:=/bag/camera"});
  decodesWhileItHasSubscribers();
}

TEST_F(Decoder, NodeStartedBareDecodesTheCameraUnderAibo) {
  Process decoder({AIBO_IMAGE_DECODER, "__ns:=/"});
  publisher_ = ros::NodeHandle().advertise<sensor_msgs::CompressedImage>("/aibo/camera/image_raw/compressed", 10);
  ImageListener images("/aibo/camera/image_raw");
  EXPECT_TRUE(publishUntilDecoded(images));
  decoder.waitForOutput("under /aibo/camera", kSafetyNet);
}

TEST_F(Decoder, NodeletIsUnloadedWhileItDecodesAndTheManagerGoesOn) {
  ros::Timer bag = ros::NodeHandle().createTimer(ros::Duration(0.001),
                                                 [this](const ros::TimerEvent&) { publisher_.publish(picture_); });
  NodeletManager().loadAndUnload("/bag/camera/decoder", "aibo_driver/ImageDecoderNodelet", "/bag/camera/image_raw", 5);
}

TEST_F(Decoder, NodeSurvivesDamagedPictures) {
  Process decoder({AIBO_IMAGE_DECODER, "__ns:=/bag/camera"});
  ImageListener images("/bag/camera/image_raw");
  ASSERT_TRUE(publishUntilDecoded(images));
  const std::vector<std::uint8_t> good = picture_.data;
  picture_.data.resize(good.size() / 2);
  publisher_.publish(picture_);
  decoder.waitForOutput("was not decoded", kSafetyNet);
  picture_.data.clear();
  publisher_.publish(picture_);
  picture_.data = good;
  images.clear();
  EXPECT_TRUE(publishUntilDecoded(images));
  EXPECT_TRUE(decoder.isRunning());
}

}  // namespace
