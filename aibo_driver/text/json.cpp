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

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    text += (text.empty() ? "" : ", ") + part;
  }
  return text;
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
  std::vector<std::string> parts;
  parts.reserve(values.size());
  for (const Json& value : values) {
    parts.push_back(value.text_);
  }
  Json array;
  array.text_ = "[" + joined(parts) + "]";
  return array;
}

Json Json::object(std::initializer_list<std::pair<std::string, Json>> members) {
  std::vector<std::string> parts;
  parts.reserve(members.size());
  for (const auto& [name, value] : members) {
    parts.push_back(quoted(name) + ": " + value.text_);
  }
  Json object;
  object.text_ = "{" + joined(parts) + "}";
  return object;
}

}  // namespace aibo_driver::text
