#include "rcserver/settings/Settings.h"

#include <OPENR/OSyslog.h>
#include <ctype.h>
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/text.h"

namespace {

// The settings. Those with a value are yes or no; the others are the first ones, at these indices.
enum { ALLOWED_ADDRESSES, SILENT_CLIENT_SECONDS };
const struct {
  const char* name;
  bool Settings::*value;
  bool safe_value;
} SETTINGS[] = {{"ALLOWED_ADDRESSES", 0, false},
                {"SILENT_CLIENT_SECONDS", 0, false},
                {"ALLOW_UPLOAD", &Settings::allow_upload, false},
                {"ALLOW_DELETE", &Settings::allow_delete, false},
                {"ALLOW_PICTURES", &Settings::allow_pictures, false},
                {"ALLOW_SHUT_DOWN", &Settings::allow_shut_down, false},
                {"ALLOW_REBOOT", &Settings::allow_reboot, false},
                {"MOTORS_AT_BOOT", &Settings::motors_at_boot, false},
                {"POWER_MONITOR", &Settings::power_monitor, true}};
const int NUMBER_OF_SETTINGS = static_cast<int>(sizeof(SETTINGS) / sizeof(SETTINGS[0]));

const int MOST_SECONDS = 3600;

const char* SkipSpaces(const char* text) {
  return text + strspn(text, " \t");
}

// Some editors put it in front of a file.
const char BYTE_ORDER_MARK[] = "\xef\xbb\xbf";

// Reads a file line by line: in capitals, without comments, without spaces at either end, whichever system's line ends
// the file has.
class LineReader {
 public:
  explicit LineReader(FILE* file) : file_(file), number_(0), size_(0), is_text_(true) { line_[0] = '\0'; }

  // Goes to the next line, which may be empty. False at the end of the file.
  bool Next();

  // From 1.
  int Number() const { return number_; }

  // False if the line is too long or has anything but ASCII's printable characters and tabs in it, also in its
  // comment; Line() is not valid then.
  bool IsText() const { return is_text_; }

  const char* Line() const { return line_; }

 private:
  LineReader(const LineReader&);
  LineReader& operator=(const LineReader&);

  bool IsPlain(int character, size_t position) const;
  void SkipNewline();
  void Add(int character);
  void Trim();

  FILE* file_;
  int number_;
  size_t size_;
  bool is_text_;
  char line_[MAX_SETTINGS_LINE_SIZE + 1];
};

// Reads lines NAME=VALUE into settings.
class Reader {
 public:
  Reader(Settings* settings, SettingsProblems& problems)
      : settings_(*settings), problems_(problems), line_(0), first_ignored_(0) {
    memset(is_set_, 0, sizeof(is_set_));
  }

  void Read(FILE* file);

 private:
  void ReadLine(const char* line);
  const char* ReadValue(int setting, const char* value);
  const char* ReadSeconds(const char* value);
  const char* MakeSafe(int setting);
  void Ignore(const char* problem, const char* text);
  void DoubtAddresses();

  Settings& settings_;
  SettingsProblems& problems_;
  int line_;
  int first_ignored_;  // line; 0: no line was ignored
  bool is_set_[NUMBER_OF_SETTINGS];
};

bool LineReader::Next() {
  int character = getc(file_);
  if (character == EOF) {
    return false;
  }
  ++number_;
  size_ = 0;
  is_text_ = true;
  bool is_comment = false;
  for (size_t i = 0; character != EOF && character != '\n' && character != '\r'; character = getc(file_), ++i) {
    is_text_ = is_text_ && IsPlain(character, i);
    is_comment = is_comment || character == '#';
    if (!is_comment) {
      Add(character);
    }
  }
  if (character == '\r') {
    SkipNewline();
  }
  Trim();
  return true;
}

// A comment with a line end that is none here may hide a setting: editors show a new line at a form feed, and some at
// NEL and U+2028, which begin with a byte above 0x7f in every encoding but ASCII.
bool LineReader::IsPlain(int character, size_t position) const {
  const bool is_of_mark = number_ == 1 && position < strlen(BYTE_ORDER_MARK) &&
                          character == static_cast<unsigned char>(BYTE_ORDER_MARK[position]);
  return character == '\t' || (character >= ' ' && character <= '~') || is_of_mark;
}

// A carriage return ends a line, and so does a carriage return with a newline after it.
void LineReader::SkipNewline() {
  const int next = getc(file_);
  if (next != '\n') {
    ungetc(next, file_);  // does nothing at the end of the file
  }
}

void LineReader::Add(int character) {
  if (size_ == MAX_SETTINGS_LINE_SIZE) {
    is_text_ = false;
    return;
  }
  line_[size_] = static_cast<char>(toupper(character));
  ++size_;
}

void LineReader::Trim() {
  while (size_ > 0 && isspace(static_cast<unsigned char>(line_[size_ - 1]))) {
    --size_;
  }
  line_[size_] = '\0';
  const size_t mark_size = strlen(BYTE_ORDER_MARK);
  const char* begin = number_ == 1 && strncmp(line_, BYTE_ORDER_MARK, mark_size) == 0 ? line_ + mark_size : line_;
  begin += strspn(begin, " \t");
  memmove(line_, begin, strlen(begin) + 1);
}

void Reader::Read(FILE* file) {
  LineReader reader(file);
  while (reader.Next()) {
    line_ = reader.Number();
    if (!reader.IsText()) {
      Ignore("it has a character that is not ASCII or is a control character, or more than 1023 characters", "");
    } else if (reader.Line()[0] != '\0') {
      ReadLine(reader.Line());
    }
  }
  if (ferror(file)) {
    ++line_;
    Ignore("it cannot be read", "");
  }
  DoubtAddresses();
}

void Reader::ReadLine(const char* line) {
  const size_t name_size = strcspn(line, " \t=");
  const char* value = SkipSpaces(line + name_size);
  if (*value != '=') {
    Ignore("it is not NAME=VALUE", line);
    return;
  }
  value = SkipSpaces(value + 1);
  int setting = 0;
  while (setting < NUMBER_OF_SETTINGS &&
         (strlen(SETTINGS[setting].name) != name_size || strncmp(SETTINGS[setting].name, line, name_size) != 0)) {
    ++setting;
  }
  if (setting == NUMBER_OF_SETTINGS) {
    Ignore("there is no such setting", line);
    return;
  }
  const char* problem = is_set_[setting] ? "appears a second time" : ReadValue(setting, value);
  is_set_[setting] = true;
  if (problem != NULL) {
    char text[256];
    sprintf(text, "%s=%.40s %s; %s", SETTINGS[setting].name, value, problem, MakeSafe(setting));
    problems_.Report(line_, text);
  }
}

// The problem with the value, or NULL.
const char* Reader::ReadValue(int setting, const char* value) {
  if (setting == ALLOWED_ADDRESSES) {
    return settings_.allowed_addresses.Read(value);
  }
  if (setting == SILENT_CLIENT_SECONDS) {
    return ReadSeconds(value);
  }
  const bool is_yes = strcmp(value, "YES") == 0;
  settings_.*SETTINGS[setting].value = is_yes;
  return is_yes || strcmp(value, "NO") == 0 ? NULL : "is neither yes nor no";
}

const char* Reader::ReadSeconds(const char* value) {
  const size_t digits = strspn(value, "0123456789");
  const int seconds = digits <= 4 ? atoi(value) : 0;
  if (value[digits] != '\0' || seconds < 1 || seconds > MOST_SECONDS) {
    return "is not a whole number from 1 to 3600";
  }
  settings_.silent_client_seconds = static_cast<unsigned>(seconds);
  return NULL;
}

// Sets the safe value, and says which it is.
const char* Reader::MakeSafe(int setting) {
  if (setting == ALLOWED_ADDRESSES) {
    settings_.allowed_addresses.AllowOnlyThisComputer();
    return "only 127.0.0.1 may connect";
  }
  if (setting == SILENT_CLIENT_SECONDS) {
    settings_.silent_client_seconds = Settings().silent_client_seconds;
    return "it is set to 10";
  }
  settings_.*SETTINGS[setting].value = SETTINGS[setting].safe_value;
  return SETTINGS[setting].safe_value ? "it is set to yes" : "it is set to no";
}

void Reader::Ignore(const char* problem, const char* text) {
  char message[256];
  sprintf(message, "%s; the line is ignored: \"%.60s\"", problem, text);
  problems_.Report(line_, message);
  first_ignored_ = first_ignored_ == 0 ? line_ : first_ignored_;
}

// A line that was ignored may have been meant to keep others out. In the file as distributed, the setting is "any"; a
// misspelt line beside it must not be lost.
void Reader::DoubtAddresses() {
  if (first_ignored_ > 0 && settings_.allowed_addresses.IsAny()) {
    char text[128];
    sprintf(text, "%s is %s, and this line may have been meant to set it: %s", SETTINGS[ALLOWED_ADDRESSES].name,
            is_set_[ALLOWED_ADDRESSES] ? "any" : "not set", MakeSafe(ALLOWED_ADDRESSES));
    problems_.Report(first_ignored_, text);
  }
}

class OnConsole : public SettingsProblems {
 public:
  virtual void Report(int line, const char* text) {
    OSYSLOG1((osyslogERROR, "RCServer: %s, line %d: %s", SETTINGS_FILE, line, text));
  }
};

// The name of SETTINGS_FILE without its folder.
const char* SettingsFileName() {
  return SETTINGS_FILE + sizeof(SETTINGS_FOLDER);
}

// Whatever the case of the letters. The SDK has no strcasecmp().
bool BeginsWith(const char* text, const char* beginning) {
  while (*beginning != '\0' &&
         tolower(static_cast<unsigned char>(*text)) == tolower(static_cast<unsigned char>(*beginning))) {
    ++text;
    ++beginning;
  }
  return *beginning == '\0';
}

bool IsSettingsFile(const char* name) {
  return strlen(name) == strlen(SettingsFileName()) && BeginsWith(name, SettingsFileName());
}

// A file that its owner may have meant to be RCSERVER.CFG, such as RCSERVER.CFG.txt, which some editors write. Where
// names have at most eight characters, RCSERV~1.TXT stands for it.
bool IsLookAlike(const char* name) {
  return (BeginsWith(name, "RCSERVER") || BeginsWith(name, "RCSERV~")) && !IsSettingsFile(name);
}

// Copies the first name in the settings' folder that is of this kind. False if there is none.
bool FindInFolder(const HostSettings& host, bool (*is_wanted)(const char* name), char (&found)[64]) {
  char path[MAX_PATH_SIZE];
  DIR* const folder = pathOnMemoryStick(host, SETTINGS_FOLDER, path) ? opendir(path) : NULL;
  if (folder == NULL) {
    return false;
  }
  const dirent* entry = readdir(folder);
  while (entry != NULL && !is_wanted(entry->d_name)) {
    entry = readdir(folder);
  }
  if (entry != NULL) {
    sprintf(found, "%.63s", entry->d_name);
  }
  closedir(folder);
  return entry != NULL;
}

// Each address in a print of its own: OSYSPRINT() cuts off what is longer than 242 characters.
void ReportWhoMayConnect(const AllowedAddresses& addresses) {
  if (addresses.IsAny()) {
    OSYSPRINT(("RCServer: any address may connect\n"));
  }
  for (int i = 0; i < addresses.NumberOfEntries(); ++i) {
    char entry[AllowedAddresses::ENTRY_TEXT_SIZE];
    addresses.PrintEntry(i, entry);
    OSYSPRINT(("RCServer: %s %s may connect\n", i == 0 ? "only" : "and", entry));
  }
}

}  // namespace

void readSettings(FILE* file, Settings* settings, SettingsProblems& problems) {
  Reader(settings, problems).Read(file);
}

Settings readSettingsFile(const HostSettings& host) {
  Settings settings;
  char path[MAX_PATH_SIZE];
  char name[64];
  FILE* file = pathOnMemoryStick(host, SETTINGS_FILE, path) ? fopen(path, "rb") : NULL;
  if (file != NULL) {
    OnConsole problems;
    readSettings(file, &settings, problems);
    fclose(file);
  } else if (FindInFolder(host, IsSettingsFile, name)) {  // fopen() cannot tell whether the file exists
    settings.allowed_addresses.AllowOnlyThisComputer();
    OSYSLOG1((osyslogERROR, "RCServer: %s cannot be read; only 127.0.0.1 may connect", SETTINGS_FILE));
  } else {
    OSYSPRINT(
        ("RCServer: no %s on the memory stick: upload, delete, pictures on it, shutting down and rebooting are not "
         "allowed\n",
         SETTINGS_FILE));
  }
  if (FindInFolder(host, IsLookAlike, name)) {
    settings.allowed_addresses.AllowOnlyThisComputer();
    OSYSLOG1((osyslogERROR, "RCServer: %s has another file, %s, which is not read; rename it to %s or remove it",
              SETTINGS_FOLDER, protocol::isPlainText(name, strlen(name)) ? name : "RCSERVER...", SettingsFileName()));
  }
  ReportWhoMayConnect(settings.allowed_addresses);
  return settings;
}
