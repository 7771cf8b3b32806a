#include "movement/measured_joints.h"

namespace aibo_driver::movement {

MeasuredJoints::MeasuredJoints(const JointTable& table) : table_(table), entries_(table.size()) {}

void MeasuredJoints::update(const aibo_client::Telemetry& telemetry) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const aibo_client::JointReading& reading : telemetry.joints) {
    const std::optional<std::size_t> index = table_.findById(reading.id);
    if (!index) {
      continue;
    }
    std::optional<Entry>& entry = entries_[*index];
    double velocity = 0;
    if (entry) {
      const double seconds = aibo_client::secondsBetween(entry->frame_number, entry->joint.arrival, telemetry);
      velocity = seconds > 0 ? (reading.position - entry->joint.position) / seconds : entry->joint.velocity;
    }
    entry = Entry{{reading.position, velocity, telemetry.arrival, reading.duty}, telemetry.frame_number};
  }
}

void MeasuredJoints::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  entries_.assign(table_.size(), std::nullopt);
}

std::optional<MeasuredJoint> MeasuredJoints::find(std::size_t index) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return entries_[index] ? std::optional<MeasuredJoint>(entries_[index]->joint) : std::nullopt;
}

}  // namespace aibo_driver::movement
