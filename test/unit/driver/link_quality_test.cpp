#include "node/camera/link_quality.h"

#include <gmock/gmock.h>

#include <cmath>

namespace aibo_driver::node {
namespace {

TEST(LinkQuality, HasTheFiguresOfTheReading) {
  camera::LinkMeter::Reading reading;
  reading.seconds = 0.5;
  reading.pictures = 2;
  reading.bytes = 4000;
  reading.mean_age = 0.02;
  reading.worst_age = 0.03;
  reading.loss = 0.25;
  const LinkQuality quality = toMessage(reading, 30);
  EXPECT_FLOAT_EQ(quality.pictures_per_second, 4);
  EXPECT_FLOAT_EQ(quality.pictures_per_second_asked, 30);
  EXPECT_FLOAT_EQ(quality.kilobytes_per_second, 8);
  EXPECT_FLOAT_EQ(quality.age, 0.02F);
  EXPECT_FLOAT_EQ(quality.longest_age, 0.03F);
  EXPECT_FLOAT_EQ(quality.lost, 0.25F);
}

TEST(LinkQuality, SaysThatAgeAndLossAreUnknown) {
  const LinkQuality quality = toMessage({}, 0);
  EXPECT_FLOAT_EQ(quality.pictures_per_second, 0);
  EXPECT_TRUE(std::isnan(quality.age));
  EXPECT_TRUE(std::isnan(quality.longest_age));
  EXPECT_TRUE(std::isnan(quality.lost));
}

}  // namespace
}  // namespace aibo_driver::node
