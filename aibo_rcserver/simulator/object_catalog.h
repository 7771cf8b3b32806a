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

/// For MachineOptions::catalog. The objects read hostSettings().
inline std::map<std::string, openr_host::ObjectDescription> objectCatalog() {
  openr_host::ObjectDescription file_keeper = describeFileKeeper();
  file_keeper.waits = true;
  return {{"RCSERVER.BIN", describeRCServer()}, {"ENCODER.BIN", describePictureEncoder()}, {"FILES.BIN", file_keeper}};
}

#endif  // AIBO_RCSERVER_SIMULATOR_OBJECT_CATALOG_H
