#include "node/walk/posture_services.h"

#include <future>
#include <string>

#include "aibo_client/exceptions.h"
#include "node/orders.h"
#include "node/service_answer.h"

namespace aibo_driver::node {

using aibo_client::Posture;

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
  const auto advertise = [&](const std::string& name, Posture posture) {
    servers_.push_back(advertiseOrder<std_srvs::Trigger>(
        services, name, [this, posture](const movement::Order& order, const auto&, auto& response) {
          return take(posture, order, response);
        }));
  };
  advertise("stand", Posture::kStand);
  advertise("sit", Posture::kSit);
  advertise("rest", Posture::kRest);
}

bool PostureServices::take(Posture posture, const movement::Order& order, std_srvs::Trigger::Response& response) {
  const Words words = wordsFor(posture);
  return answer(response, words.failure, [&] {
    const movement::Mover::Begun begun = mover_.takePosture(order, posture);
    if (begun.end.wait_for(kEndTimeout) == std::future_status::timeout) {
      throw aibo_client::TimeoutException((begun.remark.empty() ? "it began" : begun.remark) +
                                          ", but has not said within " + std::to_string(kEndTimeout.count() / 1000) +
                                          " s that it has finished. motion_state says what it does.");
    }
    const movement::EndedMovement& end = begun.end.get();
    if (end.how != aibo_client::EndedHow::kDone) {
      throw aibo_client::CommandException(end.reason + ".");
    }
    return words.success;
  });
}

}  // namespace aibo_driver::node
