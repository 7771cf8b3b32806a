#include "simulated_ers7/primitive_table.h"

namespace simulated_ers7 {

PrimitiveTable::PrimitiveTable(const robot_model::RobotModel& model) {
  primitives_["PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1"] = kCameraPrimitive;
  for (int i = 0; i < model.number_of_joints; ++i) {
    primitives_[model.joints[i].locator] = jointPrimitive(static_cast<std::size_t>(i));
  }
}

OStatus PrimitiveTable::open(const char* locator, OPrimitiveID* id) {
  if (locator == nullptr || id == nullptr) {
    return oINVALID_ARG;
  }
  const auto found = primitives_.find(locator);
  if (found == primitives_.end()) {
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
