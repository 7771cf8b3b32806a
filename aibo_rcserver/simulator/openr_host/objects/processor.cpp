#include "simulator/openr_host/objects/processor.h"

#include <algorithm>
#include <stdexcept>

namespace openr_host {

void Processor::add(OID object, int priority, bool waits) {
  tasks_.push_back({object, priority / 16, waits});
}

const Processor::Task& Processor::taskOf(OID object) const {
  const auto found =
      std::find_if(tasks_.begin(), tasks_.end(), [&](const Task& task) { return task.object == object; });
  if (found == tasks_.end()) {
    throw std::out_of_range("no object with this ID was added to the processor");
  }
  return *found;
}

bool Processor::mayRun(OID object, Time now) const {
  const int own_class = taskOf(object).scheduling_class;
  return std::none_of(tasks_.begin(), tasks_.end(), [&](const Task& task) {
    const bool needs_processor = !task.waits || task.object == object;
    return task.busy_until > now && needs_processor && task.scheduling_class >= own_class;
  });
}

void Processor::run(OID object, Time now, Time duration) {
  const Task own = taskOf(object);
  for (Task& task : tasks_) {
    if (task.object == object) {
      task.busy_until = now + duration;
    } else if (!own.waits && !task.waits && task.scheduling_class < own.scheduling_class && task.busy_until > now) {
      task.busy_until += duration;
    }
  }
}

std::optional<Processor::Time> Processor::nextFinish(Time now) const {
  std::optional<Time> next;
  for (const Task& task : tasks_) {
    if (task.busy_until > now && (!next || task.busy_until < *next)) {
      next = task.busy_until;
    }
  }
  return next;
}

}  // namespace openr_host
