// The reader of RCSERVER.CFG: any text.
#include "rcserver/settings/Settings.h"

#include <cstdio>

#include "fuzz_input.h"

namespace {

class Listener final : public SettingsProblems {
 public:
  void Report(int line, const char* text) override {
    require(line > 0 && text[0] != '\0', "a problem has a line and a text");
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes text = FuzzInput(data, size).takeBytes(size);
  if (text.empty()) {
    return 0;  // fmemopen() takes no empty file
  }
  std::FILE* const file = fmemopen(text.data(), text.size(), "rb");
  Settings settings;
  Listener listener;
  readSettings(file, &settings, listener);
  std::fclose(file);
  require(settings.silent_client_seconds >= 1 && settings.silent_client_seconds <= 3600,
          "the time is within its range");
  settings.allowed_addresses.Allow(0x7f000001);
  return 0;
}
