#include "node/walk/odometry_publisher.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aibo_driver::node {
namespace {

TEST(OdometryMessage, HasThePlaceTheVelocityAndTheirUncertainty) {
  walk::Odometry walked;
  walked.walk({0, 0, 0.5}, 2);
  walked.walk({0.1, -0.05, 0.5}, 0.032);
  const nav_msgs::Odometry odom = toMessage(walked, {0.1, -0.05, 0.5});
  EXPECT_NEAR(odom.pose.pose.orientation.z, std::sin(0.508), 5e-3);
  EXPECT_NEAR(odom.pose.pose.orientation.w, std::cos(0.508), 5e-3);
  EXPECT_EQ(odom.pose.pose.position.x, walked.x());
  EXPECT_EQ(odom.pose.pose.position.y, walked.y());
  EXPECT_NE(walked.x(), walked.y());
  EXPECT_DOUBLE_EQ(odom.twist.twist.linear.x, 0.1);
  EXPECT_DOUBLE_EQ(odom.twist.twist.linear.y, -0.05);
  EXPECT_DOUBLE_EQ(odom.twist.twist.angular.z, 0.5);
  EXPECT_GT(odom.twist.covariance[0], 1e-4);
  EXPECT_EQ(odom.pose.covariance[35], walked.covariance()(2, 2));
  EXPECT_EQ(odom.pose.covariance[5], walked.covariance()(0, 2));
  for (const std::size_t place : {14, 21, 28}) {
    EXPECT_EQ(odom.pose.covariance[place], 1e6) << "it measures neither its height nor roll nor pitch";
    EXPECT_EQ(odom.twist.covariance[place], 1e6);
  }
  EXPECT_GT(toMessage(walked, {0, 0.1, 0}).twist.covariance[0], 1e-4) << "sideways";
  EXPECT_GT(toMessage(walked, {0.1, 0, 0}).twist.covariance[35], 1e-4) << "it does not walk quite straight";
  EXPECT_GT(odom.twist.covariance[35], 2 * odom.twist.covariance[0]) << "it mostly turns";
  EXPECT_LT(toMessage(walked, {}).twist.covariance[0], 1e-5) << "it stands";
  EXPECT_GT(toMessage(walked, {}).twist.covariance[0], 0) << "0 would mean unknown";
}

}  // namespace
}  // namespace aibo_driver::node
