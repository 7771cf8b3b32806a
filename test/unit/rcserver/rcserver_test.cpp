// Clients, pictures, joints and requests of version 1, and the motors at boot.

#include "picture_checks.h"
#include "protocol/units.h"
#include "rcserver_fixture.h"

namespace {

using protocol::centidegreesFromMicroradians;
using protocol::microradiansFromCentidegrees;
using robot_model::Joint;
using ::testing::Each;
using ::testing::HasSubstr;

constexpr unsigned kImagesUntilSilent = 1250 / FakeRobot::kFramesPerImage;  // 10 s

class RCServerTest : public FakeRobotFixture {
 protected:
  void SetUp() override { start(); }

  // Takes an image, and checks the picture of it that the client gets.
  void expectPictureOfNextImage(TestClient& client, int quality) {
    takeImage();
    const std::optional<Reply> reply = await(client);
    ASSERT_TRUE(reply && reply->letter == protocol::REPLY_PICTURE);
    EXPECT_EQ(quantizerOf(reply->jpeg), quantizerFor(quality));
    EXPECT_NEAR(decodeJpeg(reply->jpeg).level(), FakeRobot::brightness(robot_.lastImage()), 3);
    machine_->runPending();
  }

  void expectNoPictureOfNextImage(TestClient& client) {
    takeImage();
    ask(client, "");
    EXPECT_FALSE(client.next());
  }
};

const std::string kPicture = request('F', 70);
const std::string kStream = request('W', 80);

struct Cell {
  std::string before;          // requests that lead to the state
  std::string event;           // a request; empty for a camera image
  std::vector<int> qualities;  // of the pictures of the next camera images; 0: no picture of it
};

const Cell kCells[] = {
    {"", request('F', 20), {20, 0, 0}},
    {"", request('W', 30), {30, 30, 30}},
    {"", "", {0, 0}},
    {kPicture, request('F', 20), {70, 20, 0, 0}},
    {kPicture, request('W', 30), {70, 30, 30}},
    {kPicture, "", {70, 0, 0}},
    {kStream, request('F', 20), {20, 80, 80}},
    {kStream, request('W', 30), {0, 0, 0}},
    {kStream, "", {80, 80, 80}},
    {kStream + kStream, request('F', 20), {20, 0, 0}},
    {kStream + kStream, request('W', 30), {30, 30, 30}},
    {kStream + kStream, "", {0, 0}},
    {kStream + kPicture + kStream, "", {0, 70, 0, 0}},
    {"", request('F', 255), {100, 0}},
};

TEST_F(RCServerTest, SendsPicturesAsInTheTable) {
  for (const Cell& cell : kCells) {
    SCOPED_TRACE(cell.before + ", " + cell.event);
    client_ = connectServed();
    ask(*client_, cell.before + cell.event);
    for (const int quality : cell.qualities) {
      quality > 0 ? expectPictureOfNextImage(*client_, quality) : expectNoPictureOfNextImage(*client_);
    }
    disconnect();
  }
}

TEST_F(RCServerTest, PictureRequestsBeyondTheLimitAreAnsweredByAnError) {
  constexpr int limit = 256;
  auto client = connectServed();
  std::string requests;
  for (int i = 0; i < limit + 10; ++i) {
    requests += request('F', 85);
  }
  client->send(requests);
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(awaitLetter(*client), protocol::REPLY_ERROR);
  }
  machine_->runPending();
  for (int i = 0; i < limit; ++i) {
    expectPictureOfNextImage(*client, 85);
  }
  expectNoPictureOfNextImage(*client);
}

TEST_F(RCServerTest, UnknownRequestsAreAnsweredByErrorZero) {
  client_ = connectServed();
  for (const std::string& bytes :
       {request('X', 3), request('J', 0), request('J', 9) + "ab", request('S', 10), request('V', 0), request('A', 60),
        request('L', 27, 1), request('K', 0, 2), request('K', 3, 1), request('S', 0, 1), request('Q', 0) + "ab",
        request('R', 0) + "ab", request('f', 85), request('J', 5), request('J', 255, 1), request('V', 14),
        request('V', 1, 0), request('V', 1, -1), request('A', 1, -32768), request('S', 91), request('S', 66, 2),
        // of version 2 alone
        request('B', 0), request('E', 1), request('G', 1), request('H', 0), request('I', 0), request('M', 85),
        request('N', 0), request('O', 1), request('T', 0), request('Z', 0)}) {
    expectError(bytes);
    EXPECT_FALSE(client_->next()) << "a second answer to " << bytes;
  }
}

TEST_F(RCServerTest, ClientThatOnlyReadsItsStreamIsNotSilent) {
  auto first = connectServed();
  ask(*first, request('W', 85));
  for (unsigned i = 0; i < kImagesUntilSilent + 10; ++i) {
    takeImage();
    while (first->next()) {
    }
  }
  auto second = connect();
  takeImage();
  EXPECT_TRUE(second->ended());
  EXPECT_TRUE(first->next());
  expectPictureOfNextImage(*first, 85);
}

TEST_F(RCServerTest, ClientThatOnlySendsIsNotSilent) {
  auto first = connectServed();
  const std::string bytes = fileRequest('P', "NOD.MTN", 1);
  for (std::size_t i = 0; i + 1 < bytes.size(); ++i) {  // the request is never complete, so there is no answer
    first->send(bytes.substr(i, 1));
    passFrames(100);
  }
  auto second = connect();
  passFrames(4);
  EXPECT_TRUE(second->ended());
}

TEST_F(RCServerTest, ClientThatDoesNotReadItsStreamIsReplacedByTheNext) {
  robot_.showNoise();
  auto first = connect(4096);
  first->send(request('W', 100));
  passFrames((kImagesUntilSilent + 20) * FakeRobot::kFramesPerImage);
  auto second = connectServed();
  EXPECT_TRUE(awaitEnd(*first));
}

constexpr int kNeckTilt = 1;
constexpr int kHeadPan = 2;
constexpr int kTailPan = 51;
constexpr int kTailTilt = 52;

// More than enough for any motion with the standard limits.
constexpr unsigned kLongestWay = 500;

class JointsTest : public Version1Fixture {};

TEST_F(JointsTest, GainsGoOnOnlyAfterThePresentPositionsWereCommanded) {
  machine_.reset();
  for (FakeRobot::FakeJoint& joint : robot_.joints) {
    joint.gain = false;
    joint.gains = {};
    joint.reference = 12345;  // an earlier program's last command
    joint.path.clear();
  }
  start();
  for (size_t i = 0; i < robot_.joints.size(); ++i) {
    const FakeRobot::FakeJoint& joint = robot_.joints[i];
    const robot_model::PidGains& gains = robot_.model.joints[i].gains;
    EXPECT_TRUE(joint.gain);
    EXPECT_EQ(joint.error_when_gain_went_on, 0);
    EXPECT_THAT(joint.path, Each(joint.path.front()));
    EXPECT_EQ(std::memcmp(&joint.gains, &gains, sizeof(gains)), 0);
  }
  EXPECT_TRUE(robot_.powered);
}

TEST_F(JointsTest, StayLimpWhateverAClientCommandsIfTheMotorsAreOffAtBoot) {
  for (FakeRobot::FakeJoint& joint : robot_.joints) {
    joint.gain = false;
  }
  robot_.powered = false;
  startWith("MOTORS_AT_BOOT=no");
  expectError(request('J', kHeadPan, 1000));
  expectError(request('J', 0, 1000));
  passFrames(kLongestWay);
  EXPECT_TRUE(isLimp());
  EXPECT_FALSE(robot_.powered);
}

TEST_F(JointsTest, EveryJointIsReadAndSetByItsIdentifier) {
  for (size_t i = 0; i < robot_.joints.size(); ++i) {
    const Joint& joint = robot_.model.joints[i];
    SCOPED_TRACE(joint.name);
    const std::vector<int> before = positions();
    const short target = centidegreesFromMicroradians(before[i] + (joint.highest - before[i]) / 4);
    expectAnswer(request('J', joint.identifier), 'j', joint.identifier,
                 centidegreesFromMicroradians(before[i] + robot_.joints[i].error));
    expectAnswer(request('J', joint.identifier, target), 'j', joint.identifier, target);
    passFrames(kLongestWay);
    expectAnswer(request('J', joint.identifier), 'j', joint.identifier,
                 centidegreesFromMicroradians(microradiansFromCentidegrees(target) + robot_.joints[i].error));
    std::vector<int> expected = before;
    expected[i] = microradiansFromCentidegrees(target);
    EXPECT_EQ(positions(), expected);
  }
}

TEST_F(JointsTest, IdentifierZeroSetsAllJointsWithinTheirLimits) {
  for (const int sign : {1, -1}) {
    expectAnswer(request('J', 0, sign * 1000), 'j', 0, sign * 1000);
    passFrames(kLongestWay);
    std::vector<int> posture(robot_.joints.size(), sign * 174533);
    clampPosture(robot_.model, posture.data());
    EXPECT_EQ(positions(), posture);
  }
  expectError(request('J', 0));
}

TEST_F(JointsTest, LimitsAreReadAndSetAndTargetsKeepToThem) {
  expectAnswer(request('J', kHeadPan, 32767), 'j', kHeadPan, 8800);
  expectAnswer(request('V', kNeckTilt), 'v', kNeckTilt, 18250);
  expectAnswer(request('V', kNeckTilt, 18251), 'v', kNeckTilt, 18250);  // the robot's own limit
  expectAnswer(request('V', kNeckTilt, 3000), 'v', kNeckTilt, 3000);
  expectAnswer(request('V', kNeckTilt), 'v', kNeckTilt, 3000);
  expectAnswer(request('A', kTailPan, 5000), 'a', kTailPan, 5000);
  expectAnswer(request('A', kTailPan), 'a', kTailPan, 5000);
}

TEST_F(JointsTest, JammedJointIsHeldAndItsNextRequestIsAnsweredByAnError) {
  for (const bool by_name : {true, false}) {
    FakeRobot::FakeJoint& joint = robot_.joint("tail_tilt");
    joint.jammed = true;
    answerTo(request('J', kTailTilt, by_name ? 4000 : 3000));
    answerTo(request('J', kTailPan, 3000));
    passFrames(kLongestWay);
    EXPECT_THAT(console_.str(), HasSubstr("tail_tilt is jammed"));
    EXPECT_EQ(joint.reference, FakeRobot::measured(joint)) << "its motor still pushes";
    EXPECT_EQ(robot_.joint("tail_pan").position, microradiansFromCentidegrees(3000));
    EXPECT_EQ(answerTo(request('J', kTailPan)).letter, 'j') << "another joint";
    const std::string next = by_name ? request('J', kTailTilt) : request('J', 0, 0);
    expectError(next);
    EXPECT_EQ(answerTo(next).letter, 'j') << "once";
    joint.jammed = false;
  }
}

}  // namespace
