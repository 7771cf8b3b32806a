#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "driver_rostest", ros::init_options::AnonymousName);
  testing::InitGoogleTest(&argc, argv);
  const ros::NodeHandle handle;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
