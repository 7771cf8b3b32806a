#include "simulator/openr_host/configuration/stub_configuration.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <utility>

#include "simulator/openr_host/configuration/configuration_error.h"
#include "simulator/openr_host/configuration/text.h"

namespace openr_host {
namespace {

std::string firstWord(const std::string& text) {
  return text.substr(0, text.find_first_of(kSpace));
}

bool isIdentifier(const std::string& text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

bool isNumber(const std::string& text) {
  return !text.empty() && text.size() < 6 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string shown(const std::string& text) {
  return text.empty() ? "nothing" : "'" + text + "'";
}

const char* const kKeywords[] = {"ObjectName",    "NumOfOSubject", "NumOfSubject", "NumOfOObserver",
                                 "NumOfObserver", "Service",       "Extra"};

/// What a line sets: one of the keywords before its first colon, and the text after it.
struct Setting {
  std::string keyword;
  std::string value;
  int line;
};

std::optional<Setting> readSetting(const std::string& text, int line) {
  const auto colon = text.find(':');
  const std::string keyword = withoutSpaceAround(text.substr(0, colon));
  if (colon == std::string::npos ||
      std::find(std::begin(kKeywords), std::end(kKeywords), keyword) == std::end(kKeywords)) {
    return std::nullopt;
  }
  return Setting{keyword, withoutSpaceAround(text.substr(colon + 1)), line};
}

class Parser {
 public:
  explicit Parser(std::string file) : file_(std::move(file)) {}

  StubConfiguration parse(std::istream& text) {
    int line = 0;
    for (std::string raw; std::getline(text, raw);) {
      if (const auto setting = readSetting(raw, ++line)) {
        take(*setting);
      }
    }
    if (stub_.object_name.empty()) {
      throw ConfigurationError(file_, line, "the file has no line ObjectName : NAME");
    }
    check(number_of_subjects_, line, "NumOfOSubject", stub_.subjects.size(), ".S");
    check(number_of_observers_, line, "NumOfOObserver", stub_.observers.size(), ".O");
    return stub_;
  }

 private:
  struct Count {
    std::size_t value;
    int line;
  };

  void take(const Setting& setting) {
    if (setting.keyword == "ObjectName") {
      takeObjectName(setting);
    } else if (setting.keyword == "Service") {
      takeService(setting);
    } else if (setting.keyword == "Extra") {
      takeExtra(setting);
    } else {
      const bool of_subjects = setting.keyword.find("Subject") != std::string::npos;
      takeCount(setting, of_subjects ? number_of_subjects_ : number_of_observers_);
    }
  }

  void takeObjectName(const Setting& setting) {
    if (!stub_.object_name.empty()) {
      fail(setting, "a second ObjectName");
    }
    stub_.object_name = firstWord(setting.value);
    if (!isIdentifier(stub_.object_name)) {
      fail(setting, "expected the name of the object's class, found " + shown(stub_.object_name));
    }
  }

  void takeCount(const Setting& setting, std::optional<Count>& count) const {
    if (count) {
      fail(setting, "a second " + setting.keyword);
    }
    const std::string number = firstWord(setting.value);
    if (!isNumber(number)) {
      fail(setting, "expected a number, found " + shown(number));
    }
    count = Count{std::stoul(number), setting.line};
  }

  void takeService(const Setting& setting) {
    std::vector<std::string> parts = splitAt(',', setting.value);
    std::transform(parts.begin(), parts.end(), parts.begin(), withoutSpaceAround);
    if (parts.size() != 3) {
      fail(setting,
           "expected \"Object.Service.DataType.S\" (or .O), a function or null, a function or null: all on this line");
    }
    const ServiceName name = serviceName(setting, parts[0]);
    auto& services = name.is_subject ? stub_.subjects : stub_.observers;
    if (std::any_of(services.begin(), services.end(),
                    [&](const StubService& other) { return other.name.service == name.service; })) {
      fail(setting, "a second service " + name.service);
    }
    services.push_back({name, functionOrNull(setting, parts[1]), functionOrNull(setting, parts[2])});
  }

  void takeExtra(const Setting& setting) {
    // As the robot's own generator, which reads up to the first space: "Name ()" is an error there.
    const std::string name = function(setting, firstWord(setting.value));
    auto& functions = stub_.extra_functions;
    if (std::find(functions.begin(), functions.end(), name) != functions.end()) {
      fail(setting, "a second Extra : " + name + "()");
    }
    functions.push_back(name);
  }

  ServiceName serviceName(const Setting& setting, const std::string& text) const {
    const bool is_quoted = text.size() > 2 && text.front() == '"' && text.back() == '"';
    const auto name = is_quoted ? ServiceName::parse(text.substr(1, text.size() - 2)) : std::nullopt;
    if (!name) {
      fail(setting, "expected a service name such as \"Object.Service.DataType.S\" (or .O), found " + shown(text));
    }
    return *name;
  }

  std::string functionOrNull(const Setting& setting, const std::string& text) const {
    return text == "null" ? "" : function(setting, text);
  }

  std::string function(const Setting& setting, const std::string& text) const {
    const std::string ending = "()";
    const bool is_call = text.size() > ending.size() && text.substr(text.size() - ending.size()) == ending;
    const std::string name = is_call ? withoutSpaceAround(text.substr(0, text.size() - ending.size())) : "";
    if (!isIdentifier(name)) {
      fail(setting, "expected a function such as Notify(), found " + shown(text));
    }
    return name;
  }

  void check(const std::optional<Count>& count, int last_line, const std::string& keyword, std::size_t services,
             const std::string& ending) const {
    if (!count) {
      throw ConfigurationError(file_, last_line, "the file has no line " + keyword + " : NUMBER");
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

  [[noreturn]] void fail(const Setting& setting, const std::string& what) const {
    throw ConfigurationError(file_, setting.line, what);
  }

  const std::string file_;
  StubConfiguration stub_;
  std::optional<Count> number_of_subjects_;
  std::optional<Count> number_of_observers_;
};

}  // namespace

StubConfiguration StubConfiguration::parse(std::istream& text, const std::string& file) {
  return Parser(file).parse(text);
}

}  // namespace openr_host
