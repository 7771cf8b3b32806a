#include "node/robot_stamper.h"

#include <gmock/gmock.h>

#include <chrono>

namespace aibo_driver::node {
namespace {

using namespace std::chrono_literals;
using aibo_client::Picture;

Picture pictureOf(RobotStamper::SteadyTime arrival) {
  Picture picture;
  picture.first_byte_time = arrival;
  return picture;
}

aibo_client::Telemetry telemetryOf(std::uint32_t frame_number, RobotStamper::SteadyTime arrival) {
  aibo_client::Telemetry telemetry;
  telemetry.frame_number = frame_number;
  telemetry.arrival = arrival;
  return telemetry;
}

class RobotStamperTest : public ::testing::Test {
 protected:
  RobotStamper makeStamper(std::chrono::nanoseconds time_offset, robot_time::RobotClock* robot_clock = nullptr) {
    return RobotStamper(
        robot_clock, time_offset + 40ms,
        [this] { return ros_now_.isZero() ? ros_now_ : ros_now_ - ros::Duration(0.04); },
        [this] { return steady_now_; });
  }

  void advance(std::chrono::milliseconds time) {
    steady_now_ += time;
    ros_now_ += ros::Duration(0, static_cast<int>(std::chrono::nanoseconds(time).count()));
  }

  ros::Time ros_now_{1000, 0};
  RobotStamper::SteadyTime steady_now_{500s};
  robot_time::RobotClock robot_clock_;
};

TEST_F(RobotStamperTest, APictureWithoutAFrameNumberIsStampedAtItsFirstByte) {
  RobotStamper stamper = makeStamper(0ns, &robot_clock_);
  EXPECT_EQ(stamper.momentOf(pictureOf(steady_now_ - 20ms)).stamp, ros::Time(999, 980000000));
}

TEST_F(RobotStamperTest, KnowsWhenAPictureWithAFrameNumberWasTaken) {
  RobotStamper stamper = makeStamper(0ns, &robot_clock_);
  Picture picture = pictureOf(steady_now_);
  EXPECT_EQ(stamper.momentOf(picture).taken, std::nullopt);
  picture.frame_number = 100;
  EXPECT_EQ(stamper.momentOf(picture).taken, steady_now_);
  picture.frame_number = 105;
  picture.first_byte_time = steady_now_ + 70ms;
  EXPECT_EQ(stamper.momentOf(picture).taken, steady_now_ + 40ms);
  EXPECT_EQ(makeStamper(0ns).momentOf(picture).taken, std::nullopt) << "without the robot's clock";
}

TEST_F(RobotStamperTest, StampsKeepTheIntervalOfTheFrameNumbersEvenIfAMessageIsLate) {
  RobotStamper stamper = makeStamper(0ns, &robot_clock_);
  const ros::Time first = stamper.stamp(telemetryOf(100, steady_now_));
  advance(70ms);
  const ros::Time second = stamper.stamp(telemetryOf(105, steady_now_));
  EXPECT_EQ(second, first + ros::Duration(0, 40000000));
}

// 40 frames of 8 ms in 10 ms, and jumps of less than a second.
TEST_F(RobotStamperTest, NoStampIsLaterThanItsArrivalHoweverFastTheFrameNumbersGrow) {
  for (const std::uint32_t frames : {2U, 40U, 60U, 120U}) {
    RobotStamper stamper = makeStamper(0ns, &robot_clock_);
    std::uint32_t frame = 100;
    for (int i = 0; i < 500; ++i) {
      frame += frames;
      EXPECT_LE(stamper.stamp(telemetryOf(frame, steady_now_)), ros_now_) << frames << " " << i;
      advance(10ms);
    }
  }
}

TEST_F(RobotStamperTest, StampsOfPicturesAndTelemetryOfOneFrameAreTheSame) {
  RobotStamper pictures = makeStamper(0ns, &robot_clock_);
  RobotStamper telemetries = makeStamper(0ns, &robot_clock_);
  const ros::Time measured = telemetries.stamp(telemetryOf(100, steady_now_));
  advance(25ms);
  Picture picture = pictureOf(steady_now_);
  picture.frame_number = 100;
  EXPECT_EQ(pictures.momentOf(picture).stamp, measured);
}

TEST_F(RobotStamperTest, StampsFollowARosClockThatIsSet) {
  RobotStamper stamper = makeStamper(0ns, &robot_clock_);
  std::uint32_t frame = 100;
  stamper.stamp(telemetryOf(frame, steady_now_));
  for (const ros::Time& now : {ros::Time(5000, 0), ros::Time(10, 0), ros::Time(8, 990000000)}) {
    advance(32ms);
    ros_now_ = now;
    EXPECT_EQ(stamper.stamp(telemetryOf(frame += 4, steady_now_)), now);
  }
}

TEST_F(RobotStamperTest, TheOffsetIsAdded) {
  EXPECT_EQ(makeStamper(30ms).momentOf(pictureOf(steady_now_)).stamp, ros::Time(1000, 30000000));
  EXPECT_EQ(makeStamper(-30ms, &robot_clock_).stamp(telemetryOf(7, steady_now_)), ros::Time(999, 970000000));
}

TEST_F(RobotStamperTest, TheSamePictureHasTheSameStampLater) {
  RobotStamper stamper = makeStamper(0ns);
  Picture former = pictureOf(steady_now_);
  ros::Time former_stamp = stamper.momentOf(former).stamp;
  for (int i = 0; i < 20; ++i) {  // more than it remembers
    advance(33ms);
    const Picture picture = pictureOf(steady_now_);
    const ros::Time stamp = stamper.momentOf(picture).stamp;
    ros_now_ += ros::Duration(0, 700);  // the clocks drift
    EXPECT_EQ(stamper.momentOf(picture).stamp, stamp) << i;
    EXPECT_EQ(stamper.momentOf(former).stamp, former_stamp) << i;
    former = picture;
    former_stamp = stamp;
  }
}

TEST_F(RobotStamperTest, StampsIncreaseEvenIfTheRosClockStepsBackALittle) {
  RobotStamper stamper = makeStamper(0ns);
  for (int i = 0; i < 20; ++i) {  // more than it remembers
    stamper.momentOf(pictureOf(steady_now_));
    advance(33ms);
  }
  const ros::Time first = stamper.momentOf(pictureOf(steady_now_)).stamp;
  advance(33ms);
  ros_now_ -= ros::Duration(1.02);  // a second before the last stamp would be a step
  EXPECT_GT(stamper.momentOf(pictureOf(steady_now_)).stamp, first);
}

TEST_F(RobotStamperTest, StampsIncreaseWhileASimulatedClockHasNotBegun) {
  RobotStamper stamper = makeStamper(-30ms);
  ros_now_ = ros::Time(0, 0);
  const ros::Time first = stamper.momentOf(pictureOf(steady_now_ - 10ms)).stamp;
  const ros::Time second = stamper.momentOf(pictureOf(steady_now_ - 5ms)).stamp;
  EXPECT_EQ(first, ros::Time(0, 0));
  EXPECT_GT(second, first);
}

}  // namespace
}  // namespace aibo_driver::node
