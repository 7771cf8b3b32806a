#include "simulator/openr_host/object_library.h"

#include <dlfcn.h>

#include <cstring>
#include <memory>
#include <stdexcept>

namespace openr_host {

ObjectDescription loadObject(const std::string& file) {
  const std::shared_ptr<void> library(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL),
                                      [](void* handle) { handle != nullptr ? dlclose(handle) : 0; });
  void* const symbol = library != nullptr ? dlsym(library.get(), "describeLoadedObject") : nullptr;
  if (symbol == nullptr) {
    throw std::runtime_error(file + ": cannot be loaded (" + dlerror() +
                             "); build it for this computer with scripts/openr_object");
  }
  void (*describe)(ObjectDescription*) = nullptr;
  static_assert(sizeof(describe) == sizeof(symbol), "POSIX requires it");
  std::memcpy(&describe, &symbol, sizeof(describe));
  ObjectDescription description;
  describe(&description);
  description.library = library;
  return description;
}

}  // namespace openr_host
