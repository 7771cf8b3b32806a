// aibo_web, which shows and steers the robot in browsers. The driver and its simulated robot are real.

#include <aibo_driver/RobotState.h>
#include <geometry_msgs/Twist.h>
#include <ros/master.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <condition_variable>
#include <csignal>
#include <deque>

#include "ros/driver_user.h"
#include "support/proxy/fault_proxy.h"
#include "support/resources.h"

namespace {

namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using boost::asio::ip::tcp;
using geometry_msgs::Twist;
using std::chrono::milliseconds;
using test_support::DriverUser;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::TopicListener;
using testing::HasSubstr;

constexpr const char* kConnected = R"("is_connected": true)";

tcp::socket connectTo(boost::asio::io_context& context, unsigned short port) {
  tcp::socket socket(context);
  socket.connect({boost::asio::ip::make_address("127.0.0.1"), port});
  return socket;
}

// aibo_web at a free port.
class Web {
 public:
  explicit Web(const std::string& name_space, const std::vector<std::string>& parameters = {},
               const std::map<std::string, std::string>& environment = {})
      : process_(command(name_space, parameters), environment) {
    const auto groups = process_.waitForOutput("page is at http://(\\S+):([0-9]+)/(\\?code=(\\S+))?");
    port_ = static_cast<unsigned short>(std::stoi(groups.at(2)));
    host_ = groups.at(1) + ":" + groups.at(2);
    code_ = groups.at(4);
  }

  unsigned short port() const { return port_; }
  const std::string& host() const { return host_; }
  const std::string& code() const { return code_; }
  Process& process() { return process_; }

 private:
  static std::vector<std::string> command(const std::string& name_space, const std::vector<std::string>& parameters) {
    std::vector<std::string> command{AIBO_WEB, "__ns:=" + name_space, "__name:=web", "_web_port:=0"};
    command.insert(command.end(), parameters.begin(), parameters.end());
    return command;
  }

  Process process_;
  unsigned short port_ = 0;
  std::string host_;  // with its port
  std::string code_;
};

// A page that is open in a browser, without the browser.
class BrowserPage {
 public:
  // @throw boost::system::system_error it is refused
  explicit BrowserPage(const Web& web, const std::string& origin = "", const std::string& cookie = "")
      : socket_(connectTo(context_, web.port())) {
    socket_.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
      request.set(http::field::origin, origin.empty() ? "http://" + web.host() : origin);
      request.set(http::field::cookie, cookie);
    }));
    socket_.handshake(web.host(), "/ws");
    read();
    thread_ = std::thread([this] { context_.run(); });
  }

  ~BrowserPage() {
    leave();
    thread_.join();
  }

  BrowserPage(const BrowserPage&) = delete;
  BrowserPage& operator=(const BrowserPage&) = delete;

  void leave() {
    boost::asio::post(context_, [this] {
      boost::system::error_code ignored;
      socket_.next_layer().shutdown(tcp::socket::shutdown_both, ignored);
    });
  }

  // Also after the server has closed it.
  void send(const std::string& message, bool is_text = true) {
    boost::asio::post(context_, [this, message, is_text] {
      waiting_.emplace_back(message, is_text);
      if (waiting_.size() == 1) {
        write();
      }
    });
  }

  // @param more further members, such as R"("forward": 1)"
  // @param age how long it was on its way
  void order(const std::string& what, const std::string& more = "", milliseconds age = milliseconds(0)) {
    const std::chrono::duration<double, std::milli> given = (std::chrono::steady_clock::now() - age).time_since_epoch();
    send(R"({"do": ")" + what + R"(", "at": )" + std::to_string(given.count()) + (more.empty() ? "" : ", " + more) +
         "}");
  }

  void steer(double forward) { order("steer", R"("left": 0, "turn": 0, "forward": )" + std::to_string(forward)); }

  // It has shown the picture.
  void showPicture() { send("", false); }

  // A text that has come, or comes now.
  bool hears(const std::string& part) {
    return waitFor([&] {
      return std::any_of(texts_.begin(), texts_.end(),
                         [&](const std::string& text) { return text.find(part) != std::string::npos; });
    });
  }

  bool isClosed() {
    return waitFor([&] { return is_closed_; });
  }

  // @return the newest one, when there are this many
  std::string picture(std::size_t count) {
    return waitFor([&] { return pictures_.size() >= count; }) ? pictures_.back() : "";
  }

  std::size_t pictures() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return pictures_.size();
  }

  void forget() {
    const std::lock_guard<std::mutex> lock(mutex_);
    texts_.clear();
  }

 private:
  template <typename Condition>
  bool waitFor(Condition condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, kSafetyNet, condition);
  }

  void write() {
    const auto& [message, is_text] = waiting_.front();
    socket_.text(is_text);
    socket_.async_write(boost::asio::buffer(message), [this](boost::system::error_code error, std::size_t) {
      waiting_.pop_front();
      if (!error && !waiting_.empty()) {
        write();
      }
    });
  }

  void read() {
    socket_.async_read(buffer_, [this](boost::system::error_code error, std::size_t) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (error) {
        is_closed_ = true;
      } else {
        (socket_.got_text() ? texts_ : pictures_).push_back(beast::buffers_to_string(buffer_.data()));
        buffer_.clear();
        read();
      }
      changed_.notify_all();
    });
  }

  boost::asio::io_context context_;  // only its thread uses the next three
  websocket::stream<tcp::socket> socket_;
  beast::flat_buffer buffer_;
  std::deque<std::pair<std::string, bool>> waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> texts_;
  std::vector<std::string> pictures_;
  bool is_closed_ = false;
  std::thread thread_;
};

bool goes(const Twist& twist) {
  return twist.linear.x != 0 || twist.linear.y != 0 || twist.angular.z != 0;
}

bool stands(const Twist& twist) {
  return !goes(twist);
}

// One driver for all tests, because each takes some time to start.
class WebTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { user_ = new DriverUser("/web"); }
  static void TearDownTestSuite() {
    delete user_;
    user_ = nullptr;
  }

  void SetUp() override {
    user_->call<std_srvs::Trigger>("release");
    user_->call<std_srvs::Trigger>("stand");
  }

  // Repeats it, as a finger does that stays on the pad, until something happens.
  static bool holds(BrowserPage& page, const std::function<bool()>& happens) {
    return DriverUser::becomesTrue([&] {
      page.steer(0.5);
      std::this_thread::sleep_for(milliseconds(50));
      return happens();
    });
  }

  static DriverUser* user_;
};

DriverUser* WebTest::user_ = nullptr;

TEST_F(WebTest, ShowsThePicturesByteForByteAndWaitsUntilEachIsShown) {
  TopicListener<sensor_msgs::CompressedImage> camera("/web/camera/image_raw/compressed");
  Web web("/web");
  BrowserPage fast(web);
  BrowserPage slow(web);
  for (std::size_t i = 1; i <= 5; ++i) {
    const std::string shown = fast.picture(i);
    EXPECT_TRUE(camera.waitFor([&](const sensor_msgs::CompressedImage& each) {
      return std::string(each.data.begin(), each.data.end()) == shown;
    })) << i;
    fast.showPicture();
  }
  const std::string first = slow.picture(1);
  EXPECT_EQ(slow.pictures(), 1u);
  const std::string newest = fast.picture(6);
  slow.showPicture();
  EXPECT_NE(slow.picture(2), first);
  EXPECT_NE(newest, "");
}

TEST_F(WebTest, TakesPicturesOnlyWhileAPageIsOpen) {
  Web web("/web_unseen");
  ros::Publisher pictures =
      ros::NodeHandle().advertise<sensor_msgs::CompressedImage>("/web_unseen/camera/image_raw/compressed", 1);
  auto page = std::make_unique<BrowserPage>(web);
  EXPECT_TRUE(DriverUser::becomesTrue([&] { return pictures.getNumSubscribers() == 1; }));
  page.reset();
  EXPECT_TRUE(DriverUser::becomesTrue([&] { return pictures.getNumSubscribers() == 0; }));
}

TEST_F(WebTest, WalksAsLongAsAFingerIsOnThePad) {
  Web web("/web");
  const std::pair<const char*, std::function<void(BrowserPage&)>> ends[] = {
      {"lifted", [](BrowserPage& page) { page.order("let_go"); }},
      {"the page is gone, or hidden", [](BrowserPage& page) { page.leave(); }},
      {"nothing comes any more", [](BrowserPage&) {}},
  };
  for (const auto& [what, end] : ends) {
    BrowserPage page(web);
    ASSERT_TRUE(page.hears(kConnected)) << what;
    TopicListener<Twist> velocities("/web/cmd_vel");
    ASSERT_TRUE(holds(page, [&] { return velocities.count() > 2; })) << what;
    EXPECT_TRUE(velocities.waitFor([](const Twist& each) { return std::abs(each.linear.x - 0.05) < 1e-9; })) << what;
    EXPECT_TRUE(page.hears(R"x("type": "steers", "text": "page )x"));
    end(page);
    EXPECT_TRUE(DriverUser::becomesTrue([&] { return stands(*velocities.waitForCount(0).back()); })) << what;
    const auto all = velocities.waitForCount(0);
    EXPECT_EQ(std::adjacent_find(all.begin(), all.end(),
                                 [](const auto& a, const auto& b) { return stands(*a) && stands(*b); }),
              all.end())
        << what;
  }
}

TEST_F(WebTest, HasTheUsualSpeedsAtTheEdgesOfThePad) {
  Web web("/web");
  BrowserPage page(web);
  ASSERT_TRUE(page.hears(kConnected));
  TopicListener<Twist> velocities("/web/cmd_vel");
  EXPECT_TRUE(DriverUser::becomesTrue([&] {
    page.order("steer", R"("forward": 2, "left": 1, "turn": -1)");
    return velocities.waitFor(
               [](const Twist& each) {
                 return each.linear.x == 0.1 && each.linear.y == 0.05 && each.angular.z == -0.5;
               },
               milliseconds(50)) != nullptr;
  }));
}

TEST_F(WebTest, TurnsTheHead) {
  Web web("/web");
  BrowserPage page(web);
  ASSERT_TRUE(page.hears(kConnected));
  TopicListener<sensor_msgs::JointState> commands("/web/joint_command");
  ASSERT_TRUE(DriverUser::becomesTrue([&] {
    page.order("look", R"("pan": 0, "tilt": 5)");
    std::this_thread::sleep_for(milliseconds(50));
    return commands.count() > 0;
  }));
  const auto command = commands.waitForFirst();
  EXPECT_THAT(command->name, testing::ElementsAre("head_pan", "head_tilt"));
  EXPECT_NEAR(command->position.at(0), 0, 0.01);
  EXPECT_NEAR(command->position.at(1), 0.78, 0.1) << "at most the joint's limit";
}

TEST_F(WebTest, TellsASecondPageWhoSteers) {
  Web web("/web");
  BrowserPage first(web);
  BrowserPage second(web);
  ASSERT_TRUE(first.hears(kConnected));
  TopicListener<Twist> velocities("/web/cmd_vel");
  // If this computer is busy for 0.3 s, the finger of the first page counts as lifted.
  EXPECT_TRUE(DriverUser::becomesTrue([&] {
    first.order("let_go");
    second.order("let_go");
    velocities.clear();
    EXPECT_TRUE(holds(first, [&] {
      second.steer(-1);
      return velocities.count() > 3;
    }));
    return !velocities.waitFor([](const Twist& each) { return each.linear.x < 0; }, milliseconds(0));
  }));
  EXPECT_TRUE(first.hears(R"x("type": "name", "text": "page 1 (127.0.0.1)")x"));
  EXPECT_TRUE(second.hears(R"x("type": "steers", "text": "page 1 (127.0.0.1)")x"));
}

TEST_F(WebTest, PassesOnOrdersAndSaysWhatCameOfThem) {
  Web web("/web");
  BrowserPage page(web);
  ASSERT_TRUE(page.hears(kConnected));
  page.order("list_motions");
  EXPECT_TRUE(page.hears("NOD.MTN"));
  page.order("sit");
  EXPECT_TRUE(page.hears(R"("type": "said", "text": "sit: )"));
  page.order("rest");
  EXPECT_TRUE(page.hears(R"("type": "said", "text": "rest: )"));
  page.order("play", R"("name": "no such")");
  EXPECT_TRUE(page.hears(R"("type": "refused", "text": "play no such: )"));
  const std::size_t before = page.pictures();
  page.order("take_picture");
  EXPECT_TRUE(page.hears(R"("type": "said", "text": "take picture: )"));
  EXPECT_TRUE(page.hears(R"("type": "taken")"));
  EXPECT_NE(page.picture(before + 1), "");
  for (const char* nonsense :
       {"", "{", "7", "[]", "{}", R"({"do": "dance", "at": 1e12})", R"({"do": "steer", "at": 1e12})"}) {
    page.forget();
    page.send(nonsense);
    EXPECT_TRUE(page.hears("not understood")) << nonsense;
  }
}

TEST_F(WebTest, RefusesWhatWasOnItsWayForTooLongButStops) {
  Web web("/web");
  BrowserPage page(web);
  ASSERT_TRUE(page.hears(kConnected));
  page.order("stand", "", milliseconds(501));
  EXPECT_TRUE(page.hears("stand: it was on its way for too long"));
  page.order("stop", "", milliseconds(60000));
  EXPECT_TRUE(page.hears(R"("type": "said", "text": "stop: )"));
}

TEST_F(WebTest, StopsWhileTheMasterIsDeadAndWhoeverSteers) {
  test_support::FaultProxy master(static_cast<int>(ros::master::getPort()));
  Web web("/web", {}, {{"ROS_MASTER_URI", "http://127.0.0.1:" + std::to_string(master.port())}});
  BrowserPage steering(web);
  BrowserPage stopping(web);
  TopicListener<aibo_driver::RobotState> states("/web/robot_state");
  TopicListener<Twist> velocities("/web/cmd_vel");
  ASSERT_TRUE(steering.hears(kConnected));
  ASSERT_TRUE(holds(steering, [&] { return velocities.count() > 2; }));
  master.setWelcome(test_support::Welcome::kReset);
  master.endConnections(test_support::Action::kReset);
  ASSERT_TRUE(holds(steering, [&] { return velocities.count() > 4; })) << "steering goes on";
  stopping.order("stop");
  EXPECT_TRUE(states.waitFor([](const aibo_driver::RobotState& each) { return each.stopped_by == "/web/web"; }));
  EXPECT_TRUE(stopping.hears(R"("type": "said", "text": "stop: )"));
  EXPECT_TRUE(stopping.hears(R"("stopped_by": "/web/web")"));
  master.heal();
}

bool isRefused(const Web& web, const std::string& origin = "", const std::string& cookie = "") {
  try {
    const BrowserPage page(web, origin, cookie);
    return false;
  } catch (const boost::system::system_error&) {
    return true;
  }
}

http::response<http::string_body> fetch(const Web& web, const std::string& target, const std::string& host) {
  boost::asio::io_context context;
  tcp::socket socket = connectTo(context, web.port());
  http::request<http::empty_body> request(http::verb::get, target, 11);
  request.set(http::field::host, host);
  http::write(socket, request);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(socket, buffer, response);
  return response;
}

TEST(WebGate, RefusesStrangersPages) {
  Web web("/web_open");
  EXPECT_EQ(web.code(), "");
  EXPECT_TRUE(isRefused(web, "http://evil.example"));
  EXPECT_FALSE(isRefused(web));
  EXPECT_EQ(fetch(web, "/", "evil.example").result_int(), 403u);
  const auto page = fetch(web, "/", web.host());
  EXPECT_EQ(page.result_int(), 200u);
  EXPECT_EQ(page["X-Frame-Options"], "DENY");
  EXPECT_THAT(std::string(page["Content-Security-Policy"]), HasSubstr("default-src 'none'"));
  EXPECT_EQ(page.count(http::field::access_control_allow_origin), 0u);
}

TEST(WebGate, NeedsTheCodeFromTheNetwork) {
  Web web("/web_guarded", {"_web_address:=::ffff:127.0.0.1"});  // which does not count as this computer's own
  ASSERT_NE(web.code(), "");
  EXPECT_TRUE(isRefused(web));
  EXPECT_EQ(fetch(web, "/", web.host()).result_int(), 403u);
  const auto entered = fetch(web, "/?code=" + web.code(), web.host());
  ASSERT_EQ(entered.result_int(), 200u);
  const std::string cookie(entered[http::field::set_cookie]);
  EXPECT_FALSE(isRefused(web, "", cookie.substr(0, cookie.find(';'))));
}

TEST(WebGate, ClosesFloodsAndKeepsAPlaceForItsUser) {
  Web web("/web_flooded");
  BrowserPage long_message(web);
  long_message.send(std::string(4097, 'x'));
  EXPECT_TRUE(long_message.isClosed());
  BrowserPage deep(web);
  deep.send(std::string(4096, '['));
  EXPECT_TRUE(deep.hears("not understood"));
  BrowserPage busy(web);
  for (int i = 0; i < 199; ++i) {
    busy.send("{}");
  }
  busy.order("sit", "", milliseconds(501));
  EXPECT_TRUE(busy.hears("sit: it was on its way for too long")) << "200 messages are no flood";
  BrowserPage flood(web);
  for (int i = 0; i < 2000; ++i) {
    flood.send("{}");
  }
  EXPECT_TRUE(flood.isClosed());
  const auto descriptors = [&web] {
    return test_support::Resources::of(std::to_string(web.process().pid())).descriptors;
  };
  const std::size_t before = descriptors();
  boost::asio::io_context context;
  std::vector<tcp::socket> idle;
  for (int i = 0; i < 60; ++i) {
    idle.push_back(connectTo(context, web.port()));
  }
  EXPECT_FALSE(isRefused(web));
  EXPECT_LT(descriptors(), before + 30) << "the oldest had to go";
}

// Another program may have it.
TEST(Web, IsAtPort8080OfThisComputerUnlessToldOtherwise) {
  Process web({AIBO_WEB, "__ns:=/web_usual"});
  EXPECT_NO_THROW(web.waitForOutput("is at http://127\\.0\\.0\\.1:8080/|at 127\\.0\\.0\\.1, port 8080:"));
}

TEST(Web, SaysWhyItCannotStart) {
  Web first("/web_first");
  const std::pair<std::string, const char*> rows[] = {
      {"_web_port:=" + std::to_string(first.port()), "already in use"},
      {"_web_port:=70000", "web_port is 70000"},
      {"_web_address:=0.0.0.0", "must be an address of this computer"},
      {"_web_address:=nowhere", "web_address is 'nowhere'"},
      {"_web_address:=192.0.2.1", "cannot be served at 192.0.2.1"},
      {"_speed:=7", "speed is 7"},
  };
  int row = 0;
  for (const auto& [parameter, complaint] : rows) {
    Process web({AIBO_WEB, "__ns:=/web_wrong" + std::to_string(++row), parameter});  // the master keeps parameters
    EXPECT_EQ(web.waitForExit(kSafetyNet), 1) << parameter;
    EXPECT_THAT(web.output(), HasSubstr(complaint));
  }
}

}  // namespace
