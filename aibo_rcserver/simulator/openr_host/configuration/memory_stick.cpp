#include "simulator/openr_host/configuration/memory_stick.h"

#include <strings.h>

#include <algorithm>
#include <stdexcept>

namespace openr_host {

std::filesystem::path findOnMemoryStick(const std::filesystem::path& folder, const std::string& name) {
  std::filesystem::path found = folder;
  for (const auto& part : std::filesystem::path(name)) {
    std::error_code error;
    const std::filesystem::directory_iterator entries(found, error);
    if (error) {
      throw std::runtime_error("memory stick: the folder " + found.string() + " cannot be read: " + error.message());
    }
    const auto entry =
        std::find_if(begin(entries), end(entries), [&](const std::filesystem::directory_entry& candidate) {
          return strcasecmp(candidate.path().filename().c_str(), part.c_str()) == 0;
        });
    if (entry == end(entries)) {
      throw std::runtime_error("memory stick: " + folder.string() + " has no " + name + " (there is no " +
                               part.string() + " in " + found.string() + ")");
    }
    found = entry->path();
  }
  return found;
}

bool isOnMemoryStick(const std::filesystem::path& folder, const std::string& name) {
  try {
    findOnMemoryStick(folder, name);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace openr_host
