/// @file nodelet_host.h
#ifndef TEST_SUPPORT_ROS_NODELET_HOST_H
#define TEST_SUPPORT_ROS_NODELET_HOST_H

#include <string>
#include <vector>

namespace test_support {

/// The command that starts ROS' host of nodelets. In a build with a sanitizer its library is there before those of ours
/// are loaded; what the host itself leaves behind at its end is not ours to mend.
/// @param arguments such as {"standalone", "aibo_driver/AiboDriverNodelet"}
std::vector<std::string> nodeletHost(const std::vector<std::string>& arguments);

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_NODELET_HOST_H
