#include <aibo_driver/DeleteMotion.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/UploadMotion.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/service.h"
#include "node/services.h"

namespace aibo_driver::node {
namespace {

using files::motionFileName;

// How long each kind of call waits for the robot's answer. The times are long because a memory stick is slow.
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

std::string nameOf(const UploadMotion::Request& request) {
  return motionFileName(request.name.empty() ? std::filesystem::path(request.file).filename().string() : request.name);
}

}  // namespace

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
                              const std::string name = motionNamed(call.request.name);
                              client.deleteMotion(name, kFileTimeout);
                              return name + " was deleted from the robot.";
                            }),
      service<std_srvs::Trigger>("shut_down", "The robot does not shut down",
                                 [&client, &mover](auto& call) {
                                   mover.requirePermission(call.order);
                                   client.shutDownRobot(kPowerTimeout);
                                   return "The robot shuts down. The driver connects again when it is switched on.";
                                 }),
      service<std_srvs::Trigger>("reboot", "The robot does not reboot",
                                 [&client, &mover](auto& call) {
                                   mover.requirePermission(call.order);
                                   client.rebootRobot(kPowerTimeout);
                                   return "The robot reboots. The driver connects again as soon as it answers.";
                                 }),
  };
}

}  // namespace aibo_driver::node
