#include <std_srvs/Trigger.h>

#include <chrono>
#include <future>
#include <string>

#include "aibo_client/exceptions.h"
#include "node/service.h"
#include "node/services.h"
#include "text/sentence.h"

namespace aibo_driver::node {

using aibo_client::Posture;

namespace {

// How long the change from one posture to another may take. The robot needs only a fraction of this time.
constexpr std::chrono::milliseconds kEndTimeout{30000};

std::string take(movement::Mover* mover, const movement::Order& order, Posture posture, const std::string& success) {
  const movement::Mover::Answer begun = mover->takePosture(order, posture);
  if (begun.end.wait_for(kEndTimeout) == std::future_status::timeout) {
    throw aibo_client::TimeoutException((begun.remark.empty() ? "it began" : begun.remark) +
                                        ", but has not said within " + std::to_string(kEndTimeout.count() / 1000) +
                                        " s that it has finished. motion_state says what it does.");
  }
  const movement::EndedMovement& end = begun.end.get();
  if (end.how != aibo_client::EndedHow::kDone) {
    throw aibo_client::CommandException(text::sentence(end.reason));
  }
  return success;
}

}  // namespace

Services postureServices(movement::Mover& mover) {
  const auto posture_service = [&mover](const std::string& name, Posture posture, const std::string& success) {
    return service<std_srvs::Trigger>(name, "The robot does not " + name, [&mover, posture, success](auto& call) {
      return take(&mover, call.order, posture, success);
    });
  };
  return {posture_service("stand", Posture::kStand, "The robot stands."),
          posture_service("sit", Posture::kSit, "The robot sits."),
          posture_service("rest", Posture::kRest, "The robot lies down, and its motors are off.")};
}

}  // namespace aibo_driver::node
