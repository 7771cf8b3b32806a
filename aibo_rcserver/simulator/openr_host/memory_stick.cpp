#include "simulator/openr_host/memory_stick.h"

#include <strings.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>

#include "host_files/regular_file.h"
#include "protocol/text.h"

namespace openr_host {
namespace {

bool isWord(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

/// Removes white space, and also the carriage return at the end of a line that was written on Windows.
std::string withoutSpaceAround(const std::string& text) {
  constexpr char kSpace[] = " \t\r";
  const auto begin = text.find_first_not_of(kSpace);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

/// Splits a text. There is one more part than separators.
std::vector<std::string> splitAt(char separator, const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream rest(text + separator);
  for (std::string part; std::getline(rest, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

/// A line without its comment and the space around it; never empty.
struct Line {
  std::string text;
  int number;
  bool is_for_design;
};

/// The model in "[MODEL]".
std::optional<std::string> parseModel(const std::string& content) {
  if (content.size() < 2 || content.front() != '[' || content.find(']') != content.size() - 1) {
    return std::nullopt;
  }
  return withoutSpaceAround(content.substr(1, content.size() - 2));
}

/// All lines for this design, without those that name models.
std::vector<Line> readLines(std::istream& text, const std::string& design) {
  std::vector<Line> lines;
  bool is_for_design = true;
  int number = 0;
  for (std::string raw; std::getline(text, raw);) {
    ++number;
    const std::string content = withoutSpaceAround(raw.substr(0, raw.find('#')));
    if (const auto model = parseModel(content)) {
      is_for_design = *model == design;
    } else if (!content.empty()) {
      lines.push_back({content, number, is_for_design});
    }
  }
  return lines;
}

/// The file's name in capitals. On the stick, names have at most eight characters before the dot.
std::optional<std::string> parseObject(std::string path) {
  const std::string folder = "/MS/OPEN-R/MW/OBJS/";
  const std::string ending = ".BIN";
  std::transform(path.begin(), path.end(), path.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (path.size() < folder.size() + 1 + ending.size() || path.size() > folder.size() + 8 + ending.size() ||
      path.compare(0, folder.size(), folder) != 0 ||
      path.compare(path.size() - ending.size(), ending.size(), ending) != 0) {
    return std::nullopt;
  }
  const std::string name = path.substr(folder.size());
  const bool is_allowed = std::all_of(name.begin(), name.end() - 4, [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string("_~$-").find(static_cast<char>(c)) != std::string::npos;
  });
  return is_allowed ? std::make_optional(name) : std::nullopt;
}

struct Word {
  std::string text;
  int line;
};

std::vector<Word> readWords(std::istream& text, const std::string& design) {
  std::vector<Word> words;
  for (const auto& line : readLines(text, design)) {
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
    throw ConfigurationError(file, word.line, "no object has the service " + word.text + "; the services are" + known);
  }
  return *name;
}

/// Compares a connection with earlier ones.
void check(const ServiceConnection& added, const std::vector<ServiceConnection>& connections, const std::string& file,
           int observer_line) {
  const std::string subject = added.subject.text();
  const std::string observer = added.observer.text();
  if (added.subject.data_type != added.observer.data_type) {
    throw ConfigurationError(file, observer_line, "the data types differ: " + subject + " and " + observer);
  }
  if (std::any_of(connections.begin(), connections.end(), [&](const ServiceConnection& other) {
        return other.subject.text() == subject && other.observer.text() == observer;
      })) {
    throw ConfigurationError(file, added.line, subject + " and " + observer + " are connected a second time");
  }
}

}  // namespace

std::optional<ServiceName> ServiceName::parse(const std::string& text) {
  const auto parts = splitAt('.', text);
  if (parts.size() != 4 || !std::all_of(parts.begin(), parts.end(), isWord) || (parts[3] != "S" && parts[3] != "O")) {
    return std::nullopt;
  }
  return ServiceName{parts[0], parts[1], parts[2], parts[3] == "S"};
}

std::string ServiceName::text() const {
  return object + "." + service + "." + data_type + (is_subject ? ".S" : ".O");
}

std::filesystem::path findOnMemoryStick(const std::filesystem::path& folder, const std::string& name) {
  std::filesystem::path found = folder;
  for (const auto& part : std::filesystem::path(name)) {
    std::error_code error;
    const std::filesystem::directory_iterator entries(found, error);
    if (error) {
      throw std::runtime_error("memory stick: the folder " + found.string() + " cannot be read: " + error.message());
    }
    const auto entry =
        std::find_if(begin(entries), end(entries), [&](const std::filesystem::directory_entry& candidate) {
          return strcasecmp(candidate.path().filename().c_str(), part.c_str()) == 0;
        });
    if (entry == end(entries)) {
      throw std::runtime_error("memory stick: " + folder.string() + " has no " + name + " (there is no " +
                               part.string() + " in " + found.string() + ")");
    }
    found = entry->path();
  }
  return found;
}

bool isOnMemoryStick(const std::filesystem::path& folder, const std::string& name) {
  try {
    findOnMemoryStick(folder, name);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

std::istringstream openConfiguration(const std::string& path) {
  constexpr std::size_t kLongest = 1'000'000;  // bytes
  try {
    const std::vector<unsigned char> bytes = host_files::readRegularFile(path, kLongest);
    const protocol::Text text = protocol::textInFile(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return std::istringstream(std::string(text.begin, text.size));
  } catch (const host_files::Unreadable& why) {
    throw std::runtime_error(path + ": cannot be read: " + why.what());
  }
}

std::vector<ObjectFile> readObjectConfiguration(std::istream& text, const std::string& file,
                                                const std::string& design) {
  std::vector<ObjectFile> objects;
  for (const auto& line : readLines(text, design)) {
    const auto name = parseObject(line.text);
    if (!name) {
      throw ConfigurationError(file, line.number,
                               "expected an object such as /MS/OPEN-R/MW/OBJS/RCSERVER.BIN (a name of at most 8 "
                               "characters and .BIN), or a model such as [ERS-7], found '" +
                                   line.text + "'");
    }
    if (!line.is_for_design) {
      continue;
    }
    if (std::any_of(objects.begin(), objects.end(), [&](const ObjectFile& other) { return other.name == *name; })) {
      throw ConfigurationError(file, line.number, *name + " is listed a second time");
    }
    objects.push_back({*name, line.number});
  }
  return objects;
}

std::vector<ServiceConnection> readConnectionConfiguration(std::istream& text, const std::string& file,
                                                           const std::string& design,
                                                           const std::vector<std::string>& services) {
  std::vector<ServiceConnection> connections;
  std::optional<ServiceConnection> open;  // set if its subject has been read
  const auto fail_without_observer = [&] {
    throw ConfigurationError(file, open->line,
                             open->subject.text() + " has no observer (a service that ends in .O) after it");
  };
  for (const auto& word : readWords(text, design)) {
    const ServiceName name = parseService(word, file, services);
    if (open && name.is_subject) {
      fail_without_observer();
    }
    if (!open && !name.is_subject) {
      throw ConfigurationError(file, word.line, name.text() + " has no subject (a service that ends in .S) before it");
    }
    if (!open) {
      open = ServiceConnection{name, {}, word.line};
      continue;
    }
    open->observer = name;
    check(*open, connections, file, word.line);
    connections.push_back(*open);
    open.reset();
  }
  if (open) {
    fail_without_observer();
  }
  return connections;
}

std::map<std::string, std::string> readDesignDatabase(std::istream& text, const std::string& file,
                                                      const std::string& design) {
  const std::string stick = "/MS/";
  std::map<std::string, std::string> files;
  for (const auto& line : readLines(text, design)) {
    std::istringstream words(line.text);
    std::string keyword;
    std::string path;
    std::string more;
    words >> keyword >> path >> more;
    if (path.size() <= stick.size() || strncasecmp(path.c_str(), stick.c_str(), stick.size()) != 0 || !more.empty()) {
      throw ConfigurationError(file, line.number,
                               "expected a keyword and a file such as /MS/OPEN-R/MW/DATA/P/SOUND.WAV, or a model such "
                               "as [ERS-7], found '" +
                                   line.text + "'");
    }
    if (line.is_for_design && !files.emplace(keyword, path.substr(stick.size())).second) {
      throw ConfigurationError(file, line.number, "a second " + keyword);
    }
  }
  return files;
}

}  // namespace openr_host
