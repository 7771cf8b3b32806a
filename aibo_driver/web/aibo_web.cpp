// Shows a driver's robot on pages in browsers, and passes on what people want there.
//
// One thread serves the pages. It waits neither for the ROS master nor for the driver: messages come from roscpp's
// thread, services are called on threads of their own, and one thread subscribes to pictures.

#include <aibo_driver/Connection.h>
#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/TakePicture.h>
#include <geometry_msgs/Twist.h>
#include <ros/node_handle.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "files/files.h"
#include "movement/joint_table.h"
#include "node/bounded_message.h"
#include "node/node.h"
#include "node/service_calls.h"
#include "node/stop_client.h"
#include "text/json.h"
#include "text/plain_text.h"
#include "tools/program.h"
#include "tools/teleop/teleop_node.h"
#include "web/page_server.h"
#include "web/steering.h"

namespace aibo_driver::web {
namespace {

using std::chrono::steady_clock;
using text::Json;
using Order = boost::property_tree::ptree;

constexpr std::size_t kMostBytes = 256 * 1024;  // no message of a driver has more

// Subscribes to a topic. The context's thread passes each message to `use`, unless the message is too long.
template <typename Message, typename Use>
ros::Subscriber subscribe(ros::NodeHandle& handle, const std::string& topic, boost::asio::io_context& context,
                          const Use& use) {
  using Bounded = node::BoundedMessage<Message, kMostBytes>;
  const auto post = [&context, use](const boost::shared_ptr<const Bounded>& bounded) {
    if (bounded->skipped == 0) {
      boost::asio::post(context, [use, bounded] { use(bounded->message); });
    }
  };
  return handle.subscribe<Bounded>(topic, 1, post, {}, ros::TransportHints().tcpNoDelay());
}

/// How far a finger has moved a pad in one direction.
/// @return -1..1
/// @throw boost::property_tree::ptree_error the order has no such number
double deflection(const Order& order, const char* name) {
  return std::clamp(order.get<double>(name), -1.0, 1.0);
}

double milliseconds(TimePoint time) {
  return std::chrono::duration<double, std::milli>(time.time_since_epoch()).count();
}

// A page writes into each order when the finger gave it, by the clock that it has from us.
bool isTooOld(const Order& order) {
  constexpr double kOldest = 500;  // ms
  return order.get<double>("at") < milliseconds(steady_clock::now()) - kOldest;
}

std::string bytesOf(const sensor_msgs::CompressedImage& picture) {
  return {picture.data.begin(), picture.data.end()};
}

Json shown(const std::string& words) {
  constexpr std::size_t kLongest = 500;
  return text::plainLine(words, kLongest);
}

// What the pages are told, as JSON with its type: something in words, such as an answer, or a message of the driver's.
// Any node may have sent the message.
std::string pageText(const std::string& type, const std::string& words) {
  return Json::object({{"type", type}, {"text", shown(words)}}).text();
}

std::string pageText(const Connection& message) {
  const bool is_connected = message.state == Connection::CONNECTED;
  return Json::object({{"type", "connection"}, {"is_connected", is_connected}, {"text", shown(message.text)}}).text();
}

std::string pageText(const RobotState& message) {
  const std::string stopped_by = message.stopped != 0 ? message.stopped_by : "";
  return Json::object({{"type", "robot"},
                       {"posture", static_cast<int>(message.posture)},
                       {"motors", static_cast<int>(message.motors)},
                       {"stopped_by", shown(stopped_by)}})
      .text();
}

std::string pageText(const MotionState& message) {
  return pageText("moves", message.text);
}

std::string pageText(const sensor_msgs::BatteryState& message) {
  return Json::object({{"type", "battery"}, {"charge", static_cast<double>(message.percentage)}}).text();
}

std::string pageText(const LinkQuality& message) {
  return Json::object({{"type", "link"},
                       {"rate", static_cast<double>(message.pictures_per_second)},
                       {"age", static_cast<double>(message.age)},
                       {"lost", static_cast<double>(message.lost)}})
      .text();
}

std::string pageText(const ListMotions::Response& response) {
  constexpr std::size_t kMost = 200;
  std::vector<Json> names;
  std::transform(response.names.begin(), response.names.begin() + std::min(response.names.size(), kMost),
                 std::back_inserter(names), shown);
  return Json::object({{"type", "motions"}, {"names", Json::array(names)}}).text();
}

class WebNode : private PageListener {
 public:
  /// @param handle in the driver's namespace
  /// @param parameters has the parameters of docs/ros_interface.md
  /// @throw std::exception a parameter is wrong, or its port is in use; the message says so
  WebNode(const ros::NodeHandle& handle, const ros::NodeHandle& parameters)
      : handle_(handle),
        speeds_(teleop::readSpeeds(parameters)),
        server_(context_, parameters.param<std::string>("web_address", "127.0.0.1"),
                static_cast<std::uint16_t>(node::readNumber(parameters, "web_port", 8080, 65535)), *this),
        hold_(context_),
        second_(context_),
        velocity_(handle_.advertise<geometry_msgs::Twist>("cmd_vel", 1)),
        joints_(handle_.advertise<sensor_msgs::JointState>("joint_command", 1)),
        stop_(handle_) {
    // This is printed, not logged, because everybody who reaches the ROS master can read /rosout.
    std::printf("The robot's page is at %s\n", server_.link().c_str());
    std::fflush(stdout);
    show<Connection>("connection");
    show<RobotState>("robot_state");
    show<MotionState>("motion_state");
    show<sensor_msgs::BatteryState>("battery");
    show<LinkQuality>("link_quality");
    server_.show("driver", pageText("driver", handle_.getNamespace()));
    showSteerer();
    keepTime();
    serving_ = std::thread([this] { context_.run(); });
  }

  ~WebNode() override {
    context_.stop();
    serving_.join();
    if (steering_.page() && steering_.letGo(*steering_.page())) {
      publishVelocity(0, 0, 0);
    }
    states_.clear();
    calls_.cancel();
    subscribing_.join();
  }

 private:
  template <typename Message>
  void show(const std::string& topic) {
    states_.push_back(subscribe<Message>(
        handle_, topic, context_, [this, topic](const Message& message) { server_.show(topic, pageText(message)); }));
  }

  void showSteerer() {
    server_.show("steers", pageText("steers", steering_.page() ? server_.nameOf(*steering_.page()) : ""));
  }

  void showClock() { server_.show("clock", pageText("clock", std::to_string(milliseconds(steady_clock::now())))); }

  // This also shows each page that its connection is alive.
  void keepTime() {
    showClock();
    second_.expires_after(std::chrono::seconds(1));
    second_.async_wait([this](const boost::system::error_code&) { keepTime(); });
  }

  // The driver sends pictures only while somebody sees them. Subscribing waits for the ROS master, so it has a thread
  // of its own.
  void followPictures() {
    wants_pictures_ = server_.hasPages();
    boost::asio::post(subscribing_, [this] {
      if (!wants_pictures_) {
        pictures_.shutdown();
      } else if (!pictures_) {
        pictures_ = subscribe<sensor_msgs::CompressedImage>(
            handle_, "camera/image_raw/compressed", context_,
            [this](const sensor_msgs::CompressedImage& picture) { server_.showPicture(bytesOf(picture)); });
      }
    });
  }

  void opened(Page page) override {
    followPictures();
    showClock();  // the last one is too old
    server_.tell(page, "name", pageText("name", server_.nameOf(page)));
  }

  void closed(Page page) override {
    followPictures();
    endSteering(steering_.letGo(page));
  }

  void received(Page page, const std::string& text) override {
    try {
      std::istringstream stream(text);
      Order order;
      boost::property_tree::read_json(stream, order);
      obey(page, order);
    } catch (const boost::property_tree::ptree_error&) {
      say(page, false, "That was not understood.");
    }
  }

  void obey(Page page, const Order& order) {
    const auto what = order.get<std::string>("do");
    if (what == "stop") {
      stop(page);
    } else if (what == "let_go") {
      endSteering(steering_.letGo(page));
    } else if (isTooOld(order)) {
      say(page, false, what + ": it was on its way for too long");
    } else {
      obeyInTime(page, what, order);
    }
  }

  void obeyInTime(Page page, const std::string& what, const Order& order) {
    static const std::set<std::string> kTriggers{"release", "stand", "sit", "rest"};
    if (what == "steer") {
      steer(page, order);
    } else if (what == "look") {
      look(page, order);
    } else if (what == "take_picture") {
      takePicture(page);
    } else if (what == "list_motions") {
      call<ListMotions>(page, "", "list_motions", {}, [this, page](const ListMotions::Response& response) {
        server_.tell(page, "motions", pageText(response));
      });
    } else if (what == "play") {
      PlayMotion::Request request;
      request.name = order.get<std::string>("name");
      call<PlayMotion>(page, "play " + request.name, "play_motion", request);
    } else if (kTriggers.count(what) > 0) {
      call<std_srvs::Trigger>(page, what, what, {});
    } else {
      say(page, false, "That was not understood.");
    }
  }

  // If it may not, it knows who steers.
  bool mayMove(Page page, bool walks) {
    const bool is_new = !steering_.page();
    if (!steering_.hold(page, walks, steady_clock::now())) {
      return false;
    }
    hold_.expires_at(steering_.end());
    hold_.async_wait([this](const boost::system::error_code& error) {
      if (!error) {
        endSteering(steering_.expire(steady_clock::now()));
      }
    });
    if (is_new) {
      showSteerer();
    }
    return true;
  }

  void steer(Page page, const Order& order) {
    const double forward = deflection(order, "forward");
    const double left = deflection(order, "left");
    const double turn = deflection(order, "turn");
    if (mayMove(page, true)) {
      publishVelocity(forward * speeds_.forward, left * speeds_.left, turn * speeds_.turn);
    }
  }

  void look(Page page, const Order& order) {
    static const movement::JointTable kTable("ERS-7", movement::kNoSpeedLimit);
    sensor_msgs::JointState command;
    for (const auto& [name, joint] : {std::make_pair("pan", "head_pan"), std::make_pair("tilt", "head_tilt")}) {
      const movement::JointProperties& limits = kTable[*kTable.findByName(joint)];
      command.name.emplace_back(joint);
      command.position.push_back(limits.lowest + (deflection(order, name) + 1) / 2 * (limits.highest - limits.lowest));
    }
    if (mayMove(page, false)) {
      command.header.stamp = ros::Time::now();
      joints_.publish(command);
    }
  }

  void endSteering(bool has_to_stand) {
    if (has_to_stand) {
      publishVelocity(0, 0, 0);
    }
    showSteerer();
  }

  void stop(Page page) {
    stop_.stop([this, page](const node::StopClient::Response* response) {
      const bool is_good = response != nullptr && response->success != 0;
      const std::string words = response != nullptr ? response->message : "no answer from the driver";
      boost::asio::post(context_, [this, page, is_good, words] { say(page, is_good, "stop: " + words); });
    });
  }

  void takePicture(Page page) {
    TakePicture::Request request;
    request.save_to = files::nameForPicture();
    call<TakePicture>(page, "take picture", "take_picture", request, [this, page](const TakePicture::Response& taken) {
      server_.tell(page, "taken", pageText("taken", taken.message));
      server_.tell(page, "taken picture", bytesOf(taken.image), false);
    });
  }

  /// @param what what the page has asked for, in words; empty if it was no person who asked
  /// @param done called if the service has done it
  template <typename Service>
  void call(Page page, const std::string& what, const std::string& service, const typename Service::Request& request,
            const std::function<void(const typename Service::Response&)>& done = {}) {
    using Response = typename Service::Response;
    const auto say_it = [this, page, what](bool is_good, const std::string& words) {
      if (!what.empty()) {
        say(page, is_good, what + ": " + words);
      }
    };
    const auto finish = [this, say_it, done](const Response* answer) {
      const auto response = answer != nullptr ? std::make_shared<const Response>(*answer) : nullptr;
      boost::asio::post(context_, [say_it, done, response] {
        const bool is_good = response && response->success != 0;
        say_it(is_good, response ? response->message : "no answer from the driver");
        if (is_good && done) {
          done(*response);
        }
      });
    };
    if (!calls_.start<Service>(handle_.resolveName(service), request, finish)) {
      say_it(false, "the last call has not been answered yet");
    }
  }

  void publishVelocity(double forward, double left, double turn) {
    velocity_.publish(teleop::toTwist({forward, left, turn}));
  }

  void say(Page page, bool is_good, const std::string& words) {
    server_.tell(page, "said", pageText(is_good ? "said" : "refused", words));
  }

  ros::NodeHandle handle_;
  const teleop::Speeds speeds_;
  boost::asio::io_context context_{1};
  PageServer server_;
  boost::asio::steady_timer hold_;
  boost::asio::steady_timer second_;
  ros::Publisher velocity_;
  ros::Publisher joints_;
  node::StopClient stop_;

  // Members that only the thread that serves the pages uses.
  Steering steering_;
  node::ServiceCalls calls_;

  std::vector<ros::Subscriber> states_;
  std::atomic<bool> wants_pictures_{false};
  ros::Subscriber pictures_;  ///< only the next thread uses it
  boost::asio::thread_pool subscribing_{1};
  std::thread serving_;
};

constexpr char kHelp[] = R"(  rosrun aibo_driver aibo_web [__ns:=aibo] [_PARAMETER:=VALUE...]

Serves a page for browsers, which shows and steers the robot, and prints its address.

  ~web_address  the address of this computer at which it is served (127.0.0.1: for this computer only)
  ~web_port     its port (8080); 0: any free port
  ~speed, ~side_speed  at the edges of the pad, in m/s (0.1 and 0.05)
  ~turn_speed          the same for turns, in rad/s (0.5)
)";

}  // namespace
}  // namespace aibo_driver::web

int main(int argc, char** argv) {
  return aibo_driver::tools::run<aibo_driver::web::WebNode>(argc, argv, "aibo_web", aibo_driver::web::kHelp);
}
