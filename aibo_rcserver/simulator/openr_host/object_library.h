/// @file object_library.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECT_LIBRARY_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECT_LIBRARY_H

#include <string>

#include "simulator/openr_host/object_description.h"

namespace openr_host {

/// Loads an object that scripts/openr_object has built. The program must export OPEN-R's functions (ENABLE_EXPORTS).
/// The library is unloaded with the last copy of the description, so that the object's static data begins anew at
/// each boot, as on the robot.
/// @param file a shared library with the function describeLoadedObject()
/// @throw std::runtime_error it is none; the text names the file and a remedy
ObjectDescription loadObject(const std::string& file);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECT_LIBRARY_H
