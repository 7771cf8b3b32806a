/// @file service_answer.h
#ifndef AIBO_DRIVER_NODE_SERVICE_ANSWER_H
#define AIBO_DRIVER_NODE_SERVICE_ANSWER_H

#include <exception>
#include <string>

#include "text/plain_text.h"

namespace aibo_driver::node {

/// Answers a call of a service with its result. The call itself never fails. The message quotes callers and the robot,
/// so it is plain text (text::plainText()) of at most 4000 bytes.
/// @param failure says what was not done; the message begins with it if `work` throws
/// @param work carries out the call and returns a message that says so
/// @return true, because roscpp wants that
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

#endif  // AIBO_DRIVER_NODE_SERVICE_ANSWER_H
