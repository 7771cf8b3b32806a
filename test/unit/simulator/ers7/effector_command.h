/// @file effector_command.h
#ifndef TEST_UNIT_SIMULATOR_ERS7_EFFECTOR_COMMAND_H
#define TEST_UNIT_SIMULATOR_ERS7_EFFECTOR_COMMAND_H

#include <cstring>

#include "simulator/openr_host/virtual_robot.h"

namespace simulated_ers7 {

template <typename Value>
openr_host::EffectorCommand effectorCommand(OPrimitiveID id, ODataType type, const Value& value) {
  openr_host::EffectorCommand command = {id, type, {}};
  std::memcpy(&command.value, &value, sizeof(value));
  return command;
}

}  // namespace simulated_ers7

#endif  // TEST_UNIT_SIMULATOR_ERS7_EFFECTOR_COMMAND_H
