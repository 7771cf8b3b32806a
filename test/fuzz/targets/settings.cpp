// The reader of RCSERVER.CFG: any text.
#include "rcserver/settings/Settings.h"

#include <string>

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
  const std::string text = FuzzInput(data, size).takeText(size);
  Settings settings;
  Listener listener;
  readSettings(text.data(), text.size(), &settings, listener);
  require(settings.silent_client_seconds >= 1 && settings.silent_client_seconds <= 3600,
          "the time is within its range");
  settings.allowed_addresses.Allow(0x7f000001);
  return 0;
}
