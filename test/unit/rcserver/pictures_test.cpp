// Pictures while the encoder is at work and while the connection is busy.

#include "picture_checks.h"
#include "rcserver_fixture.h"

namespace {

class PicturesTest : public Version2Fixture {
 protected:
  // Afterwards the encoder is at work on the first image.
  bool startsStreamWithSlowEncoder() {
    encoder_.slowDown();
    answerTo('W', 85, kStreamOn);
    takeImage();
    return encoder_.hasJob();
  }

  std::vector<Frame> pictures() { return arrived('f'); }

  static unsigned imageCount(const Frame& picture) { return pictureIn(picture).image.image_count; }

  static int brightness(const Frame& picture) { return brightnessOf(pictureIn(picture).jpeg).level; }

  void expectPictureOfImage(const Frame& picture, unsigned image) {
    EXPECT_EQ(imageCount(picture), image);
    EXPECT_NEAR(brightness(picture), FakeRobot::brightness(image), 3);
    EXPECT_NEAR(brightnessOf(pictureIn(picture).jpeg).bottom, FakeRobot::brightness(image), 3);
  }
};

TEST_F(PicturesTest, NewestImageDuringEncodingIsTheNextPicture) {
  ASSERT_TRUE(startsStreamWithSlowEncoder());
  const unsigned first = robot_.lastImage();
  takeImage();
  takeImage();
  takeImage();
  EXPECT_TRUE(pictures().empty());
  encoder_.speedUp();
  passFrames(1);
  const std::vector<Frame> made = pictures();
  ASSERT_EQ(made.size(), 2U);
  expectPictureOfImage(made[0], first);
  expectPictureOfImage(made[1], robot_.lastImage());
  takeImage();
  const std::vector<Frame> next = pictures();
  ASSERT_EQ(next.size(), 1U);
  expectPictureOfImage(next[0], robot_.lastImage());
}

TEST_F(PicturesTest, PictureInTheMakingIsDroppedWithItsClient) {
  encoder_.slowDown();
  send(frame('F', 85, 7, kLayerHigh));
  takeImage();
  ASSERT_TRUE(encoder_.hasJob());
  reconnect();
  send(frame('F', 85, 8, kLayerHigh));
  encoder_.speedUp();
  takeImage();
  takeImage();
  const std::vector<Frame> own = pictures();
  ASSERT_EQ(own.size(), 1U);
  EXPECT_EQ(own[0].header.request_number, 8);
  expectPictureOfImage(own[0], robot_.lastImage() - 1);
}

// The camera counts its images in 16 bits.
TEST_F(PicturesTest, CountOfImagesContinuesWhenTheCamerasCountWraps) {
  disconnect();
  clock_.step(FakeRobot::kFramesPerImage * 65532);
  machine_->runPending();
  connectVersion2();
  answerTo('W', 85, kStreamOn);
  for (int i = 0; i < 6; ++i) {
    takeImage();
    const std::vector<Frame> made = pictures();
    ASSERT_EQ(made.size(), 1U);
    EXPECT_EQ(imageCount(made[0]), robot_.lastImage());
  }
  EXPECT_GT(robot_.lastImage(), 65536U);
}

TEST_F(PicturesTest, UsualPictureIsSentAtOnceWithItsHeader) {
  takeImage();  // what the robot tells a new client comes first
  sends_.clear();
  send(frame('F', 85, 7, kLayerHigh));
  takeImage();
  const std::optional<Frame> picture = nextFrame();
  ASSERT_TRUE(picture);
  EXPECT_THAT(sends_, ::testing::ElementsAre(picture->payload.size() + 8));
}

// A client with small buffers, and large pictures.
TEST_F(PicturesTest, PictureThatIsReadLateIsFinishedAndTheNextOneIsTheNewest) {
  disconnect();
  robot_.showNoise();
  connectVersion2(4096);
  send(frame('W', 100, 5, kStreamOn));
  takeImage();
  const unsigned first = robot_.lastImage();
  for (int i = 0; i < 10; ++i) {
    takeImage();
  }
  EXPECT_EQ(imageCount(nextPush('f')), first);
  takeImage();
  EXPECT_EQ(imageCount(nextPush('f')), robot_.lastImage());
}

}  // namespace
