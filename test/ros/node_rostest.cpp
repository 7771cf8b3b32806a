// The nodes and nodelets as a user starts them, and the names, types and latching of docs/ros_interface.md.

#include <aibo_driver/Leds.h>
#include <geometry_msgs/PointStamped.h>
#include <gmock/gmock.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <signal.h>
#include <topic_tools/shape_shifter.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <future>
#include <regex>

#include "node/xmlrpc_peer.h"
#include "ros/driver_user.h"
#include "support/memory_stick.h"
#include "support/raw_client.h"
#include "support/test_pictures.h"

namespace {

using aibo_driver::Connection;
using test_support::DriverProcess;
using test_support::DriverUser;
using test_support::kSafetyNet;
using test_support::nodeletHost;
using test_support::Process;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::HasSubstr;
using XmlRpc::XmlRpcValue;

using CompressedListener = TopicListener<sensor_msgs::CompressedImage>;
using ImageListener = TopicListener<sensor_msgs::Image>;

XmlRpcValue askMaster(const char* method, const std::vector<std::string>& arguments) {
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    request[static_cast<int>(i) + 1] = arguments[i];
  }
  XmlRpcValue response;
  XmlRpcValue answer;
  EXPECT_TRUE(ros::master::execute(method, request, response, answer, false)) << method;
  return answer;
}

std::string textFromMaster(const char* method, const std::string& name) {
  XmlRpcValue answer = askMaster(method, {name});
  return static_cast<std::string&>(answer);
}

enum Role { kPublishes, kSubscribes, kServes };

/// The nodes that the master knows in this role.
std::vector<std::string> nodesOf(Role role, const std::string& name) {
  XmlRpcValue all = askMaster("getSystemState", {})[role];
  std::vector<std::string> nodes;
  for (int i = 0; i < all.size(); ++i) {
    for (int j = 0; all[i][0] == XmlRpcValue(name) && j < all[i][1].size(); ++j) {
      nodes.push_back(static_cast<std::string&>(all[i][1][j]));
    }
  }
  return nodes;
}

struct Row {
  std::string name;
  std::string type;
  bool is_latched;
};

/// The rows of a table of the document, such as | `range/near`, `range/far` | sensor_msgs/Range | ... and
/// | `streaming` | std_msgs/Bool, latched | ...
std::vector<Row> documented(const std::string& heading) {
  std::ifstream document(ROS_INTERFACE);
  const std::regex row(R"(\| (`[^|]*`) \| (\w+/\w+)(, latched|, ...)? \|.*)");
  const std::regex name("`([A-Za-z_/]+)`");
  std::vector<Row> rows;
  std::string line;
  while (std::getline(document, line) && line != heading) {
  }
  while (std::getline(document, line) && line.rfind("#", 0) != 0) {
    std::smatch found;
    if (std::regex_match(line, found, row)) {
      const std::string names = std::regex_replace(found[1].str(), std::regex("JOINT"), "head_pan");
      for (std::sregex_iterator each(names.begin(), names.end(), name); each != std::sregex_iterator(); ++each) {
        rows.push_back({each->str(1), found[2], found[3] == ", latched"});
      }
    }
  }
  EXPECT_FALSE(rows.empty()) << heading;
  return rows;
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

/// The header that a node answers.
std::string answerTo(const std::string& header, int port) {
  test_support::RawClient client(port);
  client.send(header);
  const auto size = client.read(4, kSafetyNet);
  const auto answer = size.size() < 4 ? size : client.read(size[0] + 256U * size[1], kSafetyNet);
  return {answer.begin(), answer.end()};
}

/// What a new subscriber learns about a topic with its first message.
std::map<std::string, std::string> firstHeaderOf(const std::string& topic) {
  using Event = ros::MessageEvent<const topic_tools::ShapeShifter>;
  const auto header = std::make_shared<std::promise<ros::M_string>>();
  const auto first = std::make_shared<std::once_flag>();
  const boost::function<void(const Event&)> read = [=](const Event& message) {
    std::call_once(*first, [&] { header->set_value(message.getConnectionHeader()); });
  };
  const ros::Subscriber subscriber = ros::NodeHandle().subscribe<const Event&>(topic, 1, read);
  std::future<ros::M_string> answer = header->get_future();
  return answer.wait_for(kSafetyNet) == std::future_status::ready ? answer.get() : ros::M_string();
}

class InterfaceTest : public ::testing::Test {
 protected:
  static std::string absolute(const std::string& name) { return name.front() == '/' ? name : "/document/" + name; }

  std::string typeOf(const std::string& topic) {
    XmlRpcValue types = askMaster("getTopicTypes", {});
    for (int i = 0; i < types.size(); ++i) {
      if (types[i][0] == XmlRpcValue(topic)) {
        return static_cast<std::string&>(types[i][1]);
      }
    }
    return "";
  }

  const test_support::MemoryStick stick_{"ALLOW_MICROPHONE=yes\n"};
  const DriverUser user_{
      "/document", {"_stream_on_start:=true"}, {"--memory-stick", stick_.path()}, AIBO_DRIVER_NODE_WITH_ALL};
};

// Nobody has listened to most topics before, so each listener also is the first one.
TEST_F(InterfaceTest, PublishedTopicsHaveTheirTypesAndAMessageForWhoeverComes) {
  for (const Row& row : documented("### Published topics")) {
    auto header = firstHeaderOf(absolute(row.name));
    EXPECT_EQ(header["type"], row.type) << row.name;
    EXPECT_TRUE(!row.is_latched || header["latching"] == "1") << row.name;
  }
}

TEST_F(InterfaceTest, SubscribedTopicsAndActionsHaveTheirTypes) {
  for (const Row& row : documented("### Subscribed topics")) {
    EXPECT_TRUE(DriverUser::becomesTrue([&] { return typeOf(absolute(row.name)) == row.type; })) << row.name;
    EXPECT_THAT(nodesOf(kSubscribes, absolute(row.name)), ::testing::SizeIs(1)) << row.name;
  }
  for (const Row& row : documented("### Actions")) {
    EXPECT_TRUE(DriverUser::becomesTrue([&] {
      return typeOf(absolute(row.name) + "/goal") == row.type + "ActionGoal";
    })) << row.name;
  }
}

TEST_F(InterfaceTest, ServicesHaveTheirTypes) {
  for (const Row& row : documented("### Services")) {
    const std::string service = absolute(row.name);
    EXPECT_TRUE(ros::service::waitForService(service, ros::Duration(kSafetyNet.count()))) << service;
    std::string host;
    std::uint32_t port = 0;
    EXPECT_TRUE(ros::network::splitURI(textFromMaster("lookupService", service), host, port)) << service;
    std::string type = row.type;
    if (type == "aibo_driver/ListPictures" && row.name != "list_pictures") {  // its row has three services
      type = row.name == "fetch_picture" ? "aibo_driver/FetchPicture" : "aibo_driver/DeletePicture";
    }
    EXPECT_THAT(
        answerTo(tcprosHeader({"callerid=/me", "md5sum=*", "probe=1", "service=" + service}), static_cast<int>(port)),
        HasSubstr("type=" + type))
        << service;
  }
}

// Each program in the root namespace, the node that it becomes, and a name that this node then has.
TEST(Programs, StartedInTheRootNamespaceUseTheDriverUnderAibo) {
  const std::tuple<const char*, const char*, Role, const char*> rows[] = {
      {AIBO_DRIVER_NODE, "/aibo_driver", kServes, "/aibo/take_picture"},
      {AIBO_IMAGE_DECODER, "/aibo_image_decoder", kPublishes, "/aibo/camera/image_raw"},
      {AIBO_MONITOR, "/aibo_monitor", kSubscribes, "/aibo/camera/image_raw/compressed"},
      {AIBO_FOLLOW_BALL, "/aibo_follow_ball", kPublishes, "/aibo/look_at"},
      {AIBO_LOOK_AT, "/aibo_look_at", kSubscribes, "/aibo/look_at"},
      {AIBO_LIGHTS, "/aibo_lights", kPublishes, "/aibo/lights"},
      {AIBO_ROOM, "/aibo_room", kPublishes, "/aibo/room"},
      {AIBO_TELEOP_JOY, "/aibo_teleop_joy", kPublishes, "/aibo/cmd_vel"}};
  for (const auto& [path, node, role, name] : rows) {
    const Process program({path, "__ns:=/", "_port:=1"});
    EXPECT_TRUE(DriverUser::becomesTrue([&, role = role, name = name, node = std::string(node)] {
      const std::vector<std::string> nodes = nodesOf(role, name);
      return std::any_of(nodes.begin(), nodes.end(), [&](const std::string& each) { return each.rfind(node, 0) == 0; });
    })) << program.output();
  }
}

TEST(Programs, LatchWhatRvizShows) {
  const std::pair<const char*, const char*> rows[] = {
      {AIBO_LOOK_AT, "look_at_floor"}, {AIBO_LOOK_AT, "look_at_result"}, {AIBO_LIGHTS, "lights"}, {AIBO_ROOM, "room"}};
  test_support::TopicPublishers user("/latches");
  for (const auto& [path, topic] : rows) {
    const Process program({path, "__ns:=/latches"});
    if (topic == std::string("look_at_result")) {
      user.publish("look_at", geometry_msgs::PointStamped());
    }
    EXPECT_EQ(firstHeaderOf(std::string("/latches/") + topic)["latching"], "1") << topic;
  }
}

TEST(Programs, HaveAHelpAndRefuseOtherArguments) {
  for (const char* path : {AIBO_FOLLOW_BALL, AIBO_IMAGE_DECODER, AIBO_LIGHTS, AIBO_LOOK_AT, AIBO_MONITOR, AIBO_PLAYBACK,
                           AIBO_ROOM, AIBO_TELEOP_JOY, AIBO_TELEOP_KEYBOARD}) {
    for (const auto& [argument, status, text] : {std::tuple("-h", 0, "aibo_driver"),
                                                 {"--help", 0, "aibo_driver"},
                                                 {"--no", 1, "there is no argument '--no'"}}) {
      Process program({path, argument});
      EXPECT_EQ(program.waitForExit(kSafetyNet), status) << path << " " << argument;
      EXPECT_THAT(program.output(), HasSubstr(text)) << path;
    }
  }
}

TEST(Node, EndsWithAnErrorThatSaysWhatIsWrongWithAParameter) {
  const std::pair<const char*, const char*> rows[] = {
      {"_jpeg_quality:=101", "/jpeg_quality is 101; it must be a whole number, 1\\.\\.100"},
      {"_color_tables:=pink_ball no_such_table", "color_tables names the table 'no_such_table'"},
      {"host:=192.168.1.20", "a parameter has an underscore"},
  };
  for (const auto& [parameter, problem] : rows) {
    DriverProcess driver("/wrong", 54321, {parameter});
    driver.waitForOutput(problem);
    EXPECT_EQ(driver.waitForExit(kSafetyNet), EXIT_FAILURE) << parameter;
    ros::param::del("/wrong");
  }
}

TEST(Node, WarnsOfWhatMayBeAMistake) {
  DriverProcess driver("/doubtful", 54321, {"_camera_info_url:=file:///nowhere/x.yaml", "_jpg_quality:=50"},
                       {{"ROS_IP", "192.0.2.1"}});  // an address for documents (RFC 5737)
  for (const char* warning : {"WARN.*camera_info_url names /nowhere/x.yaml, but there is no such file",
                              "WARN.*The driver has no parameter /doubtful/aibo_driver/jpg_quality, and ignores it",
                              "192\\.0\\.2\\.1, which is not an address of this computer.*ROS_IP"}) {
    EXPECT_NO_THROW(driver.waitForOutput(warning)) << warning;
  }
}

TEST(Log, HasALoggerForEachPart) {
  DriverProcess driver("/loggers", 1, {}, {{"ROSCONSOLE_FORMAT", "${logger}: ${message}"}});
  test_support::TopicPublishers user("/loggers");
  aibo_driver::Leds leds;
  leds.names = {"nose"};
  leds.intensities = {1};
  user.publish("leds", leds);
  sensor_msgs::JointState command;
  command.name = {"head_pan"};
  command.position = {0.1};
  user.publish("joint_command", command);
  for (const std::string logger : {"client", "camera", "expression", "joints"}) {
    EXPECT_NO_THROW(driver.waitForOutput("ros\\.aibo_driver\\." + logger + ": ")) << logger;
  }
}

TEST(Log, OfStrangersIsPlainAndShort) {
  TopicListener<rosgraph_msgs::Log> rosout("/rosout");
  DriverProcess driver("/logs", 1);
  ASSERT_TRUE(TopicListener<Connection>("/logs/connection").waitForFirst());
  std::string host;
  std::uint32_t port = 0;
  ASSERT_TRUE(ros::network::splitURI(textFromMaster("lookupNode", "/logs/aibo_driver"), host, port));
  XmlRpcValue protocols;
  protocols[0][0] = "TCPROS";
  auto address = aibo_driver::node::XmlRpcPeer(host, port).call("requestTopic", {"/logs/connection", protocols});
  ASSERT_TRUE(address);
  const std::string wrong = tcprosHeader({"callerid=/me", "topic=/logs/connection", "type=aibo_driver/Connection",
                                          "md5sum=\x1b[2J\n[FATAL] forged" + std::string(20'000, 'x')});
  for (int i = 0; i < 3000; ++i) {
    answerTo(wrong, static_cast<int>((*address)[2]));
  }
  const std::string printed = driver.output();
  ASSERT_LT(printed.size(), 1'000'000U);
  EXPECT_THAT(printed, testing::AllOf(testing::Not(HasSubstr("\x1b[2J")), HasSubstr("?[2J?[FATAL] forged")));
  std::size_t said = 0;
  for (const auto& each : rosout.waitForCount(0)) {
    said += each->name == "/logs/aibo_driver" ? each->msg.size() : 0;
    EXPECT_THAT(each->msg, testing::Not(HasSubstr("\x1b")));
  }
  EXPECT_LT(said, 1'000'000U);
}

TEST(Node, ASecondDriverInANamespaceRefusesToStartAndNamesTheFirst) {
  SimulatedRobot robot;
  DriverProcess first("/one", robot.port());
  ASSERT_TRUE(ros::service::waitForService("/one/set_streaming", ros::Duration(kSafetyNet.count())));
  const auto is_refused = [&robot](const char* name, const std::string& reason) {
    DriverProcess driver("/one", robot.port(), {std::string("__name:=") + name});
    EXPECT_EQ(driver.waitForExit(kSafetyNet), 1);
    EXPECT_NO_THROW(driver.waitForOutput(reason));
  };
  const std::string taken = "a driver in the namespace /one already: the node /one/";
  is_refused("second", taken + "aibo_driver");
  Process nodelet(nodeletHost({"standalone", "aibo_driver/AiboDriverNodelet", "__ns:=/one", "__name:=third"}));
  EXPECT_NO_THROW(nodelet.waitForOutput(taken + "aibo_driver"));
  EXPECT_THAT(nodesOf(kPublishes, "/one/connection"), ::testing::ElementsAre("/one/aibo_driver"));

  first.signal(SIGSTOP);
  is_refused("second", "It does not answer. If .* is switched off.*rosnode cleanup");
  first.kill();  // the master still knows it
  const DriverProcess next("/one", robot.port(), {"__name:=second"});
  EXPECT_FALSE(CompressedListener("/one/camera/image_raw/compressed").waitForCount(1).empty()) << next.output();
  is_refused("third", taken + "second");
}

TEST(Node, StartsWhereAnotherNodeHasTheAddressOfADriverThatWasKilled) {
  const auto master = aibo_driver::node::XmlRpcPeer::master();
  const std::string topic = "/reused/connection";
  const std::string address = ros::XMLRPCManager::instance()->getServerURI();
  ASSERT_TRUE(master.call("registerPublisher", {topic, "aibo_driver/Connection", address}));
  SimulatedRobot robot;
  const DriverProcess driver("/reused", robot.port());
  EXPECT_FALSE(CompressedListener("/reused/camera/image_raw/compressed").waitForCount(1).empty()) << driver.output();
  EXPECT_TRUE(master.call("unregisterPublisher", {topic, address}));
}

TEST(Nodelet, WithABadParameterIsNotLoadedAndSaysWhy) {
  Process nodelet(nodeletHost({"standalone", "aibo_driver/AiboDriverNodelet", "__ns:=/bad_nodelet", "_port:=0"}));
  EXPECT_NO_THROW(nodelet.waitForOutput("port is 0; it must be a whole number, 1\\.\\.65535"));
}

// From when a nodelet is unloaded, nothing of it may be called: neither by the manager's other threads, which report
// subscribers that come and go, nor by the nodelet's own threads.
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

  void waitForOutput(const std::string& pattern) { process_.waitForOutput(pattern); }

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

// A picture, published as if from a bag.
class Decoder : public ::testing::Test {
 protected:
  Decoder() {
    picture_.data = test_pictures::make();
    picture_.header.frame_id = "eye";
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
    return DriverUser::becomesTrue([=] { return publisher_.getNumSubscribers() == count; });
  }

  sensor_msgs::CompressedImage picture_;
  ros::Publisher publisher_;
};

TEST_F(Decoder, SubscribesOnlyWhileItHasSubscribersAndKeepsTheHeader) {
  Process decoder({AIBO_IMAGE_DECODER, "__ns:=/bag/camera"});
  decoder.waitForOutput("/bag/camera/image_raw/compressed");
  for (int time = 0; time < 2; ++time) {
    EXPECT_TRUE(waitForSubscribers(0)) << "nobody wants images";
    ImageListener images("/bag/camera/image_raw");
    const sensor_msgs::ImageConstPtr image = publishUntilDecoded(images);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->header.stamp, picture_.header.stamp);
    EXPECT_EQ(image->header.frame_id, "eye");
    EXPECT_EQ(image->width, 208u);
  }
}

TEST_F(Decoder, NodeletIsUnloadedWhileItDecodesAndTheManagerGoesOn) {
  ros::Timer bag = ros::NodeHandle().createTimer(ros::Duration(0.001),
                                                 [this](const ros::TimerEvent&) { publisher_.publish(picture_); });
  NodeletManager().loadAndUnload("/bag/camera/decoder", "aibo_driver/ImageDecoderNodelet", "/bag/camera/image_raw", 5);
}

}  // namespace
