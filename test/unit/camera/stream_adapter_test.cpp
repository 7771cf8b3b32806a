#include "camera/stream_adapter.h"

#include <gmock/gmock.h>

#include "support/fake_client.h"

namespace aibo_driver::camera {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class StreamAdapterTest : public ::testing::Test {
 protected:
  static StreamAdapter::Wish wish(bool adaptive) {
    StreamAdapter::Wish wish;
    wish.jpeg_quality = 80;
    wish.format.every_nth_image = 2;
    wish.format.resolution = aibo_client::Resolution::kDouble;
    wish.adaptive = adaptive;
    wish.max_picture_age = 0.13;
    return wish;
  }

  /// A second of pictures, of which each is this old.
  void publish(std::chrono::milliseconds age) {
    for (int i = 0; i < 30; ++i) {
      now_ += 33ms;
      adapter_.picturePublished(now_, now_ - age);
    }
  }

  test_support::FakeClient client_;
  std::vector<std::string> texts_;
  StreamAdapter adapter_{client_, [this](auto, const std::string& text) { texts_.push_back(text); }};
  StreamAdapter::SteadyTime now_{1000s};
};

TEST_F(StreamAdapterTest, WithoutAdaptiveTheStreamIsThatOfTheWish) {
  adapter_.setWish(wish(false));
  EXPECT_THAT(client_.told, ElementsAre("quality 80", "format 3 2"));
  publish(2s);
  EXPECT_EQ(client_.told.size(), 2U);
  EXPECT_EQ(adapter_.describe(), "off");
}

TEST_F(StreamAdapterTest, OldPicturesLowerTheStreamButNotTakePicture) {
  adapter_.setWish(wish(true));
  EXPECT_EQ(adapter_.describe(), "not lowered");
  EXPECT_EQ(adapter_.wishedQuality(), 80);
  for (int i = 0; i < 20; ++i) {
    publish(200ms);
  }
  EXPECT_THAT(client_.told, testing::Contains("quality 70"));
  EXPECT_EQ(client_.told.back(), "format 3 15");
  EXPECT_EQ(adapter_.wishedQuality(), 80);
  EXPECT_EQ(adapter_.describe(), "lowered to quality 50 of 80 and 2.0 of 15.0 pictures/s");
  EXPECT_THAT(texts_,
              testing::Contains(HasSubstr("is 200 ms old, and at most 130 ms are allowed: the stream is lowered")));
  client_.told.clear();
  for (int i = 0; i < 300; ++i) {
    publish(10ms);
  }
  EXPECT_EQ(adapter_.describe(), "not lowered");
  EXPECT_THAT(client_.told, testing::Contains("quality 80")) << "and the robot knows";
}

TEST_F(StreamAdapterTest, OnlyAnotherWishBeginsAnew) {
  adapter_.setWish(wish(true));
  publish(200ms);
  client_.told.clear();
  adapter_.setWish(wish(true));
  EXPECT_THAT(client_.told, testing::IsEmpty());
  StreamAdapter::Wish patient = wish(true);
  patient.max_picture_age = 1;
  adapter_.setWish(patient);
  EXPECT_THAT(client_.told, ElementsAre("quality 80", "format 3 2"));
  publish(800ms);
  EXPECT_EQ(adapter_.describe(), "not lowered");
}

TEST_F(StreamAdapterTest, PicturesOfUnknownAgeChangeNothingAndAreNamedOnceForEachWish) {
  for (const bool adaptive : {true, false, true}) {
    adapter_.setWish(wish(adaptive));
    for (int i = 0; i < 100; ++i) {
      adapter_.picturePublished(now_ += 1s, std::nullopt);
    }
  }
  EXPECT_EQ(client_.told.size(), 6U);
  EXPECT_THAT(texts_, ElementsAre(HasSubstr("adaptive has no effect"), HasSubstr("adaptive has no effect")));
}

}  // namespace
}  // namespace aibo_driver::camera
