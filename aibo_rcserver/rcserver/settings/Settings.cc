#include "rcserver/settings/Settings.h"

#include <OPENR/OSyslog.h>
#include <ctype.h>
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/text.h"

namespace {

// The settings. The first ones, at these indices, have their own parsers; all others are yes or no.
enum { ALLOWED_ADDRESSES, SILENT_CLIENT_SECONDS };
const struct {
  const char* name;
  bool Settings::*value;
} SETTINGS[] = {{"ALLOWED_ADDRESSES", 0},
                {"SILENT_CLIENT_SECONDS", 0},
                {"ALLOW_UPLOAD", &Settings::allow_upload},
                {"ALLOW_DELETE", &Settings::allow_delete},
                {"ALLOW_PICTURES", &Settings::allow_pictures},
                {"ALLOW_MICROPHONE", &Settings::allow_microphone},
                {"ALLOW_SOUND", &Settings::allow_sound},
                {"ALLOW_SHUT_DOWN", &Settings::allow_shut_down},
                {"ALLOW_REBOOT", &Settings::allow_reboot},
                {"MOTORS_AT_BOOT", &Settings::motors_at_boot},
                {"POWER_MONITOR", &Settings::power_monitor}};
const int NUMBER_OF_SETTINGS = static_cast<int>(sizeof(SETTINGS) / sizeof(SETTINGS[0]));

const int MOST_SECONDS = 3600;

const char* SkipSpaces(const char* text) {
  return text + strspn(text, " \t");
}

// Some editors put a byte order mark in front of a file.
void SkipByteOrderMark(FILE* file) {
  char begin[3];
  if (fread(begin, 1, sizeof(begin), file) != sizeof(begin) || memcmp(begin, "\xef\xbb\xbf", sizeof(begin)) != 0) {
    rewind(file);
  }
}

// Reads lines NAME=VALUE into settings. Accepts the line ends of all systems.
class Reader {
 public:
  explicit Reader(Settings* settings) : settings_(*settings), number_(0), last_(0), is_text_(true) {
    memset(is_set_, 0, sizeof(is_set_));
  }

  // Reads the next line. False at the end of the file.
  bool Next(FILE* file);

  // The line's number, from 1.
  int Number() const { return number_; }

  // The line in capitals, without its comment.
  const char* Line() const { return line_; }

  // Applies the line's setting. Returns the problem, or NULL.
  const char* Set();

 private:
  const char* ReadValue(int setting, const char* value);
  const char* ReadSeconds(const char* value);

  Settings& settings_;
  int number_;
  int last_;      // character
  bool is_text_;  // the line, also its comment
  char line_[MAX_SETTINGS_LINE_SIZE + 1];
  bool is_set_[NUMBER_OF_SETTINGS];
};

bool Reader::Next(FILE* file) {
  int character = getc(file);
  if (character == '\n' && last_ == '\r') {
    character = getc(file);
  }
  if (character == EOF) {
    return false;
  }
  ++number_;
  is_text_ = true;
  size_t size = 0;
  bool is_comment = false;
  for (; character != EOF && character != '\n' && character != '\r'; character = getc(file)) {
    is_comment = is_comment || character == '#';
    is_text_ = is_text_ && (character == '\t' || (character >= ' ' && character <= '~')) &&
               (is_comment || size < MAX_SETTINGS_LINE_SIZE);
    if (!is_comment && size < MAX_SETTINGS_LINE_SIZE) {
      line_[size] = static_cast<char>(toupper(character));
      ++size;
    }
  }
  last_ = character;
  while (size > 0 && isspace(static_cast<unsigned char>(line_[size - 1]))) {
    --size;
  }
  line_[size] = '\0';
  return true;
}

const char* Reader::Set() {
  if (!is_text_) {
    // Some editors show a new line at a form feed, NEL or U+2028, which is not a line end here. So a setting could be
    // hidden in a comment. NEL and U+2028 begin with a byte above 0x7f in every encoding.
    return "it has a character that is not ASCII or is a control character, or more than 1023 characters";
  }
  const char* const name = SkipSpaces(line_);
  const size_t name_size = strcspn(name, " \t=");
  const char* const value = SkipSpaces(name + name_size);
  if (*name == '\0') {
    return NULL;
  }
  if (*value != '=') {
    return "it is not NAME=VALUE";
  }
  int setting = 0;
  while (setting < NUMBER_OF_SETTINGS &&
         (strlen(SETTINGS[setting].name) != name_size || strncmp(SETTINGS[setting].name, name, name_size) != 0)) {
    ++setting;
  }
  if (setting == NUMBER_OF_SETTINGS) {
    return "there is no such setting";
  }
  if (is_set_[setting]) {
    return "it appears a second time";
  }
  is_set_[setting] = true;
  return ReadValue(setting, SkipSpaces(value + 1));
}

const char* Reader::ReadValue(int setting, const char* value) {
  if (setting == ALLOWED_ADDRESSES) {
    return settings_.allowed_addresses.Read(value);
  }
  if (setting == SILENT_CLIENT_SECONDS) {
    return ReadSeconds(value);
  }
  const bool is_yes = strcmp(value, "YES") == 0;
  settings_.*SETTINGS[setting].value = is_yes;
  return is_yes || strcmp(value, "NO") == 0 ? NULL : "it is neither yes nor no";
}

const char* Reader::ReadSeconds(const char* value) {
  const size_t digits = strspn(value, "0123456789");
  const int seconds = digits <= 4 ? atoi(value) : 0;
  if (value[digits] != '\0' || seconds < 1 || seconds > MOST_SECONDS) {
    return "it is not a whole number from 1 to 3600";
  }
  settings_.silent_client_seconds = static_cast<unsigned>(seconds);
  return NULL;
}

// The settings when the file has a wrong line, which may have been meant to keep others out.
void MakeSafe(Settings* settings) {
  *settings = Settings();
  settings->motors_at_boot = false;
  settings->allow_sound = false;
  settings->allowed_addresses.AllowOnlyThisComputer();
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

// Ignores the case of the letters. The SDK has no strcasecmp().
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

// Copies the first matching name in the settings folder. False if there is none.
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

// Prints each address separately, because OSYSPRINT() truncates at 242 characters.
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

bool Settings::Allows(const char* setting) const {
  for (int i = 0; setting != NULL && i < NUMBER_OF_SETTINGS; ++i) {
    if (strcmp(SETTINGS[i].name, setting) == 0) {
      return this->*SETTINGS[i].value;
    }
  }
  return setting == NULL;
}

void readSettings(FILE* file, Settings* settings, SettingsProblems& problems) {
  Reader reader(settings);
  bool is_safe = true;
  SkipByteOrderMark(file);
  while (reader.Next(file)) {
    if (const char* problem = reader.Set()) {
      char text[256];
      sprintf(text, "%s, so nothing is allowed: \"%.60s\"", problem, reader.Line());
      problems.Report(reader.Number(), text);
      is_safe = false;
    }
  }
  if (ferror(file)) {
    problems.Report(reader.Number() + 1, "it cannot be read, so nothing is allowed");
    is_safe = false;
  }
  if (!is_safe) {
    MakeSafe(settings);
  }
}

Settings readSettingsFile(const HostSettings& host) {
  Settings settings;
  char path[MAX_PATH_SIZE];
  char name[64];
  FILE* file = pathOnMemoryStick(host, SETTINGS_FILE, path) ? host.open_to_read(path) : NULL;
  if (file != NULL) {
    OnConsole problems;
    readSettings(file, &settings, problems);
    fclose(file);
  } else if (FindInFolder(host, IsSettingsFile, name)) {  // opening it cannot tell whether the file exists
    MakeSafe(&settings);
    OSYSLOG1((osyslogERROR, "RCServer: %s cannot be read; only 127.0.0.1 may connect", SETTINGS_FILE));
  } else {
    OSYSPRINT(
        ("RCServer: no %s on the memory stick: upload, delete, pictures on it, listening, shutting down and "
         "rebooting are not allowed\n",
         SETTINGS_FILE));
  }
  if (FindInFolder(host, IsLookAlike, name)) {
    MakeSafe(&settings);
    OSYSLOG1((osyslogERROR, "RCServer: %s has another file, %s, which is not read; rename it to %s or remove it",
              SETTINGS_FOLDER, protocol::isPlainText(name, strlen(name)) ? name : "RCSERVER...", SettingsFileName()));
  }
  ReportWhoMayConnect(settings.allowed_addresses);
  return settings;
}
