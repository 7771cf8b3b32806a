/// @file call_service.h
#ifndef TEST_UNIT_DRIVER_CALL_SERVICE_H
#define TEST_UNIT_DRIVER_CALL_SERVICE_H

#include <gtest/gtest.h>
#include <ros/advertise_service_options.h>
#include <ros/serialization.h>

#include <boost/make_shared.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace test_support {

/// Calls one of these services, as roscpp does, but without a ROS master.
template <typename Service>
typename Service::Response callService(const std::vector<ros::AdvertiseServiceOptions>& services,
                                       const std::string& name, const typename Service::Request& request = {},
                                       const std::string& caller = "/user") {
  typename Service::Response response;
  const auto found = std::find_if(services.begin(), services.end(), [&name](const auto& each) {
    return each.service == name && each.md5sum == ros::service_traits::md5sum<Service>();
  });
  if (found == services.end()) {
    ADD_FAILURE() << "there is no service " << name << " of this type";
    return response;
  }
  ros::ServiceCallbackHelperCallParams call;
  call.request = ros::serialization::serializeMessage(request);
  call.connection_header = boost::make_shared<ros::M_string>();
  (*call.connection_header)["callerid"] = caller;
  EXPECT_TRUE(found->helper->call(call)) << "a call of " << name << " fails";
  constexpr std::uint32_t kHeader = 5;  // success of the call and size of the response
  ros::serialization::IStream answer(call.response.buf.get() + kHeader,
                                     static_cast<std::uint32_t>(call.response.num_bytes) - kHeader);
  ros::serialization::deserialize(answer, response);
  return response;
}

}  // namespace test_support

#endif  // TEST_UNIT_DRIVER_CALL_SERVICE_H
