// Whatever these objects have been through: after a new connection, or the end of what was, they do as new ones.
#include "support/history.h"

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <gmock/gmock.h>
#include <ros/time.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "node/body/led_state_publisher.h"
#include "node/body/power_status.h"
#include "node/body/sensor_messages.h"
#include "node/camera/link_meter.h"
#include "node/camera/stream_adapter.h"
#include "node/joints/joint_commander.h"
#include "node/parameter_watch.h"
#include "node/walk/get_up.h"
#include "node/walk/goal_walks.h"
#include "node/walk/walk_commander.h"
#include "support/fake_client.h"

namespace aibo_driver::node {
namespace {

using aibo_client::EndedHow;
using aibo_client::EndedKind;
using aibo_client::MotorState;
using aibo_client::PostureNow;
using std::chrono::milliseconds;
using test_support::Choices;
using test_support::expectAsNewAfterAnyHistory;
using Kind = movement::Movement::Kind;

const robot_model::RobotModel& theRobot() {
  return *robot_model::findRobotModel("ERS-7");
}

// ---- Sensors

// Everything that is made of telemetry.
class SensorsSession {
 public:
  std::string live(Choices& choices) {
    std::string text;
    for (int i = choices.below(8); i >= 0; --i) {
      aibo_client::Telemetry telemetry = telemetryAfter(choices.below(2000));
      for (int j = choices.below(4); j >= 0; --j) {
        const robot_model::Sensor& sensor = theRobot().sensors[choices.below(theRobot().number_of_sensors)];
        telemetry.sensors.push_back({sensor.identifier, choices.between(sensor.lowest / 1e6, sensor.highest / 1e6)});
        telemetry.joints.push_back({choices.of(table_.joints()).id, choices.between(-1, 1)});
      }
      text += read(telemetry);
    }
    connection_ += choices.once(5) ? 1 : 0;
    return text;
  }

  void renew(int) {
    ++connection_;
    now_ += std::chrono::seconds(2);
    measured_.clear();
    power_.clear();
  }

  std::string perform() {
    std::string text = report();
    for (const bool high : {true, false, true}) {
      for (int i = 0; i < theRobot().number_of_sensors; ++i) {  // one by one, as from version 1
        aibo_client::Telemetry telemetry = telemetryAfter(300);
        const robot_model::Sensor& sensor = theRobot().sensors[i];
        telemetry.sensors.push_back({sensor.identifier, (high ? sensor.highest : sensor.lowest) / 1e6});
        text += sensor.name + (": " + read(telemetry));
      }
      for (const movement::JointProperties& joint : table_.joints()) {
        aibo_client::Telemetry telemetry = telemetryAfter(10);
        telemetry.joints.push_back({joint.id, high ? joint.highest : joint.lowest});
        text += read(telemetry);
      }
      text += report();
    }
    return text;
  }

 private:
  aibo_client::Telemetry telemetryAfter(int time) {
    aibo_client::Telemetry telemetry;
    telemetry.connection_number = connection_;
    telemetry.arrival = now_ += milliseconds(time);
    return telemetry;
  }

  std::string read(const aibo_client::Telemetry& telemetry) {
    std::ostringstream text;
    const auto write = [&text](const auto& message) {
      if (message) {
        text << *message;
      }
    };
    measured_.update(telemetry);
    power_.update(telemetry);
    write(joints_.read(telemetry));
    write(touch_.read(telemetry));
    write(acceleration_.read(telemetry));
    write(battery_.read(telemetry));
    for (const RangeFinder& finder : finders_) {
      write(finder.read(telemetry));
    }
    return text.str();
  }

  std::string report() const {
    diagnostic_updater::DiagnosticStatusWrapper status;
    power_.report(true, status);
    return status.message + "\n";
  }

  std::uint64_t connection_ = 1;
  movement::SteadyTime now_{std::chrono::seconds(1000)};
  movement::JointTable table_{"ERS-7", 3.0};
  movement::MeasuredJoints measured_{table_};
  JointStates joints_{table_, measured_};
  TouchSensors touch_{theRobot()};
  Accelerometer acceleration_{sensorOf(theRobot(), "acceleration_front_back"),
                              sensorOf(theRobot(), "acceleration_right_left"),
                              sensorOf(theRobot(), "acceleration_up_down")};
  Battery battery_{sensorOf(theRobot(), "battery"), sensorOf(theRobot(), "temperature")};
  std::vector<RangeFinder> finders_{RangeFinder(sensorOf(theRobot(), "range_near")),
                                    RangeFinder(sensorOf(theRobot(), "range_far"))};
  PowerStatus power_{theRobot()};
};

TEST(History, ConcernsNoSensorOfTheNextConnection) {
  expectAsNewAfterAnyHistory<SensorsSession>(1, 10, 10);
}

// ---- LEDs

class LedsSession {
 public:
  std::string live(Choices& choices) {
    switch (choices.below(4)) {
      case 0:
        return connect(1 + choices.below(2));
      case 1:
        return disconnect();
      default:
        return accept(choices.below(30), choices.below(256), choices.once(2));
    }
  }
  void renew(int) { disconnect(); }
  std::string perform() {
    std::string text;
    for (const int version : {2, 1}) {
      text += connect(version);
      for (int id = 1; id < 28; ++id) {
        text += accept(id, 9 * id, id % 2 == 0) + accept(id, 9 * id, id % 2 == 0);
      }
      text += disconnect();
    }
    return text;
  }

 private:
  std::string connect(int version) {
    aibo_client::ConnectionStatus status;
    status.state = aibo_client::ConnectionState::kConnected;
    status.protocol_version = version;
    return textOf(memory_.update(status));
  }
  std::string disconnect() { return textOf(memory_.update({})); }
  std::string accept(int id, int intensity, bool in_mode_b) {
    return textOf(memory_.accept({{id, intensity, in_mode_b ? aibo_client::LedMode::kB : aibo_client::LedMode::kA}}));
  }
  std::string textOf(bool has_changed) const {
    std::ostringstream text;
    text << has_changed << "\n" << memory_.states();
    return text.str();
  }

  LedMemory memory_{theRobot()};
};

TEST(History, ConcernsNoLedOfTheNextConnection) {
  expectAsNewAfterAnyHistory<LedsSession>(1, 10, 30);
}

// ---- Pictures

class LinkMeterSession {
 public:
  std::string live(Choices& choices) {
    switch (choices.below(5)) {
      case 0:
        return read(choices.below(1500), choices.once(3) ? 0 : choices.between(1, 30));
      case 1:
        connection_ += choices.once(3) ? 1 : 0;
        return "";
      default:
        return add(static_cast<std::uint32_t>(choices.below(1000)), choices.below(100), choices.below(4),
                   !choices.once(4));
    }
  }
  void renew(int way) {
    connection_ += way == 0 ? 1 : 0;
    read(10, 0);  // the stream is off for two readings
    add(5000, 10, 0, true);
    read(2000, 0);
  }
  std::string perform() {
    std::string text = add(100, 20, 1, true) + add(101, 70, 1, true) + add(104, 30, 1, true);
    text += read(100, 30) + add(105, 5, 1, true) + read(1000, 30) + read(1000, 30);
    text += add(106, 20, 1, false) + read(20, 30) + add(112, 8, 3, true) + read(100, 10) + read(1000, 0);
    return text + add(300, 2, 1, true) + read(1000, 0) + read(500, 15);
  }

 private:
  std::string add(std::uint32_t image, int late, int every_nth_image, bool is_version2) {
    aibo_client::Picture picture;
    picture.jpeg.resize(image);
    picture.connection_number = connection_;
    if (is_version2) {
      picture.image_count = image;
      picture.frame_number = 4 * image;
    }
    picture.first_byte_time = now_;
    now_ += milliseconds(late);
    meter_.add(picture, 0.002 + 0.001 * late, every_nth_image, now_);
    return "a picture\n";
  }
  std::string read(int after, double asked_rate) {
    now_ += milliseconds(after);
    const LinkMeter::Reading reading = meter_.read(now_, asked_rate);
    std::ostringstream text;
    text << reading.seconds << " s, " << reading.pictures << " pictures, " << reading.bytes << " bytes, age "
         << reading.mean_age.value_or(-1) << " " << reading.worst_age.value_or(-1) << ", loss "
         << reading.loss.value_or(-1) << ", gap " << reading.longest_gap << ", latency " << reading.mean_latency << " "
         << reading.max_latency << ", slow for " << reading.slow_for << "\n";
    return text.str();
  }

  std::uint64_t connection_ = 1;
  LinkMeter::SteadyTime now_{std::chrono::hours(1)};
  LinkMeter meter_{now_};
};

TEST(History, OfAStreamEndsWithThatStream) {
  expectAsNewAfterAnyHistory<LinkMeterSession>(2, 30, 30);
}

class StreamAdapterSession {
 public:
  std::string live(Choices& choices) {
    if (choices.once(3)) {
      wish(choices.below(100) + 1, choices.below(5) + 1, !choices.once(3), choices.between(0.05, 0.5));
    }
    return publish(choices.once(5) ? -1 : choices.below(400), choices.below(100));
  }
  void renew(int way) { wish(1, 1, way == 0, 2); }
  std::string perform() {
    client_.told.clear();
    wish(85, 2, true, 0.15);
    std::string text = adapter_.describe();
    for (const int age : {10, 200, 300, 10, 500, -1, 130}) {
      text += publish(age, 150);
    }
    wish(70, 3, false, 0.15);
    return text + publish(500, 60) + std::to_string(adapter_.wishedQuality());
  }

 private:
  void wish(int quality, int every_nth_image, bool adaptive, double max_picture_age) {
    adapter_.setWish({quality, {aibo_client::Resolution::kDouble, every_nth_image}, adaptive, max_picture_age});
  }
  std::string publish(int age, int pictures) {
    for (int i = 0; i < pictures; ++i) {
      now_ += milliseconds(33);
      adapter_.picturePublished(now_, age < 0 ? std::nullopt : std::make_optional(now_ - milliseconds(age)));
    }
    std::string text = "age " + std::to_string(age) + ": " + adapter_.describe() + "\n";
    for (const std::string& told : std::exchange(client_.told, {})) {
      text += told + "\n";
    }
    return text;
  }

  test_support::FakeClient client_;
  StreamAdapter adapter_{client_};
  StreamAdapter::SteadyTime now_{std::chrono::seconds(1000)};
};

TEST(History, OfAdaptingEndsWithTheNextWish) {
  expectAsNewAfterAnyHistory<StreamAdapterSession>(2, 20, 10);
}

// ---- Parameters

class ParametersSession {
 public:
  ParametersSession() : watch_(parameters_, "/aibo/") {}

  std::string live(Choices& choices) {
    const std::string name = choices.of(kNames);
    if (choices.once(6)) {
      renew(0);
    } else if (choices.once(3)) {
      in_force_[name] = choices.of(kValues);
    } else {
      set(name, choices.of(kValues));
    }
    return check();
  }
  void renew(int) {
    parameters_ = initial();
    in_force_ = {{"quality", "85"}, {"speed", "1"}, {"adaptive", "off"}};
    check();
    check();
  }
  std::string perform() {
    std::string text;
    for (const std::string& value : kValues) {
      for (const std::string& name : kNames) {
        set(name, value);
        text += check() + check() + check();
      }
    }
    return text;
  }

 private:
  static XmlRpc::XmlRpcValue initial() {
    XmlRpc::XmlRpcValue values;
    values["host"] = "robot";
    values["quality"] = "85";
    values["speed"] = "1";
    values["adaptive"] = "off";
    return values;
  }
  void set(const std::string& name, const std::string& value) { parameters_[name] = value; }
  std::string check() {
    std::string text = "check\n";
    for (const std::string& news : watch_.check(parameters_, in_force_)) {
      text += news + "\n";
    }
    return text;
  }

  const std::vector<std::string> kNames{"host", "quality", "speed", "adaptive", "port"};
  const std::vector<std::string> kValues{"1", "50", "85", "robot"};
  XmlRpc::XmlRpcValue parameters_ = initial();
  ParameterTexts in_force_{{"quality", "85"}, {"speed", "1"}, {"adaptive", "off"}};
  ParameterWatch watch_;
};

TEST(History, OfParametersEndsWhenTheyAreRightAgain) {
  expectAsNewAfterAnyHistory<ParametersSession>(1, 20, 20);
}

// ---- Getting up

class GetUpSession {
 public:
  std::string live(Choices& choices) {
    now_ += std::chrono::seconds(1);
    if (choices.once(4)) {
      overruled_ = now_;
    }
    return choices.once(2)
               ? update(static_cast<MotorState>(choices.below(3)), static_cast<PostureNow>(choices.below(7)))
               : end(static_cast<Kind>(choices.below(6) + 1), choices.once(2) ? "/teleop" : "/driver",
                     choices.once(2) ? EndedHow::kFell : static_cast<EndedHow>(choices.below(8)));
  }
  void renew(int way) {
    now_ += std::chrono::seconds(1);
    update(way == 0 ? MotorState::kUnknown : MotorState::kOn, way == 0 ? PostureNow::kUnknown : PostureNow::kStanding);
    orders_ = 0;
  }
  std::string perform() {
    std::string text = update(MotorState::kOff, PostureNow::kFallen);
    for (const char* const source : {"/teleop", "/driver", "/teleop"}) {
      for (const Kind kind : {Kind::kWalk, Kind::kPosture, Kind::kCommand}) {
        now_ += std::chrono::seconds(1);
        text += update(MotorState::kOn, PostureNow::kWalking) + end(kind, source, EndedHow::kFell) +
                update(MotorState::kOn, PostureNow::kFallen) + update(MotorState::kOff, PostureNow::kFallen) +
                update(MotorState::kOff, PostureNow::kFallen);
      }
    }
    return text;
  }

 private:
  std::string end(Kind kind, const char* source, EndedHow how) {
    get_up_.ended({{kind, "", source, {}, {}}, how, ""}, now_);
    return "orders " + std::to_string(orders_) + "\n";
  }
  std::string update(MotorState motors, PostureNow posture) {
    get_up_.update({motors, posture}, overruled_);
    return "orders " + std::to_string(orders_) + "\n";
  }

  movement::SteadyTime now_{std::chrono::seconds(100)};
  movement::SteadyTime overruled_{std::chrono::seconds(99)};
  int orders_ = 0;
  GetUp get_up_{"/driver", [this] { ++orders_; }};
};

TEST(History, OfAFallEndsWhenTheRobotStandsOrIsGone) {
  expectAsNewAfterAnyHistory<GetUpSession>(2, 50, 10);
}

// ---- Orders by topics

// The commanders of joints and walks, and walks to goals, over one mover.
class CommandersSession {
 public:
  CommandersSession() {
    ros::Time::init();
    client_.present.robot.capabilities = {"I", "S", "E", "O"};
    client_.present.robot.walk_limits = {0.15, 0.1, 0.06, 1.2};
    measure();
    mover_.setListener({nullptr, nullptr,
                        [this](const movement::EndedMovement& ended) {
                          text_ += "  " + describe(ended.movement) + " of " + ended.movement.source + " ends " +
                                   std::to_string(static_cast<int>(ended.how)) + " " + ended.reason + "\n";
                        },
                        [this](const std::string& warning) { text_ += "  warning " + warning + "\n"; }});
  }

  std::string live(Choices& choices) {
    const std::string source = choices.of(kSources);
    client_.problem = choices.once(6) ? "it is far away" : "";
    switch (choices.below(10)) {
      case 0:
      case 1:
        position(source, choices.of(table_.joints()).name, choices.between(-0.5, 0.5));
        break;
      case 2:
        command(source, choices.of(table_.joints()).name, choices.between(-0.5, 0.5));
        break;
      case 3:
        follow(source, choices.of(table_.joints()).name, 0.1, choices.below(2));
        break;
      case 4:
      case 5:
        twist(source, choices.once(5) ? NAN : choices.between(-0.3, 0.3), choices.between(-1, 1));
        break;
      case 6:
        commander_.walker.runOut();
        break;
      case 7:
        beginGoal(source, choices.between(-3, 30));
        break;
      case 8:
        goOn(choices.between(0, 0.5), !choices.once(4));
        break;
      case 9:
        mover_.ended({EndedKind::kWalk, static_cast<EndedHow>(choices.below(6)), "walk", "the robot says so"});
        break;
    }
    now_ += milliseconds(choices.once(4) ? 700 : 10);
    measure();
    return tell();
  }

  void renew(int way) {
    client_.problem.clear();
    position("/renewer", "mouth", 0);
    command("/renewer", "mouth", 0);
    if (way == 0) {
      mover_.disconnected();
      ++client_.connections;
      mover_.connected();
    } else {
      mover_.stop({"/renewer", now_});
      mover_.release({"/renewer", now_});
      mover_.setMotors({"/renewer", now_}, true);
    }
    now_ += std::chrono::seconds(10);
    here_ = PlanePose{};
    client_.speed_limits.clear();
    measure();
    measure();
    tell();
  }

  std::string perform() {
    for (const std::string& source : kSources) {
      for (const movement::JointProperties& joint : table_.joints()) {
        position(source, joint.name, joint.lowest / 3);
      }
      now_ += milliseconds(100);
      measure();
      position(source, "mouth", -0.2);
      command(source, "mouth", -0.3);
      position(source, "head_pan", 0.2);
      follow(source, "head_pan", 0.3, 1);
      follow(source, "head_pan", 0.3, 0);
      twist(source, 0.3, -0.2);
      mover_.steered({0.15, 0, -0.1}, client_.steering_order);
      twist(source, NAN, 0);
      commander_.walker.runOut();
      mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
      twist(source, -0.1, 0);
      twist(source, 0, 0);
      mover_.steered({}, client_.steering_order);
      beginGoal(source, 1);
      for (const double step : {0.0, 0.3, 0.7}) {
        goOn(step, true);
        mover_.steered({0.1, 0, 0}, client_.steering_order);
      }
      mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
      goOn(0, true);
      beginGoal(source, 40);
      beginGoal(source, -1);
      goOn(0, false);
      goOn(0, true);
      mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
      now_ += milliseconds(700);
      measure();
    }
    return tell();
  }

 private:
  movement::Order order(const std::string& source) const { return {source, now_}; }
  void position(const std::string& source, const std::string& joint, double position) {
    commander_.joints.receivePosition(joint, position, order(source));
  }
  void command(const std::string& source, const std::string& joint, double position) {
    sensor_msgs::JointState message;
    message.name = {joint};
    message.position = {position};
    commander_.joints.receive(message, order(source));
  }
  void follow(const std::string& source, const std::string& joint, double position, std::size_t points) {
    trajectory_msgs::JointTrajectory message;
    message.joint_names = {joint};
    message.points.resize(points);
    for (trajectory_msgs::JointTrajectoryPoint& point : message.points) {
      point.positions = {position};
      point.time_from_start = ros::Duration(1);
    }
    commander_.joints.receive(message, order(source));
  }
  void twist(const std::string& source, double forward, double turn) {
    geometry_msgs::Twist message;
    message.linear.x = forward;
    message.angular.z = turn;
    commander_.walker.receive(message, order(source));
  }
  void beginGoal(const std::string& source, double forward) {
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = "base_link";
    goal.pose.position.x = forward;
    goal.pose.orientation.w = 1;
    has_odometry_ = true;
    walk_ = commander_.goals.begin(goal, order(source));
  }
  void goOn(double step, bool has_odometry) {
    if (walk_) {
      now_ += GoalWalks::kPeriod;
      here_.x += step;
      has_odometry_ = has_odometry;
      const movement::EndedMovement* const end = walk_->goOn();
      text_ += "  left " + std::to_string(walk_->distanceLeft()) + (end != nullptr ? " at the end\n" : "\n");
    }
  }
  void measure() {
    aibo_client::Telemetry telemetry;
    telemetry.arrival = now_;
    for (const movement::JointProperties& joint : table_.joints()) {
      telemetry.joints.push_back({joint.id, 0.0});
    }
    measured_.update(telemetry);
  }
  std::string tell() {
    std::string text = std::exchange(text_, "");
    for (const std::string& told : std::exchange(client_.told, {})) {
      text += told + "\n";
    }
    for (const movement::Movement& movement : mover_.state().movements) {
      text += describe(movement) + " of " + movement.source + "\n";
    }
    return text;
  }

  const std::vector<std::string> kSources{"/a", "/b"};
  movement::SteadyTime now_{std::chrono::seconds(1000)};
  const movement::Mover::Clock clock_ = [this] { return now_; };
  test_support::FakeClient client_;
  movement::JointTable table_{"ERS-7", 3.0};
  movement::MeasuredJoints measured_{table_};
  DriverParameters parameters_;
  PlanePose here_;
  bool has_odometry_ = true;
  movement::Mover mover_{table_, measured_, client_, 0.5, false, [] { return true; }, clock_};
  struct {
    JointCommander joints;
    WalkCommander walker;
    GoalWalks goals;
  } commander_{{table_, mover_},
               {parameters_.walk, client_, mover_},
               {parameters_, client_, mover_,
                [this] { return has_odometry_ ? std::make_optional(here_) : std::nullopt; }, clock_}};
  std::optional<GoalWalks::Walk> walk_;
  std::string text_;
};

TEST(History, OfOrdersEndsWithAStopOrTheConnection) {
  expectAsNewAfterAnyHistory<CommandersSession>(2, 30, 20);
}

}  // namespace
}  // namespace aibo_driver::node
