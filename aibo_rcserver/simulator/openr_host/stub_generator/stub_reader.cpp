#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "simulator/openr_host/stub_generator/stub.h"

namespace openr_host {
namespace {

bool isIdentifier(const std::string& text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

bool isNumber(const std::string& text) {
  return !text.empty() && text.size() < 6 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string firstWord(const std::string& text) {
  return text.substr(0, text.find_first_of(" \t\r"));
}

std::string shown(const std::string& text) {
  return text.empty() ? "nothing" : "'" + text + "'";
}

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  StubConfiguration read(std::istream& text) {
    for (std::string line; std::getline(text, line);) {
      ++line_;
      const auto colon = line.find(':');
      if (colon != std::string::npos) {
        readSetting(withoutSpaceAround(line.substr(0, colon)), withoutSpaceAround(line.substr(colon + 1)));
      }
    }
    if (stub_.object_name.empty()) {
      fail("the file has no line ObjectName : NAME");
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

  /// Other keywords begin comments.
  void readSetting(const std::string& keyword, const std::string& value) {
    if (keyword == "ObjectName") {
      readObjectName(firstWord(value));
    } else if (keyword == "NumOfOSubject" || keyword == "NumOfSubject") {
      readCount(keyword, firstWord(value), number_of_subjects_);
    } else if (keyword == "NumOfOObserver" || keyword == "NumOfObserver") {
      readCount(keyword, firstWord(value), number_of_observers_);
    } else if (keyword == "Service") {
      readService(splitAt(',', value));
    } else if (keyword == "Extra") {
      // The robot's own generator stops at the first space, too. "Name ()" is an error there.
      readExtra(firstWord(value));
    }
  }

  void readObjectName(const std::string& name) {
    if (!stub_.object_name.empty()) {
      fail("a second ObjectName");
    }
    if (!isIdentifier(name)) {
      fail("expected the name of the object's class, found " + shown(name));
    }
    stub_.object_name = name;
  }

  void readCount(const std::string& keyword, const std::string& number, std::optional<Count>& count) const {
    if (count) {
      fail("a second " + keyword);
    }
    if (!isNumber(number)) {
      fail("expected a number, found " + shown(number));
    }
    count = Count{std::stoul(number), line_};
  }

  void readService(const std::vector<std::string>& parts) {
    if (parts.size() != 3) {
      fail("expected \"Object.Service.DataType.S\" (or .O), a function or null, a function or null: all on this line");
    }
    const ServiceName name = serviceName(withoutSpaceAround(parts[0]));
    auto& services = name.is_subject ? stub_.subjects : stub_.observers;
    if (std::any_of(services.begin(), services.end(),
                    [&](const StubService& other) { return other.name.service == name.service; })) {
      fail("a second service " + name.service);
    }
    services.push_back(
        {name, functionOrNull(withoutSpaceAround(parts[1])), functionOrNull(withoutSpaceAround(parts[2]))});
  }

  void readExtra(const std::string& call) {
    const std::string name = function(call);
    auto& functions = stub_.extra_functions;
    if (std::find(functions.begin(), functions.end(), name) != functions.end()) {
      fail("a second Extra : " + name + "()");
    }
    functions.push_back(name);
  }

  ServiceName serviceName(const std::string& text) const {
    const bool is_quoted = text.size() > 2 && text.front() == '"' && text.back() == '"';
    const auto name = is_quoted ? ServiceName::parse(text.substr(1, text.size() - 2)) : std::nullopt;
    if (!name) {
      fail("expected a service name such as \"Object.Service.DataType.S\" (or .O), found " + shown(text));
    }
    return *name;
  }

  std::string functionOrNull(const std::string& text) const { return text == "null" ? "" : function(text); }

  std::string function(const std::string& text) const {
    const bool is_call = text.size() > 2 && text.substr(text.size() - 2) == "()";
    const std::string name = is_call ? withoutSpaceAround(text.substr(0, text.size() - 2)) : "";
    if (!isIdentifier(name)) {
      fail("expected a function such as Notify(), found " + shown(text));
    }
    return name;
  }

  void check(const std::optional<Count>& count, const std::string& keyword, std::size_t services,
             const std::string& ending) {
    if (!count) {
      fail("the file has no line " + keyword + " : NUMBER");
    }
    line_ = count->line;
    if (count->value == 0) {
      fail(keyword + " must be at least 1 on the robot. An object that needs none declares a dummy: Service : \"" +
           stub_.object_name + ".Dummy.DoNotConnect" + ending + "\", null, null");
    }
    if (count->value != services) {
      fail(keyword + " is " + std::to_string(count->value) + ", but there are " + std::to_string(services) +
           " services that end in " + ending);
    }
  }

  [[noreturn]] void fail(const std::string& what) const { throw ConfigurationError(file_, line_, what); }

  const std::string file_;
  int line_ = 0;  ///< for errors
  StubConfiguration stub_;
  std::optional<Count> number_of_subjects_;
  std::optional<Count> number_of_observers_;
};

}  // namespace

StubConfiguration readStub(std::istream& text, const std::string& file) {
  return Reader(file).read(text);
}

}  // namespace openr_host
