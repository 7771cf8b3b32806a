#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "command_line/commands/commands.h"
#include "command_line/quantities.h"
#include "text/plain_text.h"

namespace aibo_driver::command_line {

using aibo_client::FaultKind;
using boost::asio::ip::tcp;

namespace {

using std::chrono::steady_clock;

constexpr int kConsolePort = 59000;          // Sony's wireless console
constexpr std::size_t kLongestReason = 200;  // bytes
constexpr double kLongestTest = 600;         // s
constexpr double kFewPictures = 20;          // pictures a second, of the camera's 25 or 30
constexpr double kHighLoss = 0.1;
constexpr double kLongGap = 0.5;        // s, between two pictures
constexpr double kLowCharge = 0.2;      // the same limit as in the driver's diagnostics
constexpr double kBatteryPatience = 3;  // s
constexpr char kWlanSwitch[] =
    "If the robot was never in this WLAN: is its switch WIRELESS, under the stomach cover, on? Press the pause "
    "button, and wait until the robot has stopped, before you set it.";

/// One line of the report.
struct Finding {
  std::string topic;
  bool good = true;
  std::string words;
  std::string advice;  ///< what to do about it; empty if all is well
};

/// Checks one thing after the other, until a problem makes further checks impossible.
class Doctor {
 public:
  Doctor(const RobotAddress& address, double seconds, Output& output)
      : address_(address), seconds_(seconds), output_(output) {}

  ExitStatus run() {
    const bool reachable = checkServer();
    conclude();
    return !reachable ? kUnreachable : problems_ > 0 ? kFailed : kDone;
  }

 private:
  void find(const Finding& finding) {
    problems_ += finding.good ? 0 : 1;
    findings_.push_back(Json::object(
        {{"topic", finding.topic}, {"good", finding.good}, {"text", finding.words}, {"advice", finding.advice}}));
    if (!output_.json()) {
      char topic[32];
      std::snprintf(topic, sizeof topic, "%-4s %-9s ", finding.good ? "ok" : "BAD", finding.topic.c_str());
      output_.result(topic + finding.words + (finding.advice.empty() ? "" : "\n               " + finding.advice), {});
    }
  }

  /// @return false if the robot does not serve this client
  bool checkServer() {
    Robot robot(address_, output_);
    try {
      robot.connect();
      checkVersion(robot);
      checkBattery(robot);
      checkStream(robot);
      return true;
    } catch (const aibo_client::NetworkException& error) {
      find({topicOf(error.kind()), false, error.what(), adviceFor(error.kind())});
      return false;
    }
  }

  static std::string topicOf(FaultKind kind) {
    switch (kind) {
      case FaultKind::kNameNotFound:
        return "name";
      case FaultKind::kRefused:
      case FaultKind::kUnreachable:
      case FaultKind::kNoAnswer:
        return "port";
      default:
        return "server";
    }
  }

  /// What to do in addition to the fault's own advice.
  std::string adviceFor(FaultKind kind) {
    switch (kind) {
      case FaultKind::kRefused:
        return consoleAnswers() ? "The robot's console (port 59000) answers: the robot is on, but RCServer is not "
                                  "running. The console says why."
                                : "";
      case FaultKind::kUnreachable:
      case FaultKind::kNoAnswer:
        return kWlanSwitch;
      case FaultKind::kTurnedAway: {
        const std::string reason = reasonOnConsole();
        if (!reason.empty()) {
          return "The robot's console says why: " + reason;
        }
        return "`ss -tp dport = :" + std::to_string(address_.port) +
               "` lists the programs of this computer that are connected. If there is none, another computer has the "
               "robot, or this computer's address is not among the ALLOWED_ADDRESSES in RCSERVER.CFG. The robot's "
               "console (port 59000) says which.";
      }
      case FaultKind::kClosed:
      case FaultKind::kSilent:
        return "Is the robot within reach of its WLAN?";
      default:
        return "";
    }
  }

  /// Why the robot turns this computer away; empty if its console does not say so in time.
  std::string reasonOnConsole() {
    tcp::iostream console;
    tcp::iostream client;
    if (connect(kConsolePort, &console) && connect(address_.port, &client)) {
      std::ostringstream text;  // this connection's address, because others may be turned away, too
      text << " " << client.socket().local_endpoint() << " is turned away: ";
      const std::string mark = text.str();
      for (std::string line; std::getline(console, line);) {
        if (const std::size_t begin = line.find(mark); begin != std::string::npos) {
          return text::plainLine(line.substr(begin + mark.size()), kLongestReason);
        }
      }
    }
    return "";
  }

  bool consoleAnswers() {
    tcp::iostream console;
    return connect(kConsolePort, &console);
  }

  /// All that happens on the connection ends after the time that the user waits for connections.
  bool connect(int port, tcp::iostream* connection) {
    connection->expires_after(address_.timeout);
    connection->connect(address_.host, std::to_string(port));
    return connection->good();
  }

  void checkVersion(const Robot& robot) {
    const aibo_client::ConnectionStatus status = robot.received().status;
    if (status.protocol_version == 1) {
      find({"server", true, "speaks version 1 of the protocol, as the RCServer of 2005 and 2006 does", ""});
      return;
    }
    find({"server", true, status.robot.server + " on an " + status.robot.design + ", version 2 of the protocol", ""});
    std::string allowed;
    for (const auto& [letter, name] :
         {std::make_pair("U", "upload"), {"D", "delete"}, {"M", "pictures"}, {"Q", "shut down"}, {"R", "reboot"}}) {
      allowed += status.robot.hasCapability(letter) ? (allowed.empty() ? "" : ", ") + std::string(name) : "";
    }
    find({"allows", true,
          allowed.empty() ? "nothing dangerous: no upload, delete, pictures, shut down, reboot" : allowed, ""});
  }

  void checkBattery(Robot& robot) {
    const robot_model::RobotModel& model = robot.model();
    const int index = robot_model::findSensorByName(model, "battery");
    if (index == robot_model::NO_SENSOR) {
      return;
    }
    const int id = model.sensors[index].identifier;
    robot.client().setTelemetryPeriod(Robot::kTelemetryPeriod);
    const auto measured = [id](const Received& received) { return received.sensors.count(id) > 0; };
    if (!robot.waitUntil(measured, nanosecondsOf(kBatteryPatience))) {
      find({"battery", false, "the robot does not report its battery", "Does its server support sensors?"});
    } else {
      const double charge = robot.received().sensors.at(id);
      find({"battery", charge >= kLowCharge, std::to_string(std::lround(100 * charge)) + " % charged",
            charge >= kLowCharge ? "" : "Charge it soon."});
    }
    robot.client().setTelemetryPeriod(0);
  }

  void checkStream(Robot& robot) {
    robot.client().setStreaming(true);
    camera::LinkMeter meter(steady_clock::now());
    const steady_clock::time_point end = steady_clock::now() + nanosecondsOf(seconds_);
    const auto has_pictures = [](const Received& received) { return !received.pictures.empty(); };
    while (robot.waitUntil(has_pictures, end - steady_clock::now())) {
      for (const ArrivedPicture& arrived : robot.takePictures()) {
        meter.add(*arrived.picture, arrived.age, 1, arrived.time);
      }
    }
    stream_ = meter.read(steady_clock::now());
    judgeStream();
    const std::uint64_t damaged = robot.client().statistics().corrupt_pictures;
    if (damaged > 0) {
      find({"pictures", false, counted(damaged, "picture") + (damaged == 1 ? " was damaged" : " were damaged"),
            "Is it an RCServer for an ERS-7 or an ERS-210? Look at the robot's console."});
    }
  }

  void judgeStream() {
    const bool enough = stream_.picturesPerSecond() >= kFewPictures && stream_.loss.value_or(0) <= kHighLoss;
    find({"stream", enough, wordsOf(stream_),
          enough ? "" : "Bring the robot nearer to its access point, or choose another channel; see docs/wlan.md."});
    char words[64];
    std::snprintf(words, sizeof words, "the longest time without a picture was %.0f ms", 1000 * stream_.longest_gap);
    const bool steady = stream_.longest_gap < kLongGap;
    find({"gaps", steady, words, steady ? "" : "The radio link stood still: look for other senders on its channel."});
  }

  void conclude() {
    if (output_.json()) {
      output_.result("", Json::object({{"host", address_.host},
                                       {"port", address_.port},
                                       {"good", problems_ == 0},
                                       {"findings", Json::array(findings_)},
                                       {"stream", stream_.seconds > 0 ? jsonOf(stream_) : Json()}}));
    } else {
      output_.result(problems_ == 0 ? "All is well." : "See the lines that begin with BAD.", {});
    }
  }

  const RobotAddress address_;
  const double seconds_;
  Output& output_;
  std::vector<Json> findings_;
  int problems_ = 0;
  camera::LinkMeter::Reading stream_;
};

ExitStatus diagnose(const Arguments& arguments, Output& output) {
  RobotAddress address = arguments.robot;
  if (!arguments.words.empty()) {
    address.host = arguments.words.front();
    address.host_is_given = true;
  }
  aibo_client::checkHost(address.host);
  const double seconds = arguments.number("seconds", 1, kLongestTest);
  return Doctor(address, seconds, output).run();
}

}  // namespace

std::vector<Command> doctorCommands() {
  return {{"doctor",
           "[HOST]",
           "checks the way to a robot, and says what to do",
           "It connects, and checks server and battery, and then the stream for --seconds. It moves nothing. The exit "
           "status is 0 if all is well, 1 if something is bad, 3 if the robot does not serve this computer.",
           {{"doctor 192.168.1.20", "the first thing to run with a new robot"},
            {"--json doctor", "one document, for scripts"}},
           diagnose,
           {{"seconds", "S", "10", "how long to watch the stream, 1 to 600"}}}};
}

}  // namespace aibo_driver::command_line
