#include "tools/playback/recording.h"

#include <gmock/gmock.h>

namespace aibo_driver::tools {
namespace {

TEST(Timeline, PlaysAtItsRateAlsoAfterAPause) {
  const ros::Time recorded(1000);
  for (const double rate : {0.5, 1.0, 2.0}) {
    Timeline timeline(rate);
    for (const ros::Time now : {ros::Time(5000), ros::Time(7000)}) {
      timeline.anchor(recorded, now);
      for (const double seconds : {-4.0, 0.0, 4.0}) {  // what is older than the start may be played, too
        const ros::Time moment = recorded + ros::Duration(seconds);
        EXPECT_EQ(timeline.timeOf(moment), now + ros::Duration(seconds / rate)) << rate;
        EXPECT_EQ(timeline.recordedAt(now + ros::Duration(seconds / rate)), moment) << rate;
      }
    }
  }
}

}  // namespace
}  // namespace aibo_driver::tools
