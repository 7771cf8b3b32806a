// How orders get from a user's thread to the client's, and how they end with connections.

#include <atomic>
#include <mutex>

#include "client_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_support::kSafetyNet;
using version2_frames::describe;
using version2_frames::makeFrame;

namespace {

class Orders : public ClientFixture {
 protected:
  /// The motion's call ends, because its connection does.
  static bool wasSent(std::future<std::string>* motion) {
    try {
      motion->get();
    } catch (const NetworkException& error) {
      return error.wasSent();
    }
    return ADD_FAILURE() << "not thrown", false;
  }
};

TEST_F(Orders, ATargetWithASpeedFirstLimitsItsJointOverEachConnection) {
  for (int i = 0; i < 2; ++i) {
    ScriptedPeer peer = connectVersion2();
    client_.commandJoints({{1, 0.1, 2.0}, {2, 0.1}, {4, 0.1, 0.5}}, milliseconds(0));
    EXPECT_EQ("V 0 1 0 0 0 0 30 132 128 4 0 0 0 0 7 161 32", describe(peer.readRequest()))
        << "joint 1 at 2 rad/s, joint 4 at 0.5 rad/s";
    EXPECT_EQ('J', peer.readRequest().header.kind);
  }
}

TEST_F(Orders, HaveTheirNumbersAndTheirTimes) {
  ScriptedPeer peer = connectVersion2();
  const auto refuse = [&peer](char kind) {
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_EQ(kind, request.header.kind);
    peer.send(makeFrame('e', request.header.request_number, version2_frames::makeError(3, std::string(1, kind))));
  };
  using TimePoint = std::chrono::steady_clock::time_point;
  const TimePoint never = TimePoint::max();
  client_.commandJoints({{1, 0.1}}, milliseconds(0), {never, 71});
  refuse('J');
  client_.steer({0.1, 0, 0}, {never, 72});
  refuse('S');
  auto posture = client_.beginPosture(Posture::kSit, kSafetyNet, {never, 73});
  refuse('E');
  EXPECT_THROW(posture.get(), CommandException);
  EXPECT_THAT(recorder_.reports().orders, testing::EndsWith("73:E; ")) << "before its call ends";
  auto motion = client_.beginMotion("NOD.MTN", 1, kSafetyNet, {never, 74});
  refuse('P');
  EXPECT_THROW(motion.get(), CommandException);
  client_.steer({0.0004, 0, -0.0004}, {TimePoint(), 79});
  EXPECT_THAT(describe(peer.readRequest()), testing::EndsWith(" 0 0 0 0 0 0 0 0")) << "zeros are never too old";
  client_.commandJoints({{2, 0.1}}, milliseconds(0), {TimePoint(), 75});
  client_.steer({0, 0.1, 0}, {TimePoint(), 76});
  const std::string too_old =
      "too old: it could not be sent to 127.0.0.1:" + std::to_string(server_.port()) + " in time";
  const std::string told = "71:J; 72:S; 73:E; 74:P; 75:" + too_old + "; 76:" + too_old + "; ";
  EXPECT_TRUE(eventually([&] { return recorder_.reports().orders == told; })) << recorder_.reports().orders;
  EXPECT_THROW(client_.takePosture(Posture::kSit, kSafetyNet, {TimePoint(), 77}), CommandException);
  EXPECT_THAT(refusalOf<CommandException>([&] {
                client_.playMotion("NOD.MTN", 1, kSafetyNet, {TimePoint(), 78});
              }),
              testing::HasSubstr("is " + too_old));
  EXPECT_THROW(client_.setMotors(true, kSafetyNet, {TimePoint(), 80}), CommandException);
  auto off = client_.beginMotors(false, kSafetyNet, {TimePoint(), 81});
  EXPECT_EQ('O', peer.readRequest().header.kind) << "it is never too late to switch them off";
  EXPECT_THAT(recorder_.reports().orders, testing::Not(testing::HasSubstr("80:"))) << "no order to follow";
}

// It counts its frames from 0 again.
TEST_F(Orders, ToARobotThatWasRestartedAreGoodUntilAFrameOfItsNewCount) {
  const auto not_after = [this](ScriptedPeer* peer) {
    client_.commandJoints({{1, 0.1}}, milliseconds(0));
    const version2_frames::Frame request = peer->readRequest();
    EXPECT_EQ('J', request.header.kind);
    return protocol::decodeBigEndian32(request.payload.data());
  };
  ScriptedPeer before = connectVersion2();
  before.send(makeFrame('t', 0, version2_frames::makeTelemetry(3000000, {{'J', 1, 0}})));
  ASSERT_TRUE(eventually([this] { return !recorder_.reports().telemetry.empty(); }));
  EXPECT_GE(not_after(&before), 3000000u);
  before.close();
  EXPECT_TRUE(recorder_.waitForState(ConnectionState::kDisconnected));
  ScriptedPeer after = connectVersion2();  // in frame 1000
  EXPECT_LT(not_after(&after), 3000u);
}

TEST_F(Orders, EndWithTheirConnectionWithoutACall) {
  ScriptedPeer peer = connectVersion2();
  const auto later = std::chrono::steady_clock::now() + kSafetyNet;
  auto sent = client_.beginMotion("NOD.MTN", 1, kSafetyNet, {later, 71});
  EXPECT_EQ('P', peer.readRequest().header.kind);
  auto unsent = client_.beginMotion("SIT.MTN", 1, kSafetyNet, {later, 72});
  client_.commandJoints({{1, 0.1}}, milliseconds(0), {later, 73});
  EXPECT_EQ('J', peer.readRequest().header.kind);
  peer.close();
  EXPECT_TRUE(wasSent(&sent));
  EXPECT_FALSE(wasSent(&unsent));
  EXPECT_THROW(client_.beginMotion("NOD.MTN", 1, kSafetyNet, {later, 74}), NetworkException);
  EXPECT_EQ("", recorder_.reports().orders);
}

// Some are sent, some wait for an answer, and some have not reached the client's thread, which is kept in a callback
// until the connection has ended.
TEST_F(Orders, DoNotOutliveTheConnection) {
  std::promise<void> in_callback;
  std::promise<void> release;
  Callbacks callbacks = recorder_.callbacks();
  callbacks.on_telemetry = [&](const Telemetry&) {
    in_callback.set_value();
    release.get_future().wait();
  };
  RcServerClient client(optionsFor(server_), callbacks);
  ScriptedPeer peer = connectVersion2(&client);
  const auto give_orders = [&client] {
    for (int i = 1; i < 10; ++i) {
      client.commandLeds({{i, 100}});
      client.commandEars(true, true);
      client.commandJoints({{i, 0.1}}, milliseconds(0));
      client.steer({});
      client.steer({0.01 * i, 0, 0});
    }
  };
  give_orders();
  peer.send(makeFrame('t', 0, version2_frames::makeTelemetry(7, {{'J', 1, 0}})));
  in_callback.get_future().wait();
  give_orders();
  peer.reset();
  release.set_value();
  EXPECT_TRUE(recorder_.waitForState(ConnectionState::kDisconnected));
  ScriptedPeer next = connectVersion2(&client);
  client.commandLeds({{200, 1}});
  EXPECT_EQ("L 0 200 1 0 0", describe(next.readRequest())) << "the first that is sent";
}

// The client's thread is kept in a callback, so that it finds both orders at once.
TEST_F(Orders, AreNotSentAfterAHoldThatCameAfterThem) {
  std::mutex gate;
  std::atomic<bool> waits{false};
  Callbacks callbacks = recorder_.callbacks();
  callbacks.on_telemetry = [&](const Telemetry&) {
    waits = true;
    const std::lock_guard<std::mutex> lock(gate);
  };
  RcServerClient client(optionsFor(server_), callbacks);
  ScriptedPeer peer = connectVersion2(&client);
  const auto answer = [&peer] {
    version2_frames::Frame frame = peer.readRequest();
    if (frame.header.kind == 'J') {
      frame.payload.erase(frame.payload.begin(), frame.payload.begin() + 4);
    }
    peer.send(makeFrame(protocol::version2::replyKind(frame.header.kind), frame.header.request_number, frame.payload));
    return frame.header.kind;
  };
  char first = 'J';
  for (int i = 0; i < 20 && first == 'J'; ++i) {  // it is sent if the thread of hold() came too late
    std::unique_lock<std::mutex> lock(gate);
    waits = false;
    ASSERT_TRUE(eventually([&] {
      peer.send(makeFrame('t', 0, version2_frames::makeTelemetry(7, {{'J', 1, 0}})));
      return waits.load();
    }));
    client.commandJoints({{1, 0.1}}, milliseconds(0));
    auto held = std::async(std::launch::async, [&client] { client.hold({}, kSafetyNet); });
    EXPECT_EQ(std::future_status::timeout, held.wait_for(milliseconds(20 + 50 * i)));
    lock.unlock();
    first = answer();
    EXPECT_EQ('I', first == 'J' ? answer() : first);
    held.get();
  }
  client.commandLeds({{7, 1}});
  EXPECT_EQ('L', answer());
}

}  // namespace
