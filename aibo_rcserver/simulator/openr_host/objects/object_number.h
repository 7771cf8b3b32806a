/// @file object_number.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBJECT_NUMBER_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBJECT_NUMBER_H

#include <OID.h>

#include <cstddef>

namespace openr_host {

/// The identity of the n-th object of a system, from 1 on. What is an address on the robot is a number here.
inline OID oidOf(std::size_t number) {
  return OID(reinterpret_cast<void*>(number));
}

inline std::size_t numberOf(const OID& oid) {
  return reinterpret_cast<std::size_t>(oid.GetAddress());
}

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBJECT_NUMBER_H
