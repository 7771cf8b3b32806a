#include "simulator/openr_host/configuration/connection_configuration.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "simulator/openr_host/configuration/configuration_error.h"
#include "simulator/openr_host/configuration/model_lines.h"

namespace openr_host {
namespace {

struct Word {
  std::string text;
  int line;
};

std::vector<Word> readWords(std::istream& text, const std::string& design) {
  std::vector<Word> words;
  for (const auto& line : readModelLines(text, design)) {
    std::istringstream content(line.is_for_design ? line.text : "");
    for (std::string word; content >> word;) {
      words.push_back({word, line.number});
    }
  }
  return words;
}

ServiceName parseService(const Word& word, const std::string& file, const std::vector<std::string>& services) {
  const auto name = ServiceName::parse(word.text);
  if (!name) {
    throw ConfigurationError(file, word.line,
                             "expected a service such as Object.Service.DataType.S (or .O), found '" + word.text + "'");
  }
  if (std::find(services.begin(), services.end(), word.text) == services.end()) {
    std::string known;
    for (const auto& service : services) {
      known += "\n  " + service;
    }
    throw ConfigurationError(file, word.line, "no object has the service " + word.text + "; there are" + known);
  }
  return *name;
}

}  // namespace

std::vector<ServiceConnection> readConnectionConfiguration(std::istream& text, const std::string& file,
                                                           const std::string& design,
                                                           const std::vector<std::string>& services) {
  std::vector<ServiceConnection> connections;
  std::optional<ServiceConnection> open;  // its subject has been read
  for (const auto& word : readWords(text, design)) {
    const ServiceName name = parseService(word, file, services);
    if (open.has_value() == name.is_subject) {
      throw ConfigurationError(file, open ? open->line : word.line,
                               open ? open->subject.text() + " has no observer (a service that ends in .O) behind it"
                                    : name.text() + " has no subject (a service that ends in .S) before it");
    }
    if (!open) {
      open = ServiceConnection{name, {}, word.line};
      continue;
    }
    open->observer = name;
    if (open->subject.data_type != name.data_type) {
      throw ConfigurationError(file, word.line,
                               "the data types differ: " + open->subject.text() + " and " + name.text());
    }
    if (std::any_of(connections.begin(), connections.end(), [&](const ServiceConnection& other) {
          return other.subject.text() == open->subject.text() && other.observer.text() == name.text();
        })) {
      throw ConfigurationError(file, open->line,
                               open->subject.text() + " and " + name.text() + " are connected a second time");
    }
    connections.push_back(*open);
    open.reset();
  }
  if (open) {
    throw ConfigurationError(file, open->line,
                             open->subject.text() + " has no observer (a service that ends in .O) behind it");
  }
  return connections;
}

}  // namespace openr_host
