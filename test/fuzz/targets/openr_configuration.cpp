// The configuration files of an OPEN-R memory stick: any text. The first byte selects the file.
#include <sstream>

#include "fuzz_input.h"
#include "simulator/openr_host/memory_stick.h"

namespace {

void read(unsigned kind, std::istream& text) {
  switch (kind % 3) {
    case 0:
      openr_host::readObjectConfiguration(text, "OBJECT.CFG", "ERS-7");
      break;
    case 1:
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
