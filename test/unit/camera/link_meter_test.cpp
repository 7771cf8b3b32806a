#include "camera/link_meter.h"

#include <gmock/gmock.h>

#include "camera/camera_options.h"

namespace aibo_driver::camera {
namespace {

using aibo_client::Picture;
using std::chrono::milliseconds;

class LinkMeterTest : public ::testing::Test {
 protected:
  /// A picture of the camera's n-th image, one every 4 frames.
  Picture pictureOf(std::uint32_t image, milliseconds late = milliseconds(0)) const {
    Picture picture;
    picture.jpeg.resize(900 + 20 * image);
    picture.connection_number = connection_;
    picture.image_count = image;
    picture.frame_number = 4 * image;
    picture.first_byte_time = begin_ + milliseconds(32 * image) + late;
    return picture;
  }

  void arrive(std::uint32_t image, milliseconds late = milliseconds(0)) {
    const Picture picture = pictureOf(image, late);
    const auto age = late + milliseconds(2);
    meter_.add(picture, std::chrono::duration<double>(age).count(), 1, picture.first_byte_time + milliseconds(2));
  }

  std::uint64_t connection_ = 41;
  const LinkMeter::SteadyTime begin_{std::chrono::hours(1)};
  LinkMeter meter_{begin_};
};

TEST_F(LinkMeterTest, CountsPicturesAndBytes) {
  for (std::uint32_t image = 0; image < 10; ++image) {
    arrive(image);
  }
  const LinkMeter::Reading reading = meter_.read(begin_ + milliseconds(500));
  EXPECT_EQ(reading.pictures, 10U);
  EXPECT_DOUBLE_EQ(reading.picturesPerSecond(), 20);
  EXPECT_DOUBLE_EQ(reading.kilobytesPerSecond(), 19.8);
  EXPECT_EQ(meter_.read(begin_ + milliseconds(600)).pictures, 0U);
}

TEST_F(LinkMeterTest, LossIsTheShareOfImagesThatDidNotCome) {
  arrive(0);
  arrive(1);
  arrive(4);  // 2 and 3 are missing
  EXPECT_DOUBLE_EQ(meter_.read(begin_ + milliseconds(200)).loss.value(), 0.5);
  arrive(5);
  EXPECT_DOUBLE_EQ(meter_.read(begin_ + milliseconds(300)).loss.value(), 0);
}

TEST_F(LinkMeterTest, HasTheAverageAgeAndTheWorst) {
  arrive(0);
  arrive(1, milliseconds(90));
  const LinkMeter::Reading reading = meter_.read(begin_ + milliseconds(200));
  EXPECT_NEAR(reading.mean_age.value(), 0.047, 1e-9);
  EXPECT_NEAR(reading.worst_age.value(), 0.092, 1e-9);
}

TEST_F(LinkMeterTest, AReconnectIsNoLoss) {
  arrive(1000);
  arrive(1001);
  ++connection_;
  arrive(2000);
  arrive(2001);
  EXPECT_DOUBLE_EQ(meter_.read(begin_ + milliseconds(70000)).loss.value(), 0);
  arrive(2003);
  EXPECT_DOUBLE_EQ(meter_.read(begin_ + milliseconds(70100)).loss.value(), 0.5) << "of the second connection";
}

TEST_F(LinkMeterTest, ImagesOfAPauseOfTheStreamAreNotMissed) {
  arrive(0);
  arrive(1);
  meter_.read(begin_ + milliseconds(100), kCameraRate);
  meter_.read(begin_ + milliseconds(1100), 0);
  arrive(300);
  arrive(301);
  EXPECT_EQ(meter_.read(begin_ + milliseconds(10000), kCameraRate).loss, 0);
}

TEST_F(LinkMeterTest, ImagesThatWereNotAskedForAreNotMissed) {
  for (const std::uint32_t image : {0U, 3U, 6U, 12U}) {
    meter_.add(pictureOf(image), 0, 3, begin_ + milliseconds(32 * image));
  }
  EXPECT_NEAR(meter_.read(begin_ + milliseconds(500)).loss.value(), 0.25, 1e-9);
  meter_.add(pictureOf(13), 0, 3, begin_ + milliseconds(501));
  EXPECT_EQ(meter_.read(begin_ + milliseconds(600)).loss, 0) << "taken for take_picture, between two of the stream";
}

TEST_F(LinkMeterTest, AGapThatNoPictureHasEndedYetCounts) {
  arrive(1);
  EXPECT_NEAR(meter_.read(begin_ + milliseconds(1000)).longest_gap, 1 - 0.034, 1e-6);
}

TEST_F(LinkMeterTest, AServerOfVersion1TellsNeitherAgeNorLoss) {
  Picture picture;
  picture.first_byte_time = begin_;
  meter_.add(picture, 0, 1, begin_);
  meter_.add(picture, 0, 1, begin_);
  const LinkMeter::Reading reading = meter_.read(begin_ + milliseconds(100));
  EXPECT_EQ(reading.pictures, 2U);
  EXPECT_FALSE(reading.mean_age || reading.worst_age || reading.loss);
}

TEST_F(LinkMeterTest, HasTheLatencySinceTheFirstByte) {
  Picture picture;
  picture.first_byte_time = begin_;
  meter_.add(picture, 0, 1, begin_ + milliseconds(4));
  picture.first_byte_time = begin_ + milliseconds(8);
  meter_.add(picture, 0, 1, begin_ + milliseconds(10));
  const LinkMeter::Reading reading = meter_.read(begin_ + milliseconds(100));
  EXPECT_DOUBLE_EQ(reading.mean_latency, 0.003);
  EXPECT_DOUBLE_EQ(reading.max_latency, 0.004);
  EXPECT_DOUBLE_EQ(meter_.read(begin_ + milliseconds(200)).max_latency, 0) << "each reading starts again";
}

class SlowStreamTest : public ::testing::Test {
 protected:
  // Lets a second pass in which this many pictures come.
  double slowForAfter(int pictures, double asked_rate = kCameraRate) {
    for (int i = 0; i < pictures; ++i) {
      meter_.add(Picture(), 0, 1, now_);
    }
    now_ += std::chrono::seconds(1);
    return meter_.read(now_, asked_rate).slow_for;
  }

  LinkMeter::SteadyTime now_{std::chrono::hours(1)};
  LinkMeter meter_{now_};
};

TEST_F(SlowStreamTest, IsMeasuredFromHalfOfTheRateThatIsAskedFor) {
  EXPECT_DOUBLE_EQ(slowForAfter(30), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(15), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(14), 1);
  EXPECT_DOUBLE_EQ(slowForAfter(0), 2);
  EXPECT_DOUBLE_EQ(slowForAfter(14), 3);
  EXPECT_DOUBLE_EQ(slowForAfter(15), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(1), 1) << "it begins again";
}

TEST_F(SlowStreamTest, IsNoneWhileNoStreamIsAskedFor) {
  EXPECT_DOUBLE_EQ(slowForAfter(1), 0) << "it may have begun a moment ago";
  EXPECT_DOUBLE_EQ(slowForAfter(1), 1);
  EXPECT_DOUBLE_EQ(slowForAfter(0, 0), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(14), 0);
  EXPECT_DOUBLE_EQ(slowForAfter(14), 1);
}

using aibo_client::Resolution;

TEST(CameraOptions, AResolutionIsOneOfTheCamerasLayersOrDouble) {
  EXPECT_EQ(resolutionOf("52x40"), Resolution::kLow);
  EXPECT_EQ(resolutionOf("104x80"), Resolution::kMiddle);
  EXPECT_EQ(resolutionOf("208x160"), Resolution::kHigh);
  EXPECT_EQ(resolutionOf("416x320"), Resolution::kDouble);
  EXPECT_FALSE(resolutionOf(""));
  EXPECT_FALSE(resolutionOf("208X160"));
}

TEST(CameraOptions, ARateIsThatOfEveryNthImage) {
  EXPECT_EQ(everyNthImageOf(30), 1);
  EXPECT_EQ(everyNthImageOf(16), 2);
  EXPECT_EQ(everyNthImageOf(2), 15);
  EXPECT_EQ(everyNthImageOf(0), 15);
  EXPECT_EQ(everyNthImageOf(100), 1);
  EXPECT_DOUBLE_EQ(frameRateOf(4), 7.5);
}

TEST(Transport, ItsReasonIsTold) {
  using aibo_client::PictureTransport;
  aibo_client::ConnectionStatus status;
  status.transport_problem = "a firewall";
  EXPECT_EQ(transportReason(status), "") << "it was that of the connection before";
  status.transport_problem.clear();
  status.state = aibo_client::ConnectionState::kConnected;
  EXPECT_EQ(transportReason(status), "~transport is tcp");
  status.wanted_transport = PictureTransport::kUdp;
  EXPECT_EQ(transportReason(status), "UDP has not been tried yet");
  status.transport_problem = "a firewall";
  EXPECT_EQ(transportReason(status), "a firewall");
  status.transport_problem.clear();
  status.transport = PictureTransport::kUdp;
  EXPECT_EQ(transportReason(status), "datagrams from the robot get through");
}

}  // namespace
}  // namespace aibo_driver::camera
