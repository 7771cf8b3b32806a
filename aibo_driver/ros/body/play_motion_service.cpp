#include "ros/body/play_motion_service.h"

#include <algorithm>
#include <utility>

#include "aibo_driver/exceptions.h"
#include "ros/body/motion_name.h"
#include "ros/service_answer.h"

namespace aibo_driver::node {

PlayMotionService::PlayMotionService(const ros::NodeHandle& handle, RcServerClient& client,
                                     std::function<void()> beginning)
    : client_(client),
      beginning_(std::move(beginning)),
      server_(ros::NodeHandle(handle).advertiseService("play_motion", &PlayMotionService::playMotion, this)) {}

bool PlayMotionService::playMotion(PlayMotion::Request& request, PlayMotion::Response& response) {
  const std::string name = motionFileName(request.name);
  if (request.stop) {
    return answerService(response, "Nothing was stopped", [&] { return stop(name); });
  }
  return answerService(response, "Nothing is played",
                       [&] { return play(name, std::max<int>(1, request.repetitions)); });
}

std::string PlayMotionService::play(const std::string& name, int repetitions) {
  if (name.empty()) {
    throw InvalidArgumentException("say which motion. list_motions tells which there are.");
  }
  beginning_();
  client_.playMotion(name, repetitions, kTimeout);
  return name + " has begun, to be played " + (repetitions == 1 ? "once." : std::to_string(repetitions) + " times.");
}

std::string PlayMotionService::stop(const std::string& name) {
  client_.stopMotion(name, kTimeout);
  return (name.empty() ? "All motions" : name) + " stopped: the joints hold where they are.";
}

}  // namespace aibo_driver::node
