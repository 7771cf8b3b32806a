// The configuration files of an OPEN-R memory stick: any text. The first byte says which file it is.
#include <sstream>

#include "fuzz_input.h"
#include "simulator/openr_host/configuration/configuration_error.h"
#include "simulator/openr_host/configuration/connection_configuration.h"
#include "simulator/openr_host/configuration/design_database.h"
#include "simulator/openr_host/configuration/object_configuration.h"
#include "simulator/openr_host/configuration/stub_configuration.h"

namespace {

void read(unsigned kind, std::istream& text) {
  switch (kind % 4) {
    case 0:
      openr_host::StubConfiguration::parse(text, "stub.cfg");
      break;
    case 1:
      openr_host::readObjectConfiguration(text, "OBJECT.CFG", "ERS-7");
      break;
    case 2:
      openr_host::readConnectionConfiguration(text, "CONNECT.CFG", "ERS-7",
                                              {"Camera.Image.Picture.S", "Server.Image.Picture.O", "Server.Other.T.O"});
      break;
    default:
      openr_host::readDesignDatabase(text, "DESIGNDB.CFG", "ERS-7");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  const unsigned kind = input.takeByte();
  std::istringstream text(input.takeText(size));
  try {
    read(kind, text);
  } catch (const openr_host::ConfigurationError&) {
  }
  return 0;
}
