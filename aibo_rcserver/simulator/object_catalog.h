/// @file object_catalog.h
/// The objects that the project's memory stick names.
#ifndef AIBO_RCSERVER_SIMULATOR_OBJECT_CATALOG_H
#define AIBO_RCSERVER_SIMULATOR_OBJECT_CATALOG_H

#include <map>
#include <string>

#include "simulator/openr_host/object_description.h"

/// For MachineOptions::catalog: RCSERVER.BIN and its helpers ENCODER.BIN and FILES.BIN. They find hostSettings().
std::map<std::string, openr_host::ObjectDescription> objectCatalog();

#endif  // AIBO_RCSERVER_SIMULATOR_OBJECT_CATALOG_H
