#include "web/web_node.h"

#include <aibo_driver/ListMotions.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/TakePicture.h>
#include <geometry_msgs/Twist.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <set>
#include <sstream>
#include <utility>

#include "files/files.h"
#include "movement/joint_table.h"
#include "node/bounded_message.h"
#include "node/node.h"
#include "tools/teleop/teleop_node.h"
#include "web/page_texts.h"

namespace aibo_driver::web {
namespace {

using std::chrono::steady_clock;

constexpr std::size_t kMostBytes = 256 * 1024;  // no message of a driver has more

// Subscribes to a topic. The context's thread passes each message to `use`, unless the message is too long.
template <typename Message, typename Use>
ros::Subscriber subscribe(ros::NodeHandle& handle, const std::string& topic, boost::asio::io_context& context,
                          const Use& use) {
  using Bounded = node::BoundedMessage<Message, kMostBytes>;
  const auto post = [&context, use](const boost::shared_ptr<const Bounded>& bounded) {
    if (bounded->skipped == 0) {
      boost::asio::post(context, [use, bounded] { use(boost::shared_ptr<const Message>(bounded, &bounded->message)); });
    }
  };
  return handle.subscribe<Bounded>(topic, 1, post, {}, ros::TransportHints().tcpNoDelay());
}

Frame jpegFrame(const std::vector<std::uint8_t>& bytes, const std::shared_ptr<const void>& owner) {
  return {owner, boost::asio::buffer(bytes), false};
}

/// @return -1..1
/// @throw boost::property_tree::ptree_error it is missing, or is no number
double deflection(const boost::property_tree::ptree& order, const char* name) {
  return std::clamp(order.get<double>(name), -1.0, 1.0);
}

double milliseconds(TimePoint time) {
  return std::chrono::duration<double, std::milli>(time.time_since_epoch()).count();
}

// A page writes into each order when the finger gave it, by the clock that it has from us.
bool isTooOld(const boost::property_tree::ptree& order) {
  constexpr double kOldest = 500;  // ms
  return order.get<double>("at") < milliseconds(steady_clock::now()) - kOldest;
}

}  // namespace

WebNode::WebNode(const ros::NodeHandle& handle, const ros::NodeHandle& parameters)
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

WebNode::~WebNode() {
  context_.stop();
  serving_.join();
  if (steering_.page() && steering_.letGo(*steering_.page())) {
    publishVelocity(0, 0, 0);
  }
  states_.clear();
  calls_.cancel();
  subscribing_.join();
}

template <typename Message>
void WebNode::show(const std::string& topic) {
  const auto use = [this, topic](const boost::shared_ptr<const Message>& message) {
    server_.show(topic, pageText(*message));
  };
  states_.push_back(subscribe<Message>(handle_, topic, context_, use));
}

void WebNode::showSteerer() {
  server_.show("steers", pageText("steers", steering_.page() ? server_.nameOf(*steering_.page()) : ""));
}

void WebNode::showClock() {
  server_.show("clock", pageText("clock", std::to_string(milliseconds(steady_clock::now()))));
}

// This also shows each page that its connection is alive.
void WebNode::keepTime() {
  showClock();
  second_.expires_after(std::chrono::seconds(1));
  second_.async_wait([this](const boost::system::error_code&) { keepTime(); });
}

// The driver sends pictures only while somebody sees them. Subscribing waits for the ROS master, so it has a thread of
// its own.
void WebNode::followPictures() {
  wants_pictures_ = server_.hasPages();
  boost::asio::post(subscribing_, [this] {
    const auto use = [this](const boost::shared_ptr<const sensor_msgs::CompressedImage>& message) {
      const std::shared_ptr<const void> owner(message.get(), [message](const void*) {});
      server_.showPicture(jpegFrame(message->data, owner));
    };
    if (!wants_pictures_) {
      pictures_.shutdown();
    } else if (!pictures_) {
      pictures_ = subscribe<sensor_msgs::CompressedImage>(handle_, "camera/image_raw/compressed", context_, use);
    }
  });
}

void WebNode::opened(Page page) {
  followPictures();
  showClock();  // the last one is too old
  server_.tell(page, textFrame(pageText("name", server_.nameOf(page))));
}

void WebNode::closed(Page page) {
  followPictures();
  endSteering(steering_.letGo(page));
}

void WebNode::received(Page page, const std::string& text) {
  try {
    std::istringstream stream(text);
    Order order;
    boost::property_tree::read_json(stream, order);
    obey(page, order);
  } catch (const boost::property_tree::ptree_error&) {
    say(page, false, "That was not understood.");
  }
}

void WebNode::obey(Page page, const Order& order) {
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

void WebNode::obeyInTime(Page page, const std::string& what, const Order& order) {
  static const std::set<std::string> kTriggers{"release", "stand", "sit", "rest"};
  if (what == "steer") {
    steer(page, order);
  } else if (what == "look") {
    look(page, order);
  } else if (what == "take_picture") {
    takePicture(page);
  } else if (what == "list_motions") {
    listMotions(page);
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
bool WebNode::mayMove(Page page, bool walks) {
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

void WebNode::steer(Page page, const Order& order) {
  const double forward = deflection(order, "forward");
  const double left = deflection(order, "left");
  const double turn = deflection(order, "turn");
  if (mayMove(page, true)) {
    publishVelocity(forward * speeds_.forward, left * speeds_.left, turn * speeds_.turn);
  }
}

void WebNode::look(Page page, const Order& order) {
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

void WebNode::endSteering(bool has_to_stand) {
  if (has_to_stand) {
    publishVelocity(0, 0, 0);
  }
  showSteerer();
}

void WebNode::stop(Page page) {
  stop_.stop([this, page](const node::StopClient::Response* response) {
    const bool is_good = response != nullptr && response->success != 0;
    const std::string words = response != nullptr ? response->message : "no answer from the driver";
    boost::asio::post(context_, [this, page, is_good, words] { say(page, is_good, "stop: " + words); });
  });
}

void WebNode::takePicture(Page page) {
  TakePicture::Request request;
  request.save_to = files::nameForPicture();
  const auto show_it = [this, page](const TakePicture::Response& response) {
    const auto owner = std::make_shared<const TakePicture::Response>(response);
    server_.tell(page, textFrame(pageText("taken", response.message)));
    server_.tell(page, jpegFrame(owner->image.data, owner));
  };
  call<TakePicture>(page, "take picture", "take_picture", request, show_it);
}

void WebNode::listMotions(Page page) {
  const auto show_them = [this, page](const ListMotions::Response& response) {
    server_.tell(page, textFrame(pageText(response)));
  };
  call<ListMotions>(page, "", "list_motions", {}, show_them);
}

/// @param what what the page has asked for, in words; empty if it was no person who asked
/// @param done called if the service has done it
template <typename Service>
void WebNode::call(Page page, const std::string& what, const std::string& service,
                   const typename Service::Request& request,
                   const std::function<void(const typename Service::Response&)>& done) {
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

void WebNode::publishVelocity(double forward, double left, double turn) {
  velocity_.publish(teleop::toTwist({forward, left, turn}));
}

void WebNode::say(Page page, bool is_good, const std::string& words) {
  server_.tell(page, textFrame(pageText(is_good ? "said" : "refused", words)));
}

}  // namespace aibo_driver::web
