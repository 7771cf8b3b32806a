#include <gmock/gmock.h>

#include <cmath>
#include <future>

#include "newest_client_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using version2_frames::makeFrame;

namespace {

const std::string kWalks = "F W J V T I L K S E";

/// Walking and postures.
class WalkTest : public NewestClientFixture {};

TEST_F(WalkTest, ARobotIsSteeredWithoutWaiting) {
  ScriptedPeer peer = connectVersion2(kWalks);
  client().steer({0.1, 0, -0.5});
  const version2_frames::Frame frame = peer.readRequest();
  EXPECT_EQ('S', frame.header.kind);
  EXPECT_THAT(frame.payload, ElementsAre(0, 100, 0, 0, 0xfe, 0x0c, 0, 0));
}

TEST_F(WalkTest, WithoutAConnectionSteeringIsRefusedAndNotKept) {
  EXPECT_THROW(client().steer({0.1, 0, 0}), NetworkException);
  ScriptedPeer peer = connectVersion2(kWalks);
  client().commandEars(true, false);
  EXPECT_EQ('K', peer.readRequest().header.kind);
}

TEST_F(WalkTest, AServerThatCannotWalkIsNotAsked) {
  {
    ScriptedPeer peer = connectVersion2("F W J V T L K");
    EXPECT_THAT(complaintOf<CommandException>([&] {
                  client().steer({0.1, 0, 0});
                }),
                HasSubstr("(a test 1.0) has no request to walk; this needs an ERS-7 with a newer RCServer"));
    EXPECT_THAT(complaintOf<CommandException>([&] { client().takePosture(Posture::kSit, seconds(20)); }),
                HasSubstr("(a test 1.0) has no request to take postures"));
  }
  ScriptedPeer peer = connectVersion1();
  ASSERT_TRUE(eventually([&] { return client().status().protocol_version == 1; }));
  EXPECT_THAT(complaintOf<CommandException>([&] {
                client().steer({0.1, 0, 0});
              }),
              HasSubstr("speaks version 1 of the protocol, which has no request to walk"));
  EXPECT_THAT(complaintOf<CommandException>([&] { client().takePosture(Posture::kSit, seconds(20)); }),
              HasSubstr("speaks version 1 of the protocol, which has no request to take postures"));
}

TEST_F(WalkTest, APostureIsAnsweredWhenItHasBegun) {
  ScriptedPeer peer = connectVersion2(kWalks);
  for (const Posture posture : {Posture::kStand, Posture::kSit, Posture::kRest}) {
    auto taken = std::async(std::launch::async, [&] { client().takePosture(posture, seconds(20)); });
    const version2_frames::Frame frame = peer.readRequest();
    EXPECT_EQ('E', frame.header.kind);
    EXPECT_EQ(1 + static_cast<int>(posture), frame.header.id);
    peer.send(makeFrame('e', frame.header.request_number, {}));
    taken.get();
  }
  auto refused = std::async(std::launch::async, [&] { client().takePosture(Posture::kStand, seconds(20)); });
  const version2_frames::Frame frame = peer.readRequest();
  peer.send(makeFrame('e', frame.header.request_number, version2_frames::makeError(0, "it is carried")));
  EXPECT_THAT(complaintOf<CommandException>([&] { refused.get(); }),
              HasSubstr("refused to take the posture stand: it is carried"));
}

TEST_F(WalkTest, AVelocityThatTheProtocolCannotSayIsRefused) {
  for (const double value : {32.768, -32.768, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(client().steer({value, 0, 0}), InvalidArgumentException) << value;
    EXPECT_THROW(client().steer({0, value, 0}), InvalidArgumentException) << value;
    EXPECT_THROW(client().steer({0, 0, value}), InvalidArgumentException) << value;
  }
  EXPECT_THROW(client().steer({32.767, -32.767, 0}), NetworkException) << "not connected";
  EXPECT_THROW(client().takePosture(Posture::kStand, milliseconds(0)), Exception);
}

}  // namespace
