// Pictures on the robot's memory stick.
#include <gmock/gmock.h>

#include <functional>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "newest_client_fixture.h"
#include "protocol/stick_pictures.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test_pictures::Bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using version2_frames::makeFrame;

namespace {

Bytes bytesOf(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

class RobotPicturesTest : public NewestClientFixture {
 protected:
  /// Makes a call that waits for the robot.
  template <typename Call>
  static auto inBackground(const Call& call) {
    return std::async(std::launch::async, call);
  }

  /// Answers the client's next request, and returns it.
  static version2_frames::Frame answer(ScriptedPeer* peer, const Bytes& payload) {
    version2_frames::Frame request = peer->readRequest();
    peer->send(makeFrame(protocol::version2::replyKind(request.header.kind), request.header.request_number, payload));
    return request;
  }
};

TEST_F(RobotPicturesTest, APictureIsTakenAndItsNameReturned) {
  ScriptedPeer peer = connectVersion2();
  auto call = inBackground([this] { return client().takePictureOnRobot(40, seconds(20)); });
  const version2_frames::Frame request = answer(&peer, bytesOf("AIBO0042.JPG"));
  EXPECT_EQ('M', request.header.kind);
  EXPECT_EQ(40, request.header.id);
  EXPECT_THAT(request.payload, IsEmpty());
  EXPECT_EQ("AIBO0042.JPG", call.get());
}

TEST_F(RobotPicturesTest, PicturesAreListedFetchedAndDeletedInAnyCase) {
  ScriptedPeer peer = connectVersion2();
  const Bytes jpeg = test_pictures::makeNumbered(7);
  auto calls = inBackground([this] {
    const std::vector<std::string> names = client().listPictures(seconds(20));
    const Bytes fetched = client().fetchPicture("mine.jpg", seconds(20));
    client().deletePicture("Mine.jpg", seconds(20));
    return std::make_pair(names, fetched);
  });
  const auto ids = {std::make_pair(1, Bytes()), std::make_pair(2, bytesOf("MINE.JPG")),
                    std::make_pair(3, bytesOf("MINE.JPG"))};
  const std::vector<Bytes> replies = {bytesOf("AIBO0001.JPG\nMINE.JPG"), jpeg, {}};
  auto reply = replies.begin();
  for (const auto& [id, payload] : ids) {
    const version2_frames::Frame request = answer(&peer, *reply++);
    EXPECT_EQ('Y', request.header.kind);
    EXPECT_EQ(id, request.header.id);
    EXPECT_EQ(payload, request.payload);
  }
  const auto [names, fetched] = calls.get();
  EXPECT_THAT(names, ElementsAre("AIBO0001.JPG", "MINE.JPG"));
  EXPECT_EQ(jpeg, fetched);
}

TEST_F(RobotPicturesTest, ARefusalSaysWhatWasRefusedAndWhy) {
  ScriptedPeer peer = connectVersion2();
  const std::vector<std::pair<std::string, std::function<void()>>> calls = {
      {"refused to take a picture onto its memory stick: why",
       [this] { client().takePictureOnRobot(85, seconds(20)); }},
      {"refused to list the pictures on its memory stick: why", [this] { client().listPictures(seconds(20)); }},
      {"refused to send the picture A.JPG: why", [this] { client().fetchPicture("A.JPG", seconds(20)); }},
      {"refused to delete the picture A.JPG: why", [this] { client().deletePicture("A.JPG", seconds(20)); }}};
  for (const auto& [text, call] : calls) {
    auto complaint = inBackground([call = call] { return complaintOf<CommandException>(call); });
    peer.send(makeFrame('e', peer.readRequest().header.request_number, version2_frames::makeError(0, "why")));
    EXPECT_THAT(complaint.get(), HasSubstr(text));
  }
}

TEST_F(RobotPicturesTest, AFileThatIsNoPictureIsRefusedAndTheConnectionGoesOn) {
  ScriptedPeer peer = connectVersion2();
  Bytes cut = test_pictures::makeNumbered(7);
  cut.resize(cut.size() / 2);
  for (const Bytes& content : {bytesOf("no JPEG"), cut}) {
    auto complaint = inBackground(
        [this] { return complaintOf<CommandException>([this] { client().fetchPicture("A.JPG", seconds(20)); }); });
    answer(&peer, content);
    EXPECT_THAT(complaint.get(), HasSubstr("has sent A.JPG, which is not a picture of its camera: "));
  }
}

TEST_F(RobotPicturesTest, ARobotThatTellsNonsenseIsDisconnected) {
  for (const std::string nonsense : {"../../etc/passwd", "", "NOD.MTN", "A.JPG\n"}) {
    ScriptedPeer peer = connectVersion2();
    auto call = inBackground([this] { client().takePictureOnRobot(85, seconds(20)); });
    answer(&peer, bytesOf(nonsense));
    EXPECT_THROW(call.get(), NetworkException) << nonsense;
  }
  ScriptedPeer peer = connectVersion2();
  auto call = inBackground([this] { client().fetchPicture("A.JPG", seconds(20)); });
  answer(&peer, Bytes(protocol::version2::MAX_STICK_PICTURE_SIZE + 1, 'x'));
  EXPECT_THROW(call.get(), NetworkException);
}

TEST_F(RobotPicturesTest, NoVersion1ServerHasThem) {
  ScriptedPeer peer = connectVersion1();
  EXPECT_THAT(complaintOf<CommandException>([this] { client().takePictureOnRobot(85, seconds(20)); }),
              HasSubstr("speaks version 1 of the protocol, which cannot take a picture onto its memory stick"));
  EXPECT_THROW(client().listPictures(seconds(20)), CommandException);
  EXPECT_THROW(client().fetchPicture("A.JPG", seconds(20)), CommandException);
  EXPECT_THROW(client().deletePicture("A.JPG", seconds(20)), CommandException);
}

TEST_F(RobotPicturesTest, ArgumentsAreCheckedBeforeAnythingIsSent) {
  EXPECT_THROW(client().takePictureOnRobot(0, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().takePictureOnRobot(101, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().listPictures(milliseconds(0)), InvalidArgumentException);
  for (const char* name : {"", "../A.JPG", "NOD.MTN", "A"}) {
    EXPECT_THROW(client().fetchPicture(name, seconds(1)), InvalidArgumentException) << name;
    EXPECT_THROW(client().deletePicture(name, seconds(1)), InvalidArgumentException) << name;
  }
}

}  // namespace
