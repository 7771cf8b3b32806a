#include "ros/camera/link_quality.h"

#include <gmock/gmock.h>

#include <cmath>

namespace aibo_driver::node {
namespace {

// A picture that the camera took as its image with this number.
Picture image(std::uint32_t number, std::uint64_t connection = 1) {
  Picture picture;
  picture.jpeg.resize(2000);
  picture.image_count = number;
  picture.frame_number = 4 * number;
  picture.connection_number = connection;
  return picture;
}

class LinkQualityTest : public ::testing::Test {
 protected:
  // Adds pictures with these numbers, a second's worth.
  LinkQuality after(const std::vector<std::uint32_t>& numbers, int every_nth = 1) {
    for (const std::uint32_t number : numbers) {
      meter_.add(image(number), 0.01, every_nth);
    }
    return meter_.read(1, 30);
  }

  LinkQualityMeter meter_;
};

TEST_F(LinkQualityTest, HasRateAndAgeSinceTheLastReading) {
  meter_.add(image(1), 0.010, 1);
  meter_.add(image(2), 0.030, 1);
  const LinkQuality quality = meter_.read(0.5, 30);
  EXPECT_FLOAT_EQ(quality.pictures_per_second, 4);
  EXPECT_FLOAT_EQ(quality.pictures_per_second_asked, 30);
  EXPECT_FLOAT_EQ(quality.kilobytes_per_second, 8);
  EXPECT_FLOAT_EQ(quality.age, 0.020F);
  EXPECT_FLOAT_EQ(quality.longest_age, 0.030F);
  EXPECT_FLOAT_EQ(quality.lost, 0);
}

TEST_F(LinkQualityTest, WithoutPicturesAgeAndLossAreUnknown) {
  after({1, 2, 3});
  const LinkQuality quality = after({});
  EXPECT_FLOAT_EQ(quality.pictures_per_second, 0);
  EXPECT_TRUE(std::isnan(quality.age));
  EXPECT_TRUE(std::isnan(quality.longest_age));
  EXPECT_TRUE(std::isnan(quality.lost));
}

TEST_F(LinkQualityTest, ImagesThatDidNotComeAreLostAlsoAcrossReadings) {
  EXPECT_FLOAT_EQ(after({1, 2, 4, 5}).lost, 0.25F);  // of images 2 to 5
  EXPECT_FLOAT_EQ(after({8, 9}).lost, 0.5F);         // of images 6 to 9
}

TEST_F(LinkQualityTest, ImagesThatWereNotAskedForAreNotLost) {
  EXPECT_FLOAT_EQ(after({10, 13, 16, 19}, 3).lost, 0);
  EXPECT_FLOAT_EQ(after({25}, 3).lost, 0.5F);
  EXPECT_FLOAT_EQ(after({26}, 3).lost, 0) << "taken for take_picture, between two of the stream";
}

TEST_F(LinkQualityTest, APauseBetweenConnectionsIsNotALoss) {
  after({1, 2});
  meter_.add(image(500, 2), 0.01, 1);
  meter_.add(image(501, 2), 0.01, 1);
  EXPECT_FLOAT_EQ(meter_.read(1, 30).lost, 0);
}

TEST_F(LinkQualityTest, OfAServerOfVersion1AgeAndLossAreUnknown) {
  Picture picture = image(1);
  picture.image_count.reset();
  picture.frame_number.reset();
  meter_.add(picture, 0.01, 1);
  meter_.add(picture, 0.01, 1);
  const LinkQuality quality = meter_.read(1, 30);
  EXPECT_FLOAT_EQ(quality.pictures_per_second, 2);
  EXPECT_TRUE(std::isnan(quality.age));
  EXPECT_TRUE(std::isnan(quality.longest_age));
  EXPECT_TRUE(std::isnan(quality.lost));
}

}  // namespace
}  // namespace aibo_driver::node
