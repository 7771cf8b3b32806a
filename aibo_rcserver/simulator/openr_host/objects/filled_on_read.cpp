#include "simulator/openr_host/objects/filled_on_read.h"

#include <functional>
#include <iterator>
#include <map>
#include <mutex>

namespace openr_host {
namespace {

/// All memory of this kind, of all robots in this process.
struct Registry {
  std::mutex mutex;
  std::map<const char*, FilledOnRead*, std::less<>> by_begin;
};

Registry& registry() {
  static Registry instance;
  return instance;
}

}  // namespace

FilledOnRead::FilledOnRead(const void* memory, std::size_t size)
    : begin_(static_cast<const char*>(memory)), end_(begin_ + size) {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  registry().by_begin[begin_] = this;
}

FilledOnRead::~FilledOnRead() {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  const auto found = registry().by_begin.find(begin_);
  if (found->second == this) {
    registry().by_begin.erase(found);
  }
}

void FilledOnRead::read(const void* address) {
  std::function<void()> fill;
  {
    const std::lock_guard<std::mutex> lock(registry().mutex);
    const auto after = registry().by_begin.upper_bound(static_cast<const char*>(address));
    if (after == registry().by_begin.begin()) {
      return;
    }
    FilledOnRead& memory = *std::prev(after)->second;
    if (std::less<>()(address, static_cast<const void*>(memory.end_))) {
      fill = std::exchange(memory.fill_, nullptr);
    }
  }
  if (fill) {
    fill();
  }
}

}  // namespace openr_host
