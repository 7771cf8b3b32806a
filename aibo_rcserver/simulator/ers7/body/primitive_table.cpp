#include "simulator/ers7/body/primitive_table.h"

namespace simulated_ers7 {

PrimitiveTable::PrimitiveTable(const robot_model::RobotModel& model) {
  add("PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1", kCameraPrimitive, {PrimitiveKind::kCamera, 0});
  const bool has_speaker_in_head = std::string(model.design) == "ERS-210";
  add(has_speaker_in_head ? "PRM:/r1/c1/c2/c3/s1-Speaker:S1" : "PRM:/s1-Speaker:S1", kSpeakerPrimitive,
      {PrimitiveKind::kSound, 0});
  add("PRM:/r1/c1/c2/c3/m1-Mic:M1", kMicrophonePrimitive, {PrimitiveKind::kSound, 0});
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.number_of_joints); ++i) {
    add(model.joints[i].locator, jointPrimitive(i), {PrimitiveKind::kJoint, i});
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.number_of_sensors); ++i) {
    add(model.sensors[i].locator, sensorPrimitive(i), {PrimitiveKind::kSensor, i});
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.number_of_leds); ++i) {
    add(model.leds[i].locator, ledPrimitive(i), {PrimitiveKind::kLed, i});
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.number_of_ears); ++i) {
    add(model.ears[i].locator, earPrimitive(i), {PrimitiveKind::kEar, i});
  }
}

void PrimitiveTable::add(const char* locator, OPrimitiveID id, const Primitive& primitive) {
  if (locator != nullptr) {  // parts without a locator appear only in OPENR::GetPowerStatus()
    ids_[locator] = id;
    primitives_.emplace(id, primitive);
  }
}

std::optional<Primitive> PrimitiveTable::find(OPrimitiveID id) const {
  return isOpen(id) ? std::make_optional(primitives_.at(id)) : std::nullopt;
}

OStatus PrimitiveTable::open(const char* locator, OPrimitiveID* id) {
  if (locator == nullptr || id == nullptr) {
    return oINVALID_ARG;
  }
  const auto found = ids_.find(locator);
  if (found == ids_.end()) {
    return oNOT_FOUND;
  }
  ++times_opened_[found->second];
  *id = found->second;
  return oSUCCESS;
}

OStatus PrimitiveTable::close(OPrimitiveID id) {
  if (id == oprimitiveID_UNDEF) {
    times_opened_.clear();
    return oSUCCESS;
  }
  const auto found = times_opened_.find(id);
  if (found == times_opened_.end()) {
    return oINVALID_PRIMITIVE_ID;
  }
  if (--found->second == 0) {
    times_opened_.erase(found);
  }
  return oSUCCESS;
}

}  // namespace simulated_ers7
