#include "support/resources.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "support/safety_net.h"

namespace test_support {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

Resources Resources::of(const std::string& process) {
  const std::string folder = "/proc/" + process;
  Resources resources;
  resources.descriptors = entries(folder + "/fd");
  resources.threads = entries(folder + "/task");
  std::ifstream status(folder + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) {
      std::istringstream(line.substr(6)) >> resources.resident_kilobytes;
    }
  }
  return resources;
}

std::string Resources::growth() const {
  Resources now = of();
  const auto end = std::chrono::steady_clock::now() + kSafetyNet;
  while ((now.descriptors > descriptors || now.threads > threads) && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    now = of();
  }
  return (now.descriptors > descriptors ? std::to_string(now.descriptors - descriptors) + " descriptors more " : "") +
         (now.threads > threads ? std::to_string(now.threads - threads) + " threads more" : "");
}

}  // namespace test_support
