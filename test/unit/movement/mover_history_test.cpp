// Whatever a mover has been through, and whatever interrupted it: the next orders are carried out as the first ones.
#include "movement/mover.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "support/fake_client.h"
#include "support/history.h"
#include "text/number.h"

namespace aibo_driver::movement {
namespace {

using aibo_client::EndedHow;
using aibo_client::EndedKind;
using aibo_client::MotorState;
using aibo_client::Posture;
using aibo_client::PostureNow;
using aibo_client::RefusalCause;
using aibo_client::RefusedRequest;
using std::chrono::milliseconds;
using test_support::Choices;
using Kind = Movement::Kind;
using Names = std::vector<std::string>;

const Names kSources{"/a", "/b", "/c"};
const Names kMotions{"NOD.MTN", "WAG.MTN"};

std::string nameOf(EndedHow how) {
  return std::vector<std::string>{
      "done", "replaced", "stopped", "refused", "fell", "unknown", "missed", "lost"}[static_cast<std::size_t>(how)];
}

std::string number(double value) {
  return text::decimal(value, 2);
}

// A mover and a robot that does what it is told, unless it has to be unable to.
class Session {
 public:
  static constexpr int kWaysToRenew = 6;

  Session() {
    client_.present.robot.capabilities = {"I", "S", "E", "O"};
    mover_.setListener({[this] { noteState(); }, [this] { is_timer_on_ = true; },
                        [this](const EndedMovement& ended) {
                          ++ends_told_;
                          note(describe(ended.movement) + " of " + ended.movement.source + " " + nameOf(ended.how) +
                               " " + ended.reason);
                        },
                        [this](const std::string& warning) { note("warning " + warning); }});
    measure();
    measure();
  }

  // ---- Orders

  Order order(const std::string& source) const { return {source, now_}; }

  Mover::Begun begin(const std::string& what, Mover::Begun begun) {
    note(what + " is #" + std::to_string(begun.id - first_id_) + (begun.is_uncertain ? " perhaps" : "") + " " +
         begun.remark + (begun.ended() != nullptr ? " and has ended: " + nameOf(begun.ended()->how) : ""));
    begun_.push_back(begun);
    noteTold();
    return begun;
  }

  void act(const std::string& what, const std::function<void()>& work) {
    try {
      work();
      note(what);
    } catch (const aibo_client::Exception& error) {
      note(what + " fails: " + error.what());
    }
    noteTold();
  }

  Mover::Begun command(const std::string& source, const Names& joints, const std::vector<double>& positions,
                       const std::vector<double>& speeds = {}, Kind kind = Kind::kCommand) {
    return begin("command", mover_.command(order(source), joints, positions, speeds, kind));
  }
  Mover::Begun follow(const std::string& source, const Names& joints, const std::vector<double>& positions,
                      double time = 1, int wait = 0) {
    return begin("follow", mover_.follow(order(source), {joints, {{time, positions, {}}}}, milliseconds(wait),
                                         {{}, milliseconds(200)}));
  }
  Mover::Begun play(const std::string& source, const std::string& name) {
    return begin("play " + name, mover_.play(order(source), name, 2));
  }
  Mover::Begun take(const std::string& source, Posture posture) {
    return begin("posture", mover_.takePosture(order(source), posture));
  }
  Mover::Begun walkToGoal(const std::string& source) {
    return begin("goal", mover_.walkToGoal(order(source), "1 m ahead"));
  }
  void walkOn(const Mover::Begun& walk, double forward) {
    note(mover_.walkOn(walk.id, {forward, 0, 0}) ? "walks on" : "does not walk on");
    noteTold();
  }
  void steer(const std::string& source, double forward, double turn = 0) {
    act("steer", [&] { mover_.steer(order(source), {forward, 0, turn}); });
  }
  void stop(const std::string& source) {
    act("stop", [&] { mover_.stop(order(source)); });
  }
  void release() {
    act("release", [&] { mover_.release(order(user_)); });
  }
  void hold() {
    act("hold", [&] { mover_.hold(order(user_), user_ + " said so"); });
  }
  void setMotors(bool on) {
    act("motors", [&] { note(mover_.setMotors(order(user_), on) ? "motors are on" : "motors are off"); });
  }
  void cancel(const Mover::Begun& begun) {
    act("cancel", [&] { mover_.cancel(begun.id, user_ + " cancelled it"); });
  }
  void stopMotion(const std::string& name) {
    act("stop motion", [&] { mover_.stopMotion(order(user_), name); });
  }
  void stopWalking() {
    act("stop walking", [&] { mover_.stopWalking(user_ + " sends nothing"); });
  }

  // ---- What the robot says

  void steered(double forward) {
    act("steered", [&] { mover_.steered({forward, 0, 0}, client_.steering_order); });
  }
  void ended(EndedKind kind, EndedHow how, const std::string& name, const std::string& reason = "") {
    act("the robot ends " + name, [&] { mover_.ended({kind, how, name, reason}); });
  }
  void refused(RefusedRequest request, RefusalCause cause, const std::vector<int>& ids, std::uint64_t of) {
    act("the robot refuses", [&] { mover_.refused({request, cause, ids, user_ + " is refused", of}); });
  }
  void answeredLate(const Mover::Begun& begun, bool accepted) {
    act("a late answer", [&] { mover_.answeredLate({begun.id, accepted, accepted ? "" : "There is none.", ""}); });
  }
  void robotChanged(MotorState motors, PostureNow posture) {
    act("the robot changes", [&] { mover_.robotChanged({motors, posture}); });
  }
  void disconnect() {
    act("disconnected", [&] { mover_.disconnected(); });
  }
  void connectUnnoticed() { ++client_.connections; }
  void connect() {
    connectUnnoticed();
    act("connected", [&] { mover_.connected(); });
  }

  // ---- Time

  // As the driver does: it calls the mover regularly while the mover wants it.
  void pass(int time) {
    const SteadyTime end = now_ + milliseconds(time);
    while (now_ < end) {
      now_ += JointPlan::kPeriod;
      measure();
      if (is_timer_on_) {
        is_timer_on_ = mover_.goOn();
        noteTold();
      }
    }
  }
  void holdUp(int time) {
    now_ += milliseconds(time);
    measure();
  }

  // ---- History

  std::string live(Choices& choices);

  void renew(int way) {
    makeRobotGood();
    user_ = "/panel";
    switch (way) {
      case 0:
        disconnect();
        connect();
        break;
      case 1:
        disconnect();
        connectUnnoticed();
        break;
      case 2:
        connectUnnoticed();
        mover_.goOn();
        break;
      case 3:
        stop("/panel");
        break;
      case 4:
        setMotors(false);
        break;
      case 5:
        client_.meanwhile = [] {
          throw aibo_client::TimeoutException("no answer.", aibo_client::FaultKind::kNone, true);
        };
        setMotors(false);
        break;
    }
    release();
    if (way > 2) {  // a new connection is enough
      setMotors(true);
    }
    if (way > 1) {
      robotChanged(MotorState::kOn, PostureNow::kStanding);  // a new connection says nothing of the robot yet
    }
    rest();
    client_.speed_limits.clear();
    client_.terms = {};
    while (is_timer_on_) {
      pass(32);
    }
    first_id_ = mover_.refuse(order("/panel"), Kind::kCommand, {}, "this is for its number").id;
    EXPECT_EQ(mover_.state().ends, ends_told_);
    ends_before_ = ends_told_;
    began_ = now_;
    state_.clear();
    log_.clear();
    begun_.clear();
  }

  // What comes of some use.
  std::string emitted(const std::function<void()>& use) {
    log_.clear();
    use();
    noteTold();
    return log_;
  }

  std::string perform() {
    return emitted([this] {
      commandEveryJoint();
      followTrajectories();
      playMotions();
      takePostures();
      walkBySteering();
      walkToGoals();
      stopEverything();
      loseTheConnection();
    });
  }

  // Long after everything, with a robot in order.
  void rest() {
    makeRobotGood();
    positions_.clear();
    now_ += std::chrono::seconds(10);
    measure();
    measure();
  }

  const std::vector<Mover::Begun>& begun() const { return begun_; }
  const Mover::Begun& last() const { return begun_.back(); }
  Mover::State state() const { return mover_.state(); }

  test_support::FakeClient client_;
  std::string stuck_;  // a joint that does not move, as its identifier

 private:
  void makeRobotGood() {
    client_.problem.clear();
    client_.meanwhile = nullptr;
    client_.can_hold = client_.motors_work = telemetry_ = true;
    client_.present.robot.capabilities = {"I", "S", "E", "O"};
    client_.present.robot.design.clear();
    client_.present.protocol_version = 2;
    table_.setSpeedScale(1);
    stuck_.clear();
  }

  void note(const std::string& text) { log_ += std::to_string((now_ - began_) / milliseconds(1)) + ": " + text + "\n"; }

  void noteTold() {
    for (const std::string& told : std::exchange(client_.told, {})) {
      std::string text = "  -> " + told;
      if (told[0] == 'J') {
        std::istringstream words(told.substr(2));
        for (std::string word; words >> word && word != "in";) {
          const std::size_t colon = word.find(':');
          if (word.substr(0, colon) != stuck_) {
            positions_[std::stoi(word)] = std::stod(word.substr(colon + 1));
          }
        }
      }
      const auto left = (client_.terms.not_after - now_) / milliseconds(1);
      if (left >= 0 && left <= 1000) {  // otherwise it is of the real clock
        const std::uint64_t number = client_.terms.number;
        text +=
            " for #" + (number == 0 ? "none" : std::to_string(number - first_id_)) + " until " + std::to_string(left);
      }
      note(text);
    }
  }

  void noteState() {
    const Mover::State state = mover_.state();
    std::string text = "state:";
    for (const Movement& movement : state.movements) {
      text += " [" + describe(movement) + " of " + movement.source + " " + listOf(movement.joints) +
              (movement.end ? " until " + number(std::chrono::duration<double>(*movement.end - began_).count()) : "") +
              "]";
    }
    text += " ends " + std::to_string(state.ends - ends_before_) + " motors " +
            std::to_string(static_cast<int>(state.robot.motors)) + " posture " +
            std::to_string(static_cast<int>(state.robot.posture)) + " stopped by " + state.stopped_by.value_or("-");
    if (std::exchange(state_, text) != text) {
      note(text);
    }
  }

  void measure() {
    aibo_client::Telemetry telemetry;
    telemetry.arrival = now_;
    for (const JointProperties& joint : table_.joints()) {
      const auto found = positions_.find(joint.id);
      telemetry.joints.push_back({joint.id, found == positions_.end() ? 0.0 : found->second});
    }
    measured_.update(telemetry);
  }

  void commandEveryJoint();
  void followTrajectories();
  void playMotions();
  void takePostures();
  void walkBySteering();
  void walkToGoals();
  void stopEverything();
  void loseTheConnection();
  double within(const std::string& joint, double part) const {
    const JointProperties& properties = table_[*table_.findByName(joint)];
    return properties.lowest + part * (properties.highest - properties.lowest);
  }

  SteadyTime now_{std::chrono::hours(100000)};  // later than the real clock, however long the computer has run
  SteadyTime began_ = now_;
  JointTable table_{"ERS-7", 3.0};
  MeasuredJoints measured_{table_};
  bool telemetry_ = true;
  Mover mover_{table_, measured_, client_, 0.5, false, [this] { return telemetry_; }, [this] { return now_; }};
  std::map<int, double> positions_;
  bool is_timer_on_ = false;
  std::size_t ends_told_ = 0;
  std::size_t ends_before_ = 0;
  MovementId first_id_ = 0;
  std::vector<Mover::Begun> begun_;
  std::string user_ = "/before";  // who stops, cancels, ...
  std::string state_;
  std::string log_;
};

// ---- The use that is compared

// Each joint goes elsewhere, at its own speed.
void Session::commandEveryJoint() {
  Names all;
  std::vector<double> positions;
  std::vector<double> speeds;
  for (const JointProperties& joint : table_.joints()) {
    const auto i = static_cast<double>(all.size());
    all.push_back(joint.name);
    positions.push_back(within(joint.name, 0.2 + 0.03 * i));
    speeds.push_back(i < 9 ? 0 : -0.05 * i);
  }
  command("/a", all, positions);
  pass(320);
  for (const std::string& joint : all) {
    command("/a", {joint}, {within(joint, 0.45)});
  }
  command("/b", all, positions, speeds);
  command("/b", {all[3], "third_eye"}, {within(all[3], 0.5), 0});
  command("/c", {all[2]}, {within(all[2], 0.5)}, {}, Kind::kLookAt);
  pass(9000);
  stuck_ = std::to_string(table_[1].id);
  command("/a", {all[0], all[1]}, {within(all[0], 0.4), within(all[1], 0.8)});
  refused(RefusedRequest::kJoints, RefusalCause::kJointFault, {table_[1].id}, 0);
  pass(6000);
  stuck_.clear();
  for (int i = 0; i < 3; ++i) {
    command("/a", {all[0]}, {NAN});
    pass(64);
  }
  command("/a", {all[0]}, {0.0});
  refused(RefusedRequest::kJoints, RefusalCause::kRobot, {table_[0].id}, 0);
  command("/a", {all[0]}, {0.1});
  client_.problem = "it is far away";
  command("/b", {all[0]}, {0.1});
  client_.problem.clear();
  command("/b", {all[0]}, {0.05});
  pass(500);
}

void Session::followTrajectories() {
  const Mover::Begun head = follow("/a", {"head_pan", "mouth"}, {0.6, -0.3});
  pass(320);
  for (const Trajectory::Start& wanted : mover_.wantedBy(head.id, now_)) {
    note(std::to_string(wanted.joint) + " " + number(wanted.position) + " " + number(wanted.velocity));
  }
  follow("/b", {"head_pan", "neck_tilt"}, {0.2, -0.4});
  pass(320);
  cancel(head);
  pass(2000);
  const Mover::Begun later = follow("/a", {"head_pan"}, {-0.5}, 1, 500);
  pass(1000);
  cancel(later);
  command("/b", {"head_pan"}, {0.3});
  follow("/a", {"head_pan"}, {-0.5}, 2);
  pass(320);
  command("/b", {"head_pan"}, {0.3});
  pass(640);
  stuck_ = "2";
  follow("/c", {"head_pan"}, {0.5}, 0.6);
  pass(1600);
  stuck_.clear();
  follow("/c", {"head_pan"}, {0.4});
  pass(320);
  holdUp(700);
  pass(64);
  follow("/c", {"head_pan", "head_pan"}, {0.4, 0.4});
}

void Session::playMotions() {
  follow("/a", {"head_pan"}, {0.2});
  play("/b", "NOD.MTN");
  ended(EndedKind::kMotion, EndedHow::kDone, "NOD.MTN");
  client_.meanwhile = [] { throw aibo_client::TimeoutException("late.", aibo_client::FaultKind::kNone, true); };
  const Mover::Begun late = play("/a", "WAG.MTN");
  answeredLate(late, true);
  play("/c", "NOD.MTN");
  stopMotion("NOD.MTN");
  ended(EndedKind::kMotion, EndedHow::kFell, "WAG.MTN", "it fell");
  client_.meanwhile = [] { throw aibo_client::CommandException("There is none."); };
  play("/a", "NOD.MTN");
  command("/a", {"mouth"}, {-0.4});
  pass(500);
}

void Session::takePostures() {
  command("/a", {"left_front_knee", "mouth"}, {0.5, -0.2});
  take("/b", Posture::kSit);
  ended(EndedKind::kPosture, EndedHow::kDone, "sit");
  cancel(take("/b", Posture::kStand));
  client_.meanwhile = [] { throw aibo_client::TimeoutException("late.", aibo_client::FaultKind::kNone, true); };
  answeredLate(take("/c", Posture::kRest), false);
  command("/a", {"mouth", "left_front_knee"}, {-0.1, 0.4});
  pass(600);
}

void Session::walkBySteering() {
  steer("/c", 0.1);
  steered(0.1);
  ended(EndedKind::kWalk, EndedHow::kDone, "walk", "it says so");
  steer("/a", 0.1, -0.2);
  steered(0.1);
  pass(96);
  steer("/a", 0.05);
  stopWalking();
  steered(0);
  ended(EndedKind::kWalk, EndedHow::kDone, "walk");
  steer("/b", -0.05);
  steered(-0.05);
  ended(EndedKind::kWalk, EndedHow::kDone, "walk", "it says so");
  steer("/b", 0.1);
  steer("/b", 0);
  steered(0);
  steer("/a", 0.1);
  steered(0.1);
  ended(EndedKind::kWalk, EndedHow::kFell, "walk", "it fell");
  steer("/a", 0.1);
  steer("/a", 0.1);
  pass(600);
  steer("/a", 0.1);
  refused(RefusedRequest::kWalk, RefusalCause::kRobot, {}, client_.steering_order);
  steer("/a", 0);
  steer("/a", 0.1);
  steered(0.1);
  command("/c", {"right_hind_knee"}, {0.6});
  ended(EndedKind::kWalk, EndedHow::kReplaced, "walk", "the legs were commanded");
  steer("/a", 0.1);
  pass(600);
}

void Session::walkToGoals() {
  const Mover::Begun first = walkToGoal("/a");
  walkOn(first, 0.1);
  steered(0.1);
  pass(96);
  walkOn(first, 0.05);
  cancel(first);
  walkOn(first, 0.05);
  ended(EndedKind::kWalk, EndedHow::kDone, "walk");
  const Mover::Begun second = walkToGoal("/b");
  walkOn(second, -0.1);
  steered(-0.1);
  walkOn(second, 0);
  ended(EndedKind::kWalk, EndedHow::kDone, "walk");
  const Mover::Begun third = walkToGoal("/c");
  walkOn(third, 0.1);
  steered(0.1);
  steer("/a", 0.2);
  steered(0.2);
  walkOn(third, 0.1);
  steer("/a", 0);
  ended(EndedKind::kWalk, EndedHow::kDone, "walk");
  walkOn(walkToGoal("/b"), 0);
  pass(600);
}

void Session::stopEverything() {
  const auto move = [this] {
    command("/a", {"mouth"}, {-0.4});
    follow("/b", {"head_pan"}, {0.5}, 2);
    play("/c", "NOD.MTN");
    steer("/a", 0.1);
    steered(0.1);
  };
  move();
  client_.meanwhile = [this] {
    ended(EndedKind::kMotion, EndedHow::kStopped, "NOD.MTN", "it was held");
    release();
    pass(64);
  };
  stop("/panel");
  move();
  walkToGoal("/c");
  take("/b", Posture::kStand);
  setMotors(true);
  setMotors(false);
  take("/b", Posture::kRest);
  release();
  setMotors(true);
  pass(600);
  move();
  hold();
  pass(600);
  move();
  robotChanged(MotorState::kOff, PostureNow::kLying);
  robotChanged(MotorState::kOn, PostureNow::kStanding);
  pass(600);
  client_.can_hold = false;  // as with version 1
  client_.present.robot.capabilities.clear();
  hold();
  move();
  pass(64);
  stop("/panel");
  release();
  client_.can_hold = true;
  client_.present.robot.capabilities = {"I", "S", "E", "O"};
  pass(600);
  move();
  client_.meanwhile = [] { throw aibo_client::CommandException("It is busy."); };
  setMotors(false);
  pass(600);
}

void Session::loseTheConnection() {
  command("/a", {"mouth"}, {-0.2});
  follow("/b", {"head_pan"}, {0.1}, 2);
  const Mover::Begun walk = walkToGoal("/c");
  disconnect();
  walkOn(walk, 0.1);
  connect();
  pass(32);
  command("/a", {"mouth"}, {-0.1});
  take("/b", Posture::kStand);
  connectUnnoticed();
  pass(32);
  for (const EndedMovement& ended : mover_.state().ended) {
    note("remembered: " + describe(ended.movement) + " " + nameOf(ended.how) + " " + ended.reason);
  }
}

// ---- What may have been before

std::string Session::live(Choices& choices) {
  if (choices.once(2)) {
    release();
  }
  const bool was_stopped = mover_.state().stopped_by.has_value();
  const std::string before = std::exchange(log_, "");
  const std::string source = choices.of(kSources);
  Names joints{choices.of(table_.joints()).name};
  if (choices.once(2)) {
    joints.push_back(choices.of(table_.joints()).name);
  }
  std::vector<double> positions;
  for (const std::string& joint : joints) {
    positions.push_back(within(joint, choices.between(-0.1, 1.1)));
  }
  const auto how = static_cast<EndedHow>(choices.below(6));
  if (choices.once(6)) {
    const int kind = choices.below(6);
    client_.meanwhile = [this, kind] {
      const auto none = aibo_client::FaultKind::kNone;
      switch (kind) {
        case 0:
          throw aibo_client::TimeoutException("late.", none, true);
        case 1:
          throw aibo_client::NetworkException("it broke.", none, true);
        case 2:
          throw aibo_client::CommandException("It is busy.");
        case 3:
          return stop("/meanwhile");
        case 4:
          return disconnect();
        case 5:
          return ended(EndedKind::kMotion, EndedHow::kDone, "NOD.MTN");
      }
    };
  }
  client_.problem = choices.once(12) ? "it is far away" : "";
  switch (choices.below(7)) {
    case 0:
      command(source, joints, positions, {}, choices.once(4) ? Kind::kLookAt : Kind::kCommand);
      break;
    case 1:
      follow(source, joints, positions, choices.between(0.5, 3), choices.once(2) ? 0 : choices.below(2000));
      break;
    case 2:
      play(source, choices.of(kMotions));
      break;
    case 3:
      take(source, static_cast<Posture>(choices.below(3)));
      break;
    case 4:
      walkToGoal(source);
      walkOn(begun_.back(), choices.once(3) ? 0 : choices.between(-0.1, 0.1));
      break;
    default:
      steer(source, choices.once(8) ? 0 : choices.between(-0.1, 0.1));
  }
  if (choices.once(2)) {
    steered(choices.once(5) ? 0 : 0.1);
  }
  if (choices.once(4)) {
    choices.once(5) ? holdUp(700) : pass(choices.below(700));
  }
  const Mover::Begun some = begun_.empty() ? Mover::Begun() : choices.once(2) ? begun_.back() : choices.of(begun_);
  switch (choices.below(16)) {
    case 0:
      walkOn(some, choices.once(3) ? 0 : choices.between(-0.1, 0.1));
      break;
    case 1:
      stop(source);
      break;
    case 2:
      hold();
      break;
    case 3:
      setMotors(choices.once(2));
      break;
    case 4:
      cancel(some);
      break;
    case 5:
      stopMotion(choices.once(3) ? "" : choices.of(kMotions));
      break;
    case 6:
    case 7:
      stopWalking();
      break;
    case 8:
      ended(EndedKind::kWalk, how, "walk", "the robot says so");
      break;
    case 9:
      ended(choices.once(2) ? EndedKind::kMotion : EndedKind::kPosture, how,
            choices.once(2) ? choices.of(kMotions) : "stand", "the robot says so");
      break;
    case 10:
    case 11:
      refused(choices.once(2) ? RefusedRequest::kWalk : RefusedRequest::kJoints,
              static_cast<RefusalCause>(choices.below(5)), {table_[*table_.findByName(joints[0])].id},
              choices.once(2) ? 0 : some.id);
      break;
    case 12:
      answeredLate(some, choices.once(2));
      break;
    case 13:
      robotChanged(static_cast<MotorState>(choices.below(3)), static_cast<PostureNow>(choices.below(7)));
      break;
    case 14:
      choices.once(3) ? disconnect() : choices.once(2) ? connect() : connectUnnoticed();
      break;
    case 15:
      client_.can_hold = choices.once(2);
      telemetry_ = !choices.once(4);
      stuck_ = choices.once(2) ? std::to_string(table_[*table_.findByName(joints[0])].id) : "";
      client_.present.robot.capabilities.clear();
      table_.setSpeedScale(choices.between(0.1, 1));
      break;
  }
  const std::string after = std::exchange(log_, "");
  if (was_stopped && mover_.state().stopped_by) {
    for (const std::string forbidden :
         {"-> play", "-> stand", "-> sit", "-> motors on", "-> steer 0.1", "-> steer -"}) {
      EXPECT_EQ(after.find(forbidden), std::string::npos) << after;
    }
  }
  return after;
}

TEST(MoverHistoryTest, WhateverWasBeforeAMoverThatBeginsAnewDoesTheSameAsANewOne) {
  test_support::expectAsNewAfterAnyHistory<Session>(Session::kWaysToRenew, 20, 10);
}

}  // namespace
}  // namespace aibo_driver::movement
