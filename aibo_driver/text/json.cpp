#include "text/json.h"

#include <cmath>
#include <cstdio>

#include "text/plain_text.h"

namespace aibo_driver::text {
namespace {

std::string quoted(const std::string& text) {
  constexpr const char* kReplacement = "\xEF\xBF\xBD";  // U+FFFD
  std::string quoted = "\"";
  for (const std::string& character : charactersOf(text)) {
    const auto byte = static_cast<unsigned char>(character.front());
    if (byte == '"' || byte == '\\') {
      quoted += '\\' + character;
    } else if (byte < 0x20 || byte == 0x7F) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", byte);
      quoted += escape;
    } else {
      quoted += character.size() == 1 && byte >= 0x80 ? kReplacement : character;
    }
  }
  return quoted + '"';
}

}  // namespace

Json::Json(const std::string& text) : text_(quoted(text)) {}

Json::Json(double value) : text_("null") {
  if (std::isfinite(value)) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    text_ = text;
  }
}

Json Json::array(const std::vector<Json>& values) {
  Json array;
  array.text_ = "[";
  for (const Json& value : values) {
    array.text_ += (array.text_.size() > 1 ? ", " : "") + value.text_;
  }
  array.text_ += "]";
  return array;
}

Json Json::object(std::initializer_list<std::pair<std::string, Json>> members) {
  Json object;
  object.text_ = "{";
  for (const auto& [name, value] : members) {
    object.text_ += (object.text_.size() > 1 ? ", " : "") + quoted(name) + ": " + value.text_;
  }
  object.text_ += "}";
  return object;
}

}  // namespace aibo_driver::text
