#include "support/resources.h"

#include <malloc.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace test_support {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr std::size_t kAllowedKilobytes = 1024;
constexpr milliseconds kSettleTime{300};
constexpr int kLooks = 20;

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

Resources Resources::settled() {
  std::this_thread::sleep_for(kSettleTime);
  ::malloc_trim(0);  // freed memory does not count
  return of();
}

std::string Resources::growth(bool without_memory) const {
  Resources now;
  for (int look = 0; look < kLooks; ++look) {
    now = settled();
    if (now.descriptors <= descriptors && now.threads <= threads) {
      break;
    }
  }
  std::ostringstream text;
  if (now.descriptors > descriptors) {
    text << now.descriptors - descriptors << " file descriptors more ";
  }
  if (now.threads > threads) {
    text << now.threads - threads << " threads more ";
  }
  if (kMemoryCounts && !without_memory && now.resident_kilobytes > resident_kilobytes + kAllowedKilobytes) {
    text << now.resident_kilobytes - resident_kilobytes << " KB more";
  }
  return text.str();
}

}  // namespace test_support
