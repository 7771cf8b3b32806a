#include "picture_stamper.h"

#include <gmock/gmock.h>

#include <chrono>

namespace aibo_driver {
namespace {

using namespace std::chrono_literals;

class PictureStamperTest : public ::testing::Test {
 protected:
  PictureStamper makeStamper(std::chrono::nanoseconds time_offset) {
    return PictureStamper(
        time_offset, [this] { return ros_now_; }, [this] { return steady_now_; });
  }

  void advance(std::chrono::milliseconds time) {
    steady_now_ += time;
    ros_now_ += ros::Duration(0, static_cast<int>(std::chrono::nanoseconds(time).count()));
  }

  ros::Time ros_now_{1000, 0};
  PictureStamper::SteadyTime steady_now_{500s};
};

TEST_F(PictureStamperTest, TheStampIsTheArrivalOfTheFirstByte) {
  PictureStamper stamper = makeStamper(0ns);
  EXPECT_EQ(stamper.stamp(steady_now_ - 20ms), ros::Time(999, 980000000));
}

TEST_F(PictureStamperTest, TheOffsetIsAdded) {
  EXPECT_EQ(makeStamper(30ms).stamp(steady_now_), ros::Time(1000, 30000000));
  EXPECT_EQ(makeStamper(-30ms).stamp(steady_now_), ros::Time(999, 970000000));
}

TEST_F(PictureStamperTest, TheSamePictureHasTheSameStampLater) {
  PictureStamper stamper = makeStamper(0ns);
  const auto first_byte_time = steady_now_;
  const ros::Time stamp = stamper.stamp(first_byte_time);
  advance(33ms);
  stamper.stamp(steady_now_);
  ros_now_ += ros::Duration(0, 700);  // the clocks drift
  EXPECT_EQ(stamper.stamp(first_byte_time), stamp);
}

TEST_F(PictureStamperTest, StampsIncreaseAlthoughTheRosClockStepsBackALittle) {
  PictureStamper stamper = makeStamper(0ns);
  const ros::Time first = stamper.stamp(steady_now_);
  advance(33ms);
  ros_now_ -= ros::Duration(0.5);
  const ros::Time second = stamper.stamp(steady_now_);
  advance(33ms);
  const ros::Time third = stamper.stamp(steady_now_);
  EXPECT_GT(second, first);
  EXPECT_GT(third, second);
}

TEST_F(PictureStamperTest, StampsFollowARosClockThatIsSetBack) {
  PictureStamper stamper = makeStamper(0ns);
  stamper.stamp(steady_now_);
  advance(33ms);
  ros_now_ = ros::Time(10, 0);
  EXPECT_EQ(stamper.stamp(steady_now_), ros::Time(10, 0));
}

TEST_F(PictureStamperTest, StampsIncreaseWhileASimulatedClockHasNotBegun) {
  PictureStamper stamper = makeStamper(-30ms);
  ros_now_ = ros::Time(0, 0);
  const ros::Time first = stamper.stamp(steady_now_ - 10ms);
  const ros::Time second = stamper.stamp(steady_now_ - 5ms);
  EXPECT_EQ(first, ros::Time(0, 0));
  EXPECT_GT(second, first);
}

}  // namespace
}  // namespace aibo_driver
