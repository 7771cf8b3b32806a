#include "remote_control/driver_search.h"

#include <gmock/gmock.h>

namespace aibo_driver::remote_control {
namespace {

constexpr const char* kConnection = "aibo_driver/Connection";

TEST(DriverSearch, FindsDriversByTheirTopicAndItsType) {
  EXPECT_THAT(driversIn({{"/left/connection", kConnection},
                         {"/lab/right/connection", kConnection},
                         {"/other/connection", "std_msgs/Bool"},
                         {"/left/camera_connection", kConnection}}),
              testing::ElementsAre("/lab/right", "/left"));
}

TEST(DriverSearch, TriesOneDriverAfterTheOther) {
  EXPECT_EQ(driverAfter("", {"/left", "/right"}), "/left");
  EXPECT_EQ(driverAfter("/left", {"/left", "/right"}), "/right");
  EXPECT_EQ(driverAfter("/right", {"/left", "/right"}), "/left") << "it may run by now";
  EXPECT_EQ(driverAfter("/middle", {"/left", "/right"}), "/right") << "the master does not know it any more";
  EXPECT_EQ(driverAfter("/left", {"/left"}), "/left");
  EXPECT_EQ(driverAfter("/left", {}), "/left");
}

}  // namespace
}  // namespace aibo_driver::remote_control
