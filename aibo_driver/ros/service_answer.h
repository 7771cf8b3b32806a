/// @file service_answer.h
#ifndef AIBO_DRIVER_ROS_SERVICE_ANSWER_H
#define AIBO_DRIVER_ROS_SERVICE_ANSWER_H

#include <exception>
#include <string>

#include "text/plain_text.h"

namespace aibo_driver::node {

/// Answers a call of a service with how it went: the call itself never fails. The message quotes callers and the robot,
/// so it is plain text (text::plainText()) of at most 4000 bytes.
/// @param failure what was not done: begins the message if `work` throws
/// @param work does what was asked, and returns the message that says so
/// @return true, as roscpp wants
template <typename Response, typename Work>
bool answer(Response& response, const std::string& failure, const Work& work) {
  try {
    response.message = work();
    response.success = true;
  } catch (const std::exception& error) {
    response.message = failure + ": " + error.what();
  }
  constexpr std::size_t kLongest = 4000;
  response.message = text::plainText(response.message.substr(0, kLongest));
  return true;
}

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_SERVICE_ANSWER_H
