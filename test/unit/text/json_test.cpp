#include "text/json.h"

#include <gmock/gmock.h>

#include <limits>

namespace aibo_driver::text {
namespace {

TEST(Json, HasNumbersTextsAndTruth) {
  EXPECT_EQ(Json(3).text(), "3");
  EXPECT_EQ(Json(-1.23456789).text(), "-1.23456789");
  EXPECT_EQ(Json(true).text(), "true");
  EXPECT_EQ(Json("nod").text(), "\"nod\"");
  EXPECT_EQ(Json().text(), "null");
}

TEST(Json, HasNoNumberThatOthersCannotRead) {
  EXPECT_EQ(Json(std::numeric_limits<double>::infinity()).text(), "null");
  EXPECT_EQ(Json(std::numeric_limits<double>::quiet_NaN()).text(), "null");
  EXPECT_EQ(Json(std::optional<double>()).text(), "null");
}

TEST(Json, NestsObjectsAndArrays) {
  EXPECT_EQ(Json::object({{"a", Json::array({1, "b"})}, {"c", Json::object({})}}).text(),
            R"({"a": [1, "b"], "c": {}})");
}

TEST(Json, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(Json("\"\\\n\x1b[2J\x7f").text(), R"("\"\\\u000a\u001b[2J\u007f")");
  EXPECT_EQ(Json("\xff").text(), "\"\xEF\xBF\xBD\"");                                  // not UTF-8
  EXPECT_EQ(Json("\xE2\x80\xAE").text(), "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"");  // U+202E turns the direction
  EXPECT_EQ(Json("Ger\xC3\xA4t").text(), "\"Ger\xC3\xA4t\"");
}

}  // namespace
}  // namespace aibo_driver::text
