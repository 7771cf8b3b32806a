#include "ros/walk/posture_services.h"

#include <string>

#include "aibo_driver/exceptions.h"
#include "ros/service_answer.h"

namespace aibo_driver::node {
namespace {

struct Words {
  const char* failure;
  const char* success;
};

Words wordsFor(Posture posture) {
  switch (posture) {
    case Posture::kStand:
      return {"The robot does not stand", "The robot stands."};
    case Posture::kSit:
      return {"The robot does not sit", "The robot sits."};
    case Posture::kRest:
      break;
  }
  return {"The robot does not rest", "The robot lies down, and its motors are off."};
}

}  // namespace

void PostureServices::advertise(const ros::NodeHandle& handle) {
  ros::NodeHandle services(handle);
  servers_.push_back(services.advertiseService("stand", &PostureServices::stand, this));
  servers_.push_back(services.advertiseService("sit", &PostureServices::sit, this));
  servers_.push_back(services.advertiseService("rest", &PostureServices::rest, this));
}

bool PostureServices::take(Posture posture, std_srvs::Trigger::Response& response) {
  const Words words = wordsFor(posture);
  return answer(response, words.failure, [&] {
    const JointMover::Fate fate = mover_.takePosture(posture, kBeginTimeout);
    const movement::MovementFate end = mover_.waitForEnd(fate, kEndTimeout);
    if (!end.end) {
      throw TimeoutException("it began, but has not said within " + std::to_string(kEndTimeout.count() / 1000) +
                             " s that it has finished. motion_state says what it does.");
    }
    if (end.end != movement::MovementEnd::kDone) {
      throw CommandException(end.reason + ".");
    }
    return words.success;
  });
}

bool PostureServices::stand(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return take(Posture::kStand, response);
}

bool PostureServices::sit(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return take(Posture::kSit, response);
}

bool PostureServices::rest(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return take(Posture::kRest, response);
}

}  // namespace aibo_driver::node
