#include "openr_host/configuration/stub_configuration.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <utility>

#include "openr_host/configuration/configuration_error.h"

namespace openr_host {
namespace {

/// A word, a number, a text in quotation marks (these included) or one of `:` `,` `(` `)`. Empty at the end.
struct Token {
  std::string text;
  int line;
};

class Tokenizer {
 public:
  Tokenizer(std::istream& text, std::string file)
      : text_(std::istreambuf_iterator<char>(text), {}), file_(std::move(file)) {}

  Token next() {
    skipSpace();
    const int line = line_;
    if (position_ == text_.size()) {
      return {"", line};
    }
    if (text_[position_] == '"') {
      return {quoted(), line};
    }
    if (isWordCharacter(text_[position_])) {
      return {word(), line};
    }
    return {std::string(1, text_[position_++]), line};
  }

 private:
  static bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

  void skipSpace() {
    while (position_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[position_])) != 0) {
      line_ += text_[position_++] == '\n' ? 1 : 0;
    }
  }

  std::string word() {
    const auto begin = position_;
    while (position_ < text_.size() && isWordCharacter(text_[position_])) {
      ++position_;
    }
    return text_.substr(begin, position_ - begin);
  }

  std::string quoted() {
    const auto begin = position_;
    const auto end = text_.find_first_of("\"\n", begin + 1);
    if (end == std::string::npos || text_[end] == '\n') {
      throw ConfigurationError(file_, line_, "the quotation mark is not closed on its line");
    }
    position_ = end + 1;
    return text_.substr(begin, position_ - begin);
  }

  const std::string text_;
  const std::string file_;
  std::size_t position_ = 0;
  int line_ = 1;
};

bool isIdentifier(const std::string& text) {
  return !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_');
}

bool isNumber(const std::string& text) {
  return !text.empty() && text.size() < 6 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

class Parser {
 public:
  Parser(std::istream& text, const std::string& file) : tokenizer_(text, file), file_(file) { advance(); }

  StubConfiguration parse() {
    while (!token_.text.empty()) {
      parseEntry();
    }
    if (stub_.object_name.empty()) {
      fail("there is no ObjectName : NAME");
    }
    check(number_of_subjects_, "NumOfOSubject", stub_.subjects.size(), ".S");
    check(number_of_observers_, "NumOfOObserver", stub_.observers.size(), ".O");
    return stub_;
  }

 private:
  struct Count {
    std::size_t value;
    int line;
  };

  void parseEntry() {
    const Token keyword = token_;
    advance();
    if (keyword.text == "ObjectName") {
      parseObjectName(keyword);
    } else if (keyword.text == "NumOfOSubject") {
      parseCount(keyword, number_of_subjects_);
    } else if (keyword.text == "NumOfOObserver") {
      parseCount(keyword, number_of_observers_);
    } else if (keyword.text == "Service") {
      parseService();
    } else if (keyword.text == "Extra") {
      parseExtra();
    } else {
      throw error(keyword,
                  "expected ObjectName, NumOfOSubject, NumOfOObserver, Service or Extra, found " + shown(keyword));
    }
  }

  void parseObjectName(const Token& keyword) {
    expect(":");
    if (!stub_.object_name.empty()) {
      throw error(keyword, "a second ObjectName");
    }
    stub_.object_name = takeIdentifier("the object's name");
  }

  void parseCount(const Token& keyword, std::optional<Count>& count) {
    expect(":");
    if (count) {
      throw error(keyword, "a second " + keyword.text);
    }
    if (!isNumber(token_.text)) {
      fail("expected a number, found " + shown(token_));
    }
    count = Count{std::stoul(token_.text), keyword.line};
    advance();
  }

  void parseService() {
    expect(":");
    const Token name_token = token_;
    const ServiceName name = takeServiceName();
    expect(",");
    const std::string connection_function = takeFunctionOrNull();
    expect(",");
    auto& services = name.is_subject ? stub_.subjects : stub_.observers;
    if (std::any_of(services.begin(), services.end(),
                    [&](const StubService& other) { return other.name.service == name.service; })) {
      throw error(name_token, "a second service " + name.service);
    }
    services.push_back({name, connection_function, takeFunctionOrNull()});
  }

  void parseExtra() {
    expect(":");
    const Token name = token_;
    const std::string function = takeFunction();
    auto& functions = stub_.extra_functions;
    if (std::find(functions.begin(), functions.end(), function) != functions.end()) {
      throw error(name, "a second Extra : " + function + "()");
    }
    functions.push_back(function);
  }

  ServiceName takeServiceName() {
    const std::string& text = token_.text;
    const auto name = text.size() > 2 && text.front() == '"' ? ServiceName::parse(text.substr(1, text.size() - 2))
                                                             : std::optional<ServiceName>();
    if (!name) {
      fail("expected a service name such as \"Object.Service.DataType.S\" (or .O), found " + shown(token_));
    }
    if (name->object != stub_.object_name) {
      fail("service " + name->text() + " does not begin with the ObjectName, " +
           (stub_.object_name.empty() ? "which has to come first" : stub_.object_name));
    }
    advance();
    return *name;
  }

  std::string takeFunctionOrNull() {
    if (token_.text == "null") {
      advance();
      return "";
    }
    return takeFunction();
  }

  std::string takeFunction() {
    const std::string name = takeIdentifier("a function such as Notify()");
    expect("(");
    expect(")");
    return name;
  }

  std::string takeIdentifier(const std::string& what) {
    const std::string text = token_.text;
    if (!isIdentifier(text)) {
      fail("expected " + what + ", found " + shown(token_));
    }
    advance();
    return text;
  }

  void expect(const std::string& text) {
    if (token_.text != text) {
      fail("expected '" + text + "', found " + shown(token_));
    }
    advance();
  }

  void check(const std::optional<Count>& count, const std::string& keyword, std::size_t services,
             const std::string& ending) const {
    if (!count) {
      fail("there is no " + keyword + " : NUMBER");
    }
    if (count->value == 0) {
      throw ConfigurationError(file_, count->line,
                               keyword +
                                   " must be at least 1 on the robot. An object that needs none declares a dummy: "
                                   "Service : \"" +
                                   stub_.object_name + ".Dummy.DoNotConnect" + ending + "\", null, null");
    }
    if (count->value != services) {
      throw ConfigurationError(file_, count->line,
                               keyword + " is " + std::to_string(count->value) + ", but there are " +
                                   std::to_string(services) + " services that end in " + ending);
    }
  }

  void advance() { token_ = tokenizer_.next(); }

  static std::string shown(const Token& token) {
    return token.text.empty() ? "the end of the file" : "'" + token.text + "'";
  }

  ConfigurationError error(const Token& token, const std::string& what) const { return {file_, token.line, what}; }

  [[noreturn]] void fail(const std::string& what) const { throw error(token_, what); }

  Tokenizer tokenizer_;
  const std::string file_;
  Token token_;
  StubConfiguration stub_;
  std::optional<Count> number_of_subjects_;
  std::optional<Count> number_of_observers_;
};

}  // namespace

StubConfiguration StubConfiguration::parse(std::istream& text, const std::string& file) {
  return Parser(text, file).parse();
}

}  // namespace openr_host
