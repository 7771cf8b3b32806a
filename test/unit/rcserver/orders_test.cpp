// Orders of version 2: each ends once, with its number and before the reply that caused its end, and none is carried
// out that is too old. A walk begins only after zeros.

#include <tuple>

#include "motion_bytes.h"
#include "rcserver/FrameClock.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr int kHeadPanId = 2;
constexpr int kKneeId = 13;  // left_front_knee

std::string velocity(int forward) {
  return payloadOf(SteeringReply{{forward * 1e-3, 0, 0}, 0});
}

// A request without its number.
struct Asked {
  char kind;
  int id;
  std::string payload;
};

const Asked kMovePan = {'J', 0, order(targetsOf({{kHeadPanId, 300000}}))};
const Asked kMoveKnee = {'J', 0, order(targetsOf({{kKneeId, 500000}}))};
const Asked kHoldAll = {'I', HOLD_EVERYTHING, ""};
const Asked kHoldKnee = {'I', HOLD_JOINTS, {1, kKneeId}};
const Asked kHoldPan = {'I', HOLD_JOINTS, {1, kHeadPanId}};
const Asked kOff = {'O', 0, order(std::string(1, '\0'))};
const Asked kOn = {'O', 0, order("\1")};
const Asked kPlayHead = {'P', 0, playPayload("HEAD.MTN", 100)};
const Asked kPlayLegs = {'P', 0, playPayload("LEGS.MTN", 100)};
const Asked kStopMotions = {'P', 0, playPayload("", 0)};
const Asked kStopHead = {'P', 0, playPayload("HEAD.MTN", 0)};
const Asked kSit = {'E', POSTURE_SIT, order()};
const Asked kRest = {'E', POSTURE_REST, order()};
const Asked kWalk = {'S', 0, order(velocity(100))};
const Asked kLetGo = {'S', 0, order(velocity(0))};

class OrdersTest : public Version2Fixture {
 protected:
  void SetUp() override {
    stick_.write("OPEN-R/MW/DATA/P/HEAD.MTN", motionBytes("at 0 head_pan 0\nat 1600 head_pan 20\n"));
    stick_.write("OPEN-R/MW/DATA/P/LEGS.MTN", motionBytes("at 0 left_front_knee 60\nat 1600 left_front_knee 80\n"));
    Version2Fixture::SetUp();
  }

  void ask(int number, const Asked& asked) { send(frame(asked.kind, asked.id, number, asked.payload)); }

  // Asks, and waits until the file that is needed has been read.
  std::vector<std::string> answersTo(int number, const Asked& asked) {
    ask(number, asked);
    std::vector<std::string> all = heard();
    for (int i = 0; i < 3 && asked.kind == 'P'; ++i) {
      passFrames(4);
      for (const std::string& next : heard()) {
        all.push_back(next);
      }
    }
    return all;
  }

  // The walk's number in the reply to S.
  int walkAfter(int number, const Asked& asked) {
    ask(number, asked);
    for (const Frame& next : arrived()) {
      SteeringReply steered = {};
      if (next.header.kind == 's' && decode(next.payload.data(), next.payload.size(), &steered) == nullptr) {
        return steered.walk;
      }
    }
    return -1;
  }

  void beginWalk(int number) {
    ask(900, kLetGo);
    ask(number, kWalk);
    for (int passed = 0; passed < 500; passed += 12) {  // no walk ends because the client is silent
      ask(901, kWalk);
      passFrames(12);
    }
    heard();
  }
};

TEST_F(OrdersTest, EndOnceWithTheirNumbersBeforeTheReplyThatCausesIt) {
  const struct {
    Asked order;
    Asked then;
    std::vector<std::string> answers;
  } rows[] = {
      {kMovePan, kMovePan, {"i1 1", "j2"}},   {kMovePan, kHoldPan, {"i1 2", "i2"}},
      {kMovePan, kHoldAll, {"i1 2", "i2"}},   {kMovePan, kOff, {"i1 2", "o2"}},
      {kMovePan, kPlayHead, {"i1 1", "p2"}},  {kMoveKnee, kSit, {"i1 1", "e2"}},
      {kPlayHead, kMovePan, {"i1 1", "j2"}},  {kPlayHead, kHoldPan, {"i1 2", "i2"}},
      {kPlayHead, kHoldAll, {"i1 2", "i2"}},  {kPlayHead, kStopMotions, {"i1 2", "p2"}},
      {kPlayHead, kStopHead, {"i1 2", "p2"}}, {kPlayHead, kOff, {"i1 2", "o2"}},
      {kPlayHead, kRest, {"i1 1", "e2"}},     {kPlayLegs, kSit, {"i1 1", "e2"}},
      {kSit, kMoveKnee, {"i1 1", "j2"}},      {kSit, kHoldKnee, {"i1 2", "i2"}},
      {kSit, kHoldAll, {"i1 2", "i2"}},       {kSit, kRest, {"i1 1", "e2"}},
      {kSit, kPlayLegs, {"i1 1", "p2"}},      {kSit, kOff, {"i1 2", "o2"}},
      {kWalk, kMoveKnee, {"i1 1", "j2"}},     {kWalk, kHoldKnee, {"i1 2", "i2"}},
      {kWalk, kHoldAll, {"i1 2", "i2"}},      {kWalk, kPlayLegs, {"i1 1", "p2"}},
      {kWalk, kSit, {"i1 1", "e2"}},          {kWalk, kOff, {"i1 2", "o2"}},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(std::to_string(&row - rows) + ": " + row.order.kind + " then " + row.then.kind);
    answersTo(100, kOn);
    answersTo(101, kLetGo);
    passFrames(20);
    EXPECT_THAT(answersTo(1, row.order), ElementsAre(std::string(1, replyKind(row.order.kind)) + "1"));
    passFrames(4);
    EXPECT_EQ(answersTo(2, row.then), row.answers);
    passFrames(4);
    EXPECT_THAT(heard(), Not(Contains(StartsWith("i1 "))));
    answersTo(102, kHoldAll);
    passFrames(100);
    heard();
  }
}

TEST_F(OrdersTest, AreDoneWithTheirNumbers) {
  EXPECT_THAT(answersTo(1, kMovePan), ElementsAre("j1"));
  passFrames(200);
  EXPECT_THAT(heard(), ElementsAre("i1 0"));
  EXPECT_THAT(answersTo(2, {'P', 0, playPayload("HEAD.MTN", 1)}), ElementsAre("p2"));
  passFrames(300);
  EXPECT_THAT(heard(), ElementsAre("i2 0"));
  EXPECT_THAT(answersTo(3, kSit), ElementsAre("e3"));
  passFrames(500);
  EXPECT_THAT(heard(), ElementsAre("i3 0"));
  beginWalk(4);
  ask(5, kLetGo);
  EXPECT_THAT(heard(), ElementsAre("s5"));
  passFrames(250);
  EXPECT_THAT(heard(), ElementsAre("i4 0")) << "when it stands";
  EXPECT_THAT(answersTo(6, {'J', 0, order(payloadOf(JointTargets{0, 0, {}}))}), ElementsAre("i6 0", "j6"));
  beginWalk(7);
  ask(8, kLetGo);
  EXPECT_THAT(answersTo(9, kSit), ElementsAre("s8", "i7 0", "e9")) << "or when a posture is asked for";
}

TEST_F(OrdersTest, ThatAreRefusedEndByTheErrorAloneAndMoveNothing) {
  const std::vector<int> before = positions();
  answersTo(1, kOff);
  for (const Asked& asked : {kMovePan, kPlayHead, kWalk, kRest}) {
    EXPECT_THAT(answersTo(2, asked), ElementsAre(StartsWith("e2 0 the motors are off")));
    passFrames(20);
    EXPECT_THAT(heard(), IsEmpty());
  }
  EXPECT_THAT(answersTo(3, kHoldAll), ElementsAre("i3")) << "there is nothing to stop";
  answersTo(4, kOn);
  passFrames(500);
  EXPECT_EQ(positions(), before);
}

TEST_F(OrdersTest, OfAClientThatHasGoneAreNotToldButForARestThatGoesOn) {
  answersTo(7, kPlayHead);
  answersTo(8, kRest);
  passFrames(20);
  reconnect();
  passFrames(1000);
  EXPECT_THAT(heard(), ElementsAre("i0 0"));
}

// Every joint has an order of its own, all end at once, and the client does not read.
TEST_F(OrdersTest, AreAllToldToAClientThatReadsSlowly) {
  connectBehindAPicture();
  std::string requests;
  std::vector<std::string> expected;
  for (int i = 0; i < robot_.model.number_of_joints; ++i) {
    requests += frame('J', 0, i + 1, order(targetsOf({{robot_.model.joints[i].identifier, -400000}})));
    expected.push_back("i" + std::to_string(i + 1) + " 2");
  }
  send(requests + frame('I', HOLD_EVERYTHING, 100));
  passFrames(12);
  std::vector<std::string> ends;
  for (std::optional<Frame> next = nextFrame(); next && next->header.request_number != 100; next = nextFrame()) {
    if (next->header.kind == 'i') {
      ends.push_back("i" + std::to_string(next->payload.at(3)) + " " + std::to_string(next->payload.at(1)));
    }
  }
  EXPECT_THAT(ends, ::testing::UnorderedElementsAreArray(expected));
  passFrames(300);
  EXPECT_THAT(heard(), IsEmpty()) << "each once";
}

TEST_F(OrdersTest, ToWalkBeginAnotherWalkWhileOneIsEnding) {
  EXPECT_EQ(walkAfter(9, kLetGo), 0);
  for (const bool is_let_go : {true, false}) {
    beginWalk(1);
    EXPECT_EQ(walkAfter(2, kWalk), 1);
    is_let_go ? ask(3, kLetGo) : passFrames(66);
    EXPECT_THAT(answersTo(20, kWalk), Contains(is_let_go ? "i1 0" : "i1 2"));
    EXPECT_EQ(walkAfter(21, kWalk), 20);
    answersTo(22, kHoldAll);
  }
}

TEST_F(OrdersTest, DemandLettingGoIfTheyTakeOrHoldALeg) {
  const std::tuple<const char*, std::vector<Asked>, bool> rows[] = {
      {"nothing", {}, false},
      {"J of the head", {kMovePan}, false},
      {"I of the head", {kHoldPan}, false},
      {"P of the head", {kPlayHead}, false},
      {"J of a leg", {kMoveKnee}, true},
      {"I of a leg", {kHoldKnee}, true},
      {"I of all", {kHoldAll}, true},
      {"P of a leg", {kPlayLegs}, true},
      {"E", {kSit}, true},
      {"O 0", {kOff, kOn}, true},
      {"O 0 again", {kOff, kLetGo, kOff, kOn}, true},
      {"S that is refused", {kOff, kLetGo, kWalk, kOn}, true},
      {"S that is too old", {{'S', 0, order(velocity(100), 1)}}, false},
  };
  for (const auto& [name, orders, demands] : rows) {
    SCOPED_TRACE(name);
    answersTo(1, kLetGo);
    for (const Asked& asked : orders) {
      answersTo(2, asked);
    }
    passFrames(400);  // silence does not count as letting go
    heard();
    EXPECT_THAT(answersTo(3, kWalk), Contains(demands ? HasSubstr("let go first") : HasSubstr("s3")));
    answersTo(4, kLetGo);
    EXPECT_THAT(answersTo(5, kWalk), Contains("s5"));
    answersTo(6, kHoldAll);
    passFrames(20);
    heard();
  }
  reconnect();
  EXPECT_THAT(answersTo(1, kWalk), ElementsAre(HasSubstr("the connection is new; let go first")));
}

TEST(FrameClock, MistrustsWhatComesAfterAPauseOfHalfASecondFor100Milliseconds) {
  for (const unsigned pause : {499U, 500U}) {
    FrameClock clock;
    clock.Report(100, 1000);
    clock.Present(1000 + pause);
    EXPECT_EQ(clock.MayHaveWaited(), pause == 500);
    clock.Present(1000 + pause + 99);
    EXPECT_EQ(clock.MayHaveWaited(), pause == 500);
    clock.Present(1000 + pause + 100);
    EXPECT_FALSE(clock.MayHaveWaited());
  }
}

TEST_F(OrdersTest, ToWalkThatAreTooOldDoNotSteer) {
  beginWalk(1);
  for (int passed = 0; passed < 72; passed += 12) {
    EXPECT_THAT(answersTo(2, {'S', 0, order(velocity(100), 1)}), ElementsAre(StartsWith("e2 5 too old")));
    passFrames(12);
  }
  EXPECT_EQ(walkAfter(3, kWalk), 3) << "the walk was ending";
}

TEST_F(OrdersTest, AreRefusedWhenTheyAreTooOldButForThoseThatStop) {
  const std::string on_pan = targetsOf({{kHeadPanId, 300000}});
  const std::tuple<char, int, std::string> kinds[] = {{'J', 0, on_pan},
                                                      {'S', 0, velocity(100)},
                                                      {'E', POSTURE_SIT, ""},
                                                      {'P', 0, std::string("\0\1HEAD.MTN", 10)},
                                                      {'O', 0, "\1"}};
  for (const auto& [kind, id, payload] : kinds) {
    answersTo(1, kLetGo);
    passFrames(100);  // what came before brakes
    heard();
    const std::vector<int> before = positions();
    const unsigned soon = clock_.frame() + 25;
    client_->send(frame(kind, id, 2, order(payload, soon)) + frame('I', HOLD_EVERYTHING, 3));
    clock_.step(100);  // while a process is stopped, what the client sends waits
    EXPECT_THAT(heard(), ElementsAre(StartsWith("e2 5 too old"), "i3")) << kind;
    passFrames(20);
    EXPECT_EQ(positions(), before) << kind;
    answersTo(4, kLetGo);
    EXPECT_THAT(answersTo(5, {kind, id, order(payload, clock_.frame() + 8)}),
                Contains(std::string(1, replyKind(kind)) + "5"));
    answersTo(6, kHoldAll);
  }
  const std::string old(4, '\0');
  EXPECT_THAT(answersTo(5, {'S', 0, old + velocity(0)}), ElementsAre("s5"));
  EXPECT_THAT(answersTo(6, {'P', 0, old + std::string(2, '\0')}), ElementsAre("p6"));
  EXPECT_THAT(answersTo(7, {'O', 0, old + std::string(1, '\0')}), ElementsAre("o7"));
}

TEST_F(OrdersTest, ToPlayMayBeFiveSecondsOlderWhenTheirFilesHaveBeenRead) {
  for (const bool is_too_old : {false, true}) {
    file_keeper_.slowDown();
    ask(1, {'P', 0, playPayload("HEAD.MTN", 1, clock_.frame() + 12)});
    ASSERT_TRUE(file_keeper_.hasJob());
    for (int second = 0; second < 5; ++second) {
      FakeRobotFixture::answerTo('H', 0);
      passFrames(kFramesASecond);
    }
    passFrames(is_too_old ? 16 : 4);
    heard();
    file_keeper_.speedUp();
    passFrames(4);
    EXPECT_THAT(heard(), ElementsAre(is_too_old ? StartsWith("e1 5 too old") : StartsWith("p1")));
    answersTo(2, kHoldAll);
  }
}

}  // namespace
