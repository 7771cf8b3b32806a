#include "play_motion_service.h"

#include <algorithm>
#include <string>
#include <utility>

#include "aibo_driver/exceptions.h"
#include "motion_name.h"

namespace aibo_driver {

PlayMotionService::PlayMotionService(const ros::NodeHandle& handle, RcServerClient& client,
                                     std::function<void()> begun)
    : client_(client),
      begun_(std::move(begun)),
      server_(ros::NodeHandle(handle).advertiseService("play_motion", &PlayMotionService::playMotion, this)) {}

bool PlayMotionService::playMotion(PlayMotion::Request& request, PlayMotion::Response& response) {
  const std::string name = motionFileName(request.name);
  try {
    if (request.stop) {
      client_.stopMotion(name, kTimeout);
      response.message = (name.empty() ? "All motions" : name) + " stopped: the joints hold where they are.";
    } else if (name.empty()) {
      response.message = "Nothing is played: say which motion. list_motions tells which there are.";
      return true;
    } else {
      const int repetitions = std::max<int>(1, request.repetitions);
      client_.playMotion(name, repetitions, kTimeout);
      begun_();
      response.message =
          name + " has begun, to be played " + (repetitions == 1 ? "once." : std::to_string(repetitions) + " times.");
    }
    response.success = true;
  } catch (const Exception& error) {
    response.message = (request.stop ? "Nothing was stopped: " : "Nothing is played: ") + std::string(error.what());
  }
  return true;
}

}  // namespace aibo_driver
