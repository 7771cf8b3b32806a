// The reader of colour tables, which users of load_color_table may send: any text.
#include <string>

#include "camera/color_table_file.h"
#include "fuzz_input.h"
#include "protocol/text.h"

using namespace aibo_driver;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const aibo_client::ColorTable table = camera::parseColorTable(FuzzInput(data, size).takeText(size), "any.yaml");
    require(!table.name.empty() && protocol::isPlainText(table.name.data(), table.name.size()),
            "a table has a name that can be shown");
    const aibo_client::ColorTable same = camera::parseColorTable(camera::toYaml(table), "again.yaml");
    require(same.name == table.name && same.segments == table.segments, "a table that is written is read again");
    camera::colorOf(table);
  } catch (const camera::ColorTableException& error) {
    const std::string text = error.what();
    require(text.rfind("any.yaml", 0) == 0, "an error is about the input, and says where");
    require(text.size() < 500 && protocol::isPlainText(text.data(), text.size()), "an error can be shown");
  }
  return 0;
}
