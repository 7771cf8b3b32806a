#include "simulator/object_catalog.h"

#include "FileKeeper_stub.h"
#include "PictureEncoder_stub.h"
#include "RCServer_stub.h"

std::map<std::string, openr_host::ObjectDescription> objectCatalog() {
  return {{"RCSERVER.BIN", describeRCServer()},
          {"ENCODER.BIN", describePictureEncoder()},
          {"FILES.BIN", describeFileKeeper()}};
}
