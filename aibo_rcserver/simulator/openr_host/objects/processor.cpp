#include "simulator/openr_host/objects/processor.h"

#include <algorithm>

namespace openr_host {

void Processor::add(OID object, int priority, bool waits) {
  tasks_[object].scheduling_class = priority / 16;
  tasks_[object].waits = waits;
}

bool Processor::mayRun(OID object, Time now) const {
  const int own_class = tasks_.at(object).scheduling_class;
  return std::none_of(tasks_.begin(), tasks_.end(), [&](const auto& task) {
    const bool needs_processor = !task.second.waits || task.first == object;
    return task.second.busy_until > now && needs_processor && task.second.scheduling_class >= own_class;
  });
}

void Processor::run(OID object, Time now, Time duration) {
  const Task& own = tasks_.at(object);
  for (auto& [other, task] : tasks_) {
    if (!own.waits && !task.waits && task.scheduling_class < own.scheduling_class && task.busy_until > now) {
      task.busy_until += duration;
    }
  }
  tasks_[object].busy_until = now + duration;
}

std::optional<Processor::Time> Processor::nextFinish(Time now) const {
  std::optional<Time> next;
  for (const auto& [object, task] : tasks_) {
    if (task.busy_until > now && (!next || task.busy_until < *next)) {
      next = task.busy_until;
    }
  }
  return next;
}

}  // namespace openr_host
