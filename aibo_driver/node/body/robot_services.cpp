#include <aibo_driver/DeleteMotion.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/StopMotion.h>
#include <aibo_driver/UploadMotion.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/service.h"
#include "node/services.h"
#include "text/sentence.h"

namespace aibo_driver::node {
namespace {

using aibo_client::EndedHow;
using files::motionFileName;

// How long each kind of call waits for the robot's answer. A memory stick is slow.
constexpr std::chrono::milliseconds kFileTimeout{5000};
constexpr std::chrono::milliseconds kUploadTimeout{15000};
constexpr std::chrono::milliseconds kPowerTimeout{5000};

std::vector<std::uint8_t> contentOf(const UploadMotion::Request& request) {
  if (request.file.empty() == request.data.empty()) {
    throw aibo_client::InvalidArgumentException(request.file.empty() ? "give a file or data"
                                                                     : "give a file or data, not both");
  }
  return request.file.empty() ? request.data : files::loadMotion(request.file);
}

void checkName(const std::string& name) {
  if (name.empty()) {
    throw aibo_client::InvalidArgumentException("give the name of a motion. list_motions lists them.");
  }
}

std::string nameOf(const UploadMotion::Request& request) {
  return motionFileName(request.name.empty() ? std::filesystem::path(request.file).filename().string() : request.name);
}

std::string play(movement::Mover* mover, ServiceCall<PlayMotion>* call) {
  const std::string name = motionFileName(call->request.name);
  const int repetitions = std::max<int>(1, call->request.repetitions);
  checkName(name);
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

void requirePermission(const movement::Mover& mover, const movement::Order& order) {
  const std::string refusal = mover.refusal(order);
  if (!refusal.empty()) {
    throw aibo_client::CommandException(refusal + ".");
  }
}

}  // namespace

Services stopServices(movement::Mover& mover) {
  return {
      service<std_srvs::Trigger>("stop", "No order moves the robot any more, but it could not be told to stop",
                                 [&mover](auto& call) {
                                   mover.stop(call.order);
                                   return "The robot holds, and nothing moves it until release is called.";
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
                            const std::string name = motionFileName(call.request.name);
                            mover.stopMotion(call.order, name);
                            return (name.empty() ? "No motion plays" : name + " does not play") +
                                   " now: the joints hold where they are.";
                          }),
  };
}

Services robotServices(aibo_client::RcServerClient& client, const movement::Mover& mover) {
  return {
      service<ListMotions>("list_motions", "The motions could not be listed",
                           [&client](auto& call) {
                             call.response.names = client.listMotions(kFileTimeout);
                             return "Motions on the robot: " + std::to_string(call.response.names.size()) + ".";
                           }),
      service<UploadMotion>("upload_motion", "Nothing was uploaded",
                            [&client](auto& call) {
                              const std::vector<std::uint8_t> content = contentOf(call.request);
                              const std::string name = nameOf(call.request);
                              client.uploadMotion(name, content, kUploadTimeout);
                              return name + " is on the robot, " + std::to_string(content.size()) + " bytes.";
                            }),
      service<DeleteMotion>("delete_motion", "Nothing was deleted",
                            [&client](auto& call) {
                              const std::string name = motionFileName(call.request.name);
                              checkName(name);
                              client.deleteMotion(name, kFileTimeout);
                              return name + " was deleted from the robot.";
                            }),
      service<std_srvs::Trigger>("shut_down", "The robot does not shut down",
                                 [&client, &mover](auto& call) {
                                   requirePermission(mover, call.order);
                                   client.shutDownRobot(kPowerTimeout);
                                   return "The robot shuts down. The driver connects again when it is switched on.";
                                 }),
      service<std_srvs::Trigger>("reboot", "The robot does not reboot",
                                 [&client, &mover](auto& call) {
                                   requirePermission(mover, call.order);
                                   client.rebootRobot(kPowerTimeout);
                                   return "The robot reboots. The driver connects again as soon as it answers.";
                                 }),
  };
}

}  // namespace aibo_driver::node
