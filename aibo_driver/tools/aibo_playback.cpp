// Plays a recording as if the driver ran now: messages are stamped with the present time, and the driver's part of tf
// is made again. So a recording can be repeated, and rviz shows it like a robot. The topic `connection` says that this
// is a recording, and where it is. Nothing that a robot obeys is published, and all topics, even tf and diagnostics,
// are in the namespace of the playback. So a robot that runs at the same time neither moves nor looks like the recorded
// one.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/ColorRegions.h>
#include <aibo_driver/Connection.h>
#include <aibo_driver/LedStates.h>
#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/Sound.h>
#include <aibo_driver/Touch.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <tf2_msgs/TFMessage.h>
#include <topic_tools/shape_shifter.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "node/node.h"
#include "node/only_driver.h"
#include "tools/playback/body_frames.h"
#include "tools/playback/recording.h"
#include "tools/program.h"

namespace {

using aibo_driver::Connection;
using aibo_driver::node::readNumber;
using aibo_driver::tools::BodyFrames;
using aibo_driver::tools::Recording;
using aibo_driver::tools::Timeline;
using rosbag::MessageInstance;

const ros::WallDuration kReportPeriod(1.0);  // as often as a driver sends something
const ros::WallDuration kLook(0.1);          // how often the program looks for subscribers
const ros::WallDuration kOthers(1.0);        // after the first subscriber, for the others to connect
const ros::WallDuration kBetweenLoops(0.1);  // a recording of a single moment would repeat without a pause
const ros::WallDuration kLastMoment(0.5);    // for the last messages to arrive

constexpr std::uint32_t kQueueSize = 100;
constexpr double kLowestRate = 0.01;  // a recording of an hour then takes four days
constexpr double kHighestRate = 100;
constexpr double kLongest = 1e9;  // s

std::string minutes(const ros::Duration& duration) {
  char text[32];
  std::snprintf(text, sizeof(text), "%d:%02d", duration.sec / 60, duration.sec % 60);
  return text;
}

bool isLatched(const ros::M_string& connection_header) {
  const auto found = connection_header.find("latching");
  return found != connection_header.end() && found->second == "1";
}

template <typename... Messages>
bool hasChanged(const rosbag::ConnectionInfo& recorded) {
  return ((recorded.datatype == ros::message_traits::DataType<Messages>::value() &&
           recorded.md5sum != ros::message_traits::MD5Sum<Messages>::value()) ||
          ...);
}

/// True for the driver's messages whose definition was another one when they were recorded. Subscribers cannot receive
/// them.
bool isOfAnotherVersion(const rosbag::ConnectionInfo& recorded) {
  using namespace aibo_driver;  // NOLINT(google-build-using-namespace): its messages
  return hasChanged<CameraState, ColorRegions, Connection, LedStates, LinkQuality, MotionState, RobotState, Sound,
                    Touch>(recorded);
}

class Playback {
 public:
  /// @param failed becomes true if the recording cannot be read to its end
  Playback(ros::NodeHandle handle, ros::NodeHandle parameters, bool& failed)
      : handle_(handle),
        recording_(parameters.param<std::string>("bag", ""), parameters.param<std::string>("recorded_ns", "")),
        timeline_(readNumber(parameters, "rate", 1, kHighestRate, kLowestRate)),
        loops_(aibo_driver::node::readFlag(parameters, "loop")),
        start_(startFrom(parameters)),
        failed_(failed),
        only_driver_(handle),
        frames_(recording_.framePrefix()),
        watched_by_(ros::SteadyTime::now() + ros::WallDuration(readNumber(parameters, "wait", 2, kLongest))) {
    checkFramePrefix(parameters.param<std::string>("frame_prefix", ""));
    advertiseTopics();
    timeline_.anchor(start_, ros::Time::now());
    pause_ = parameters.advertiseService("pause_playback", &Playback::pause, this);
    reports_ = handle_.createSteadyTimer(kReportPeriod, [this](const ros::SteadyTimerEvent&) { report(); });
    timer_ = handle_.createSteadyTimer(
        kLook, [this](const ros::SteadyTimerEvent&) { goOn(); }, true);
    report();
  }

 private:
  ros::Time startFrom(const ros::NodeHandle& parameters) const {
    return recording_.begin() + ros::Duration(readNumber(parameters, "start", 0, recording_.length().toSec()));
  }

  void checkFramePrefix(const std::string& prefix) const {
    const std::string recorded = recording_.framePrefix();
    if ((prefix.empty() ? "" : prefix + "/") != recorded) {
      throw std::runtime_error(recording_.name() + " was recorded with the frame prefix '" + recorded +
                               "': play it with frame_prefix:=" +
                               (recorded.empty() ? "none" : recorded.substr(0, recorded.size() - 1)) + ".");
    }
  }

  void advertiseTopics() {
    constexpr bool kLatched = true;
    connection_ = handle_.advertise<Connection>("connection", 1, kLatched);
    tf_ = handle_.advertise<tf2_msgs::TFMessage>("tf", kQueueSize);
    std::set<std::string> left_out;
    for (const rosbag::ConnectionInfo* info : recording_.messages().getConnections()) {
      const std::string& name = recording_.topics().at(info->topic);
      if (isOfAnotherVersion(*info)) {
        left_out.insert(name);
      } else if (name != "connection") {
        ros::AdvertiseOptions options(name, kQueueSize, info->md5sum, info->datatype, info->msg_def);
        options.latch = isLatched(*info->header);
        publishers_[info->topic] = handle_.advertise(options);
      }
    }
    if (!left_out.empty()) {
      ROS_WARN_STREAM(recording_.name() << " is from another version of aibo_driver. Topics that nobody could receive "
                                           "are left out: "
                                        << boost::algorithm::join(left_out, ", ") << ".");
    }
  }

  void wakeIn(const ros::WallDuration& time) {
    timer_.stop();
    timer_.setPeriod(std::max(time, ros::WallDuration(1e-4)));
    timer_.start();
  }

  void goOn() {
    try {
      if (state_ == State::kWaiting) {
        wait();
      } else if (state_ == State::kPlaying && next_ == recording_.messages().end()) {
        rewind();
      } else if (state_ == State::kPlaying) {
        playDue();
      } else if (state_ == State::kEnded) {
        ros::requestShutdown();
      }
    } catch (const std::runtime_error& error) {  // rosbag: a message is cut off, or a time is impossible
      ROS_FATAL_STREAM(recording_.name() << " is damaged at " << position() << ": " << error.what()
                                         << ". What follows is lost.");
      failed_ = true;
      ros::requestShutdown();
    }
  }

  void wait() {
    if (connection_.getNumSubscribers() > 0) {
      watched_by_ = std::min(watched_by_, ros::SteadyTime::now() + kOthers);
    }
    if (ros::SteadyTime::now() < watched_by_) {
      wakeIn(kLook);
      return;
    }
    state_ = State::kPlaying;
    rewind();
  }

  // Goes back to the start. Latched messages from before it are true again, and all later ones are not known yet.
  void rewind() {
    connected_ = Connection();
    frames_ = BodyFrames(recording_.framePrefix());
    timeline_.anchor(start_, ros::Time::now());
    std::map<std::string, MessageInstance> latched;
    next_ = recording_.messages().begin();
    for (; next_ != recording_.messages().end() && next_->getTime() < start_; ++next_) {
      if (isLatched(*next_->getConnectionHeader())) {
        latched.erase(next_->getTopic());
        latched.emplace(next_->getTopic(), *next_);
      }
    }
    for (const auto& [topic, message] : latched) {
      play(message);
    }
    report();
    playDue();
  }

  void playDue() {
    const ros::Time now = ros::Time::now();
    for (; next_ != recording_.messages().end() && timeline_.timeOf(next_->getTime()) <= now; ++next_) {
      play(*next_);
    }
    if (next_ != recording_.messages().end()) {
      wakeIn(ros::WallDuration((timeline_.timeOf(next_->getTime()) - now).toSec()));
    } else if (loops_) {
      wakeIn(kBetweenLoops);
    } else {
      state_ = State::kEnded;
      report();
      wakeIn(kLastMoment);
    }
  }

  void play(const MessageInstance& message) {
    learn(message);
    const auto publisher = publishers_.find(message.getTopic());
    if (publisher == publishers_.end() ||
        (publisher->second.getNumSubscribers() == 0 && !publisher->second.isLatched())) {
      return;
    }
    std::vector<std::uint8_t> bytes(message.size());
    ros::serialization::OStream written(bytes.data(), message.size());
    message.write(written);
    aibo_driver::tools::changeStamp(
        message.getMessageDefinition(), [this](const ros::Time& stamp) { return timeline_.timeOf(stamp); }, bytes);
    topic_tools::ShapeShifter moved;
    moved.morph(message.getMD5Sum(), message.getDataType(), message.getMessageDefinition(), "");
    ros::serialization::IStream read(bytes.data(), message.size());
    moved.read(read);
    publisher->second.publish(moved);
  }

  // Remembers what the driver knew.
  void learn(const MessageInstance& message) {
    if (const auto odometry = message.instantiate<nav_msgs::Odometry>()) {
      frames_.receive(*odometry);
    } else if (const auto imu = message.instantiate<sensor_msgs::Imu>()) {
      frames_.receive(*imu);
    } else if (const auto robot = message.instantiate<Connection>()) {
      connected_ = *robot;
      report();
    } else if (const auto joints = message.instantiate<sensor_msgs::JointState>()) {
      if (message.getTopic() == recording_.nameSpace() + "/joint_states") {
        frames_.receive(*joints);
        tf2_msgs::TFMessage frames;
        frames.transforms = frames_.frames(timeline_.timeOf(joints->header.stamp));
        tf_.publish(frames);
      }
    }
  }

  std::string position() const {
    const ros::Time end = recording_.begin() + recording_.length();
    const ros::Time last = state_ == State::kEnded ? end : std::min(playedNow(), end);
    return minutes(last - recording_.begin()) + " of " + minutes(recording_.length());
  }

  ros::Time playedNow() const {
    return state_ == State::kPlaying ? timeline_.recordedAt(ros::Time::now()) : paused_at_;
  }

  void report() {
    Connection message = connected_;
    message.header.stamp = ros::Time::now();
    message.state = Connection::PLAYBACK;
    message.text = "playback of " + recording_.name() + ", " + position();
    if (state_ == State::kPaused) {
      message.text += ", paused";
    }
    if (!connected_.text.empty() && connected_.state != Connection::CONNECTED) {
      message.text += "; at that time: " + connected_.text;
    }
    connection_.publish(message);
  }

  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    if (request.data != 0 && state_ == State::kPlaying) {
      paused_at_ = playedNow();
      state_ = State::kPaused;
      timer_.stop();
    } else if (request.data == 0 && state_ == State::kPaused) {
      timeline_.anchor(paused_at_, ros::Time::now());
      state_ = State::kPlaying;
      goOn();
    }
    report();
    response.success = static_cast<std::uint8_t>(state_ == (request.data != 0 ? State::kPaused : State::kPlaying));
    response.message = position() + (state_ == State::kPaused ? ", paused" : "");
    return true;
  }

  enum class State { kWaiting, kPlaying, kPaused, kEnded };

  ros::NodeHandle handle_;
  Recording recording_;
  Timeline timeline_;
  const bool loops_;
  const ros::Time start_;
  bool& failed_;
  const aibo_driver::node::OnlyDriver only_driver_;  // with two drivers, a window could not say which of them it shows
  BodyFrames frames_;
  ros::SteadyTime watched_by_;  ///< when the first subscriber was found
  State state_ = State::kWaiting;
  ros::Time paused_at_ = start_;
  Connection connected_;  ///< the connection as it was recorded
  rosbag::View::iterator next_;
  std::map<std::string, ros::Publisher> publishers_;  ///< by the recorded topic
  ros::Publisher connection_;
  ros::Publisher tf_;
  ros::ServiceServer pause_;
  ros::SteadyTimer reports_;
  ros::SteadyTimer timer_;  // last, because its callback uses all members above
};

constexpr char kHelp[] = R"(  roslaunch aibo_driver playback.launch bag:=FILE.bag

Plays a recording as if its robot were here; the launch file starts this program with what it needs. Parameters: ~bag,
~recorded_ns, ~frame_prefix, ~rate, ~start, ~loop and ~wait, as in docs/ros_interface.md.
)";

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::tools::init(argc, argv, "aibo_playback", kHelp);
  bool failed = false;
  const int status = aibo_driver::node::runNode("playback", [&failed] {
    return std::make_shared<Playback>(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "playback/aibo"),
                                      ros::NodeHandle("~"), failed);
  });
  return failed ? EXIT_FAILURE : status;
}
