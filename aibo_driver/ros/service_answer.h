/// @file service_answer.h
#ifndef AIBO_DRIVER_ROS_SERVICE_ANSWER_H
#define AIBO_DRIVER_ROS_SERVICE_ANSWER_H

#include <exception>
#include <string>

namespace aibo_driver::node {

/// Answers a service call with how it went. What cannot be done is an answer, too: the call itself never fails.
/// @tparam Response has success and message
/// @param failure what was not done: begins the message if `work` throws
/// @param work does what was asked, and returns the message that says so
/// @return true, for roscpp
template <typename Response, typename Work>
bool answerService(Response& response, const std::string& failure, const Work& work) {
  try {
    response.message = work();
    response.success = true;
  } catch (const std::exception& error) {
    response.message = failure + ": " + error.what();
  }
  return true;
}

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_SERVICE_ANSWER_H
