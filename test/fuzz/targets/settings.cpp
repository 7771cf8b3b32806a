// The reader of RCSERVER.CFG: any text.
#include "rcserver/settings/Settings.h"

#include <iostream>
#include <string>

#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = FuzzInput(data, size).takeText(size);
  Settings settings;
  std::streambuf* const console = std::cout.rdbuf(nullptr);
  readSettings(text.data(), text.size(), &settings);
  std::cout.rdbuf(console);
  require(settings.silent_client_seconds >= 1 && settings.silent_client_seconds <= 3600,
          "the time is within its range");
  settings.allowed_addresses.Allow(0x7f000001);
  return 0;
}
