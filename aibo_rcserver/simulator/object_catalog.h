/// @file object_catalog.h
/// The objects on the project's memory stick.
#ifndef AIBO_RCSERVER_SIMULATOR_OBJECT_CATALOG_H
#define AIBO_RCSERVER_SIMULATOR_OBJECT_CATALOG_H

#include <map>
#include <string>

#include "FileKeeper_stub.h"
#include "PictureEncoder_stub.h"
#include "RCServer_stub.h"
#include "simulator/openr_host/object_description.h"

/// The objects for MachineOptions::catalog. They read hostSettings().
inline std::map<std::string, openr_host::ObjectDescription> objectCatalog() {
  return {{"RCSERVER.BIN", describeRCServer()},
          {"ENCODER.BIN", describePictureEncoder()},
          {"FILES.BIN", describeFileKeeper()}};
}

#endif  // AIBO_RCSERVER_SIMULATOR_OBJECT_CATALOG_H
