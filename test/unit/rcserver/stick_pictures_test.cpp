// Pictures on the memory stick: the requests `M` and `Y`.
#include "protocol/stick_pictures.h"
#include "file_keeper/FileJob.h"
#include "motion_bytes.h"
#include "picture_checks.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::ElementsAre;

class StickPicturesTest : public FakeRobotFixture {
 protected:
  void SetUp() override {
    host_.room = &room_;
    startWith("ALLOW_PICTURES=yes\nALLOW_DELETE=yes\nALLOW_UPLOAD=yes\n");
    connectVersion2();
  }

  std::string folder() const { return stick_.path("OPEN-R/MW/DATA/P"); }

  /// The files on the stick that are not motions.
  std::vector<std::string> files() const {
    std::vector<std::string> names = namesIn(folder());
    const auto is_motion = [](const std::string& name) { return name.find(".MTN") != std::string::npos; };
    names.erase(std::remove_if(names.begin(), names.end(), is_motion), names.end());
    return names;
  }

  void put(const std::string& name, const std::string& content = "picture") {
    stick_.write("OPEN-R/MW/DATA/P/" + name, content);
  }

  /// Takes a picture and returns its name.
  std::string take(int quality = 85) {
    const Frame answer = ask('M', quality);
    EXPECT_EQ(answer.header.kind, 'm') << textOf(answer);
    return textOf(answer);
  }

  void expectReply(const Frame& answer, char kind, const std::string& payload) {
    EXPECT_EQ(answer.header.kind, kind);
    EXPECT_EQ(textOf(answer), payload);
  }

  size_t room_ = 100 * 1024 * 1024;
};

TEST_F(StickPicturesTest, AreTakenOfTheNextImage) {
  const unsigned image = robot_.lastImage();
  const Frame answer = ask('M', 40);
  expectReply(answer, 'm', "AIBO0001.JPG");
  EXPECT_EQ(answer.header.id, 40);
  EXPECT_EQ(ask('M', SERVER_DEFAULT_QUALITY).header.id, protocol::DEFAULT_JPEG_QUALITY);
  EXPECT_EQ(ask('M', 101).header.id, 100) << "at most";
  EXPECT_THAT(files(), ElementsAre("AIBO0001.JPG", "AIBO0002.JPG", "AIBO0003.JPG"));
  const std::string jpeg = contentOf(folder() + "/AIBO0001.JPG");
  EXPECT_LT(jpeg.size(), contentOf(folder() + "/AIBO0003.JPG").size());
  const Decoded picture = decodeJpeg({jpeg.begin(), jpeg.end()});
  EXPECT_EQ(picture.width, 208);
  EXPECT_NEAR(picture.level(), FakeRobot::brightness(image + 1), 3);
}

TEST_F(StickPicturesTest, AreNumberedAfterTheHighestAndReplaceNothing) {
  const char* const old[] = {"AIBO0041.JPG", "aibo0043.jpg", "AIBO12.JPG", "AIBO99.JPG", "MINE.JPG", "AIBO000A.JPG"};
  for (const char* name : old) {
    put(name, "old");
  }
  EXPECT_EQ(take(), "AIBO0044.JPG");
  EXPECT_EQ(take(), "AIBO0045.JPG");
  for (const char* name : old) {
    EXPECT_EQ(contentOf(folder() + "/" + name), "old") << name;
  }
}

TEST_F(StickPicturesTest, AreNotTakenAfterTheLastNumber) {
  put("AIBO9999.JPG", "old");
  expectRefusal(ask('M', 85), CODE_REFUSED, "has AIBO9999.JPG, the last number; fetch and delete it");
  EXPECT_THAT(files(), ElementsAre("AIBO9999.JPG"));
}

TEST_F(StickPicturesTest, AreAsManyAsCanBeListed) {
  for (int i = 0; i < 255; ++i) {
    put("P" + std::to_string(i) + ".JPG");
  }
  EXPECT_EQ(take(), "AIBO0001.JPG");
  expectRefusal(ask('M', 85), CODE_REFUSED, "has 256 pictures, which is the most; fetch and delete some");
  const std::string list = textOf(ask('Y', LIST_PICTURES));
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 255);
}

TEST_F(StickPicturesTest, OwedPicturesComeFirstAndTheStreamGoesOn) {
  answerTo('W', 85, kStreamOn);
  send(frame('F', 50, 1, std::string(1, '\0')) + frame('M', 85, 2) + frame('F', 50, 3, std::string(1, '\0')));
  passFrames(40);
  std::vector<std::string> answers = heard();
  EXPECT_EQ(std::count(answers.begin(), answers.end(), "f0"), 7) << "ten images; each of the three takes one";
  answers.erase(std::remove(answers.begin(), answers.end(), "f0"), answers.end());
  EXPECT_THAT(answers, ElementsAre("f1", "m2", "f3"));
}

TEST_F(StickPicturesTest, AFullStickIsNamedAndNothingIsLeftOnIt) {
  put("AIBO0001.JPG", "old");
  for (const int room : {0, 100, 65535}) {
    room_ = static_cast<size_t>(room);
    expectRefusal(ask('M', 85), CODE_REFUSED,
                  "the memory stick is full: a picture needs its own size and 64 KB that stay free; fetch and delete");
    EXPECT_THAT(files(), ElementsAre("AIBO0001.JPG"));
  }
  expectReply(ask('Y', FETCH_PICTURE, "AIBO0001.JPG"), 'y', "old");
  room_ = 65536;
  EXPECT_EQ(take(), "AIBO0002.JPG");
  EXPECT_THAT(files(), ElementsAre("AIBO0001.JPG", "AIBO0002.JPG"));
}

TEST_F(StickPicturesTest, AStickThatIsMissingOrWriteProtectedIsNamed) {
  put("AIBO0001.JPG", "old");
  robot_.stick_status = omemorystickNOT_EXIST;
  const char missing[] = "there is no memory stick in the robot; insert it";
  expectRefusal(ask('M', 85), CODE_REFUSED, missing);
  expectRefusal(ask('Y', LIST_PICTURES), CODE_REFUSED, missing);
  expectRefusal(ask('Y', FETCH_PICTURE, "AIBO0001.JPG"), CODE_FILE_MISSING, missing);
  expectRefusal(ask('Y', DELETE_PICTURE, "AIBO0001.JPG"), CODE_FILE_MISSING, missing);
  expectRefusal(ask('N', 0), CODE_REFUSED, missing);
  robot_.stick_status = omemorystickWRITE_PROTECTED;
  const char locked[] = "the memory stick is write-protected; take it out and move its switch";
  expectRefusal(ask('M', 85), CODE_REFUSED, locked);
  expectRefusal(ask('Y', DELETE_PICTURE, "AIBO0001.JPG"), CODE_REFUSED, locked);
  expectRefusal(ask('D', 0, "NOD.MTN"), CODE_REFUSED, locked);
  expectReply(ask('Y', FETCH_PICTURE, "AIBO0001.JPG"), 'y', "old");
  robot_.stick_status = omemorystickWRITABLE;
  EXPECT_EQ(take(), "AIBO0002.JPG") << "it is back";
}

TEST_F(StickPicturesTest, AreFetchedIfTheyHave1To128KiB) {
  const std::string largest(128 * 1024, 'x');
  put("EMPTY.JPG", "");
  put("LARGE.JPG", largest + "x");
  put("FITS.JPG", largest);
  expectRefusal(ask('Y', FETCH_PICTURE, "LARGE.JPG"), CODE_FILE_MISSING, "LARGE.JPG has more than 131072 bytes");
  expectReply(ask('Y', FETCH_PICTURE, "FITS.JPG"), 'y', largest);
  expectRefusal(ask('Y', FETCH_PICTURE, "EMPTY.JPG"), CODE_FILE_MISSING, "the file is empty; delete it");
  expectReply(ask('Y', DELETE_PICTURE, "EMPTY.JPG"), 'y', "");
}

TEST_F(StickPicturesTest, APictureThatHasNotBeenTakenIsForgottenWithItsClient) {
  send(frame('M', 85, 1));
  reconnect();
  passFrames(20);
  EXPECT_THAT(heard(), testing::IsEmpty());
  EXPECT_THAT(files(), testing::IsEmpty());
  EXPECT_EQ(take(), "AIBO0001.JPG");
}

TEST_F(StickPicturesTest, APictureThatIsBeingStoredStaysWithoutItsClient) {
  file_keeper_.slowDown();
  send(frame('M', 85, 1));
  passFrames(8);
  ASSERT_TRUE(file_keeper_.hasJob());
  reconnect();
  file_keeper_.speedUp();
  passFrames(20);
  EXPECT_THAT(heard(), testing::IsEmpty());
  EXPECT_THAT(files(), ElementsAre("AIBO0001.JPG"));
  EXPECT_EQ(take(), "AIBO0002.JPG");
}

}  // namespace
