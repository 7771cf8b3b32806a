#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/StopMotion.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <string>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/service.h"
#include "node/services.h"
#include "text/sentence.h"

namespace aibo_driver::node {

using aibo_client::EndedHow;

namespace {

std::string play(movement::Mover* mover, ServiceCall<PlayMotion>* call) {
  const std::string name = motionNamed(call->request.name);
  const int repetitions = std::max<int>(1, call->request.repetitions);
  const movement::Mover::Answer begun = mover->play(call->order, name, repetitions);
  const movement::EndedMovement* const end = begun.ended();
  if (end != nullptr && end->how != EndedHow::kDone && end->how != EndedHow::kUnknown) {
    throw aibo_client::CommandException(text::sentence(end->reason));
  }
  if (begun.is_uncertain) {
    call->failure = name + " may or may not play";
    throw aibo_client::TimeoutException(begun.remark + ". motion_state says when it is known.");
  }
  return name + " has begun and plays " + (repetitions == 1 ? "once" : std::to_string(repetitions) + " times") +
         (begun.remark.empty() ? "." : ": " + begun.remark + ".");
}

// How long the change from one posture to another may take. The robot needs only a fraction of this time.
constexpr std::chrono::milliseconds kEndTimeout{30000};

std::string takePosture(movement::Mover* mover, const movement::Order& order, aibo_client::Posture posture,
                        const std::string& success) {
  const movement::Mover::Answer begun = mover->takePosture(order, posture);
  if (begun.end.wait_for(kEndTimeout) == std::future_status::timeout) {
    throw aibo_client::TimeoutException((begun.remark.empty() ? "it began" : begun.remark) +
                                        ", but has not said within " + std::to_string(kEndTimeout.count() / 1000) +
                                        " s that it has finished. motion_state says what it does.");
  }
  const movement::EndedMovement& end = begun.end.get();
  if (end.how != EndedHow::kDone) {
    throw aibo_client::CommandException(text::sentence(end.reason));
  }
  return success;
}

}  // namespace

std::string motionNamed(const std::string& name) {
  std::string file = files::motionFileName(name);
  if (file.empty()) {
    throw aibo_client::InvalidArgumentException("give the name of a motion. list_motions lists them.");
  }
  return file;
}

Services stopServices(movement::Mover& mover) {
  return {
      service<std_srvs::Trigger>("stop",
                                 "Until release is called, only rest moves the robot, but it could not be told to stop",
                                 [&mover](auto& call) {
                                   mover.stop(call.order);
                                   return "The robot holds. Until release is called, only rest moves it.";
                                 }),
      service<std_srvs::Trigger>("release", "The robot stays stopped",
                                 [&mover](auto& call) {
                                   mover.release(call.order);
                                   return "The robot may be moved again.";
                                 }),
      service<std_srvs::SetBool>("motors", "The motors were not switched",
                                 [&mover](auto& call) {
                                   const bool on = call.request.data != 0;
                                   const bool is_on = mover.setMotors(call.order, on);
                                   if (is_on != on) {
                                     throw aibo_client::CommandException(
                                         std::string("the robot says that they are still ") + (is_on ? "on." : "off."));
                                   }
                                   return is_on ? "The motors are on."
                                                : "The motors are off: the joints can be moved by hand.";
                                 }),
  };
}

Services motionServices(movement::Mover& mover) {
  return {
      service<PlayMotion>("play_motion", "Nothing was played", [&mover](auto& call) { return play(&mover, &call); }),
      service<StopMotion>("stop_motion", "Nothing was stopped",
                          [&mover](auto& call) {
                            const std::string name = files::motionFileName(call.request.name);
                            mover.stopMotion(call.order, name);
                            return (name.empty() ? "No motion plays" : name + " does not play") +
                                   " now: the joints hold where they are.";
                          }),
  };
}

Services postureServices(movement::Mover& mover) {
  const auto posture_service = [&mover](const std::string& name, aibo_client::Posture posture,
                                        const std::string& success) {
    return service<std_srvs::Trigger>(name, "The robot does not " + name, [&mover, posture, success](auto& call) {
      return takePosture(&mover, call.order, posture, success);
    });
  };
  return {posture_service("stand", aibo_client::Posture::kStand, "The robot stands."),
          posture_service("sit", aibo_client::Posture::kSit, "The robot sits."),
          posture_service("rest", aibo_client::Posture::kRest, "The robot lies down, and its motors are off.")};
}

}  // namespace aibo_driver::node
