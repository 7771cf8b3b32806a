/// @file json.h
#ifndef AIBO_DRIVER_TEXT_JSON_H
#define AIBO_DRIVER_TEXT_JSON_H

#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace aibo_driver::text {

/// A JSON value (RFC 8259). This class only writes JSON. Numbers that are not finite and empty optionals become null.
/// Control characters are escaped. Other bytes that text::plainText() would not show become U+FFFD. So every text gives
/// a valid document in one line that a terminal can show.
class Json {
 public:
  Json() : text_("null") {}
  Json(const char* text) : Json(std::string(text)) {}
  Json(const std::string& text);
  Json(bool value) : text_(value ? "true" : "false") {}
  Json(double value);

  template <typename Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  Json(Integer value) : text_(std::to_string(value)) {}

  template <typename Value>
  Json(const std::optional<Value>& value) : Json(value ? Json(*value) : Json()) {}

  static Json array(const std::vector<Json>& values);

  /// @param members each name appears once
  static Json object(std::initializer_list<std::pair<std::string, Json>> members);

  /// The document in one line.
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace aibo_driver::text

#endif  // AIBO_DRIVER_TEXT_JSON_H
