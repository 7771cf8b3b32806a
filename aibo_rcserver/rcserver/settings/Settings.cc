#include "rcserver/settings/Settings.h"

#include <OPENR/OSyslog.h>
#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>

#include "protocol/text.h"

namespace {

// The settings. The first ones, at these indices, have parsers of their own; all others are yes or no.
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

// True if this byte of a comment belongs to a well-formed character of UTF-8 that begins before it.
bool ContinuesCharacter(const char* byte, const char* end) {
  const ptrdiff_t longest = 4;
  const char* first = byte;
  do {
    --first;  // no further back than the comment's #
  } while ((*first & 0xc0) == 0x80 && byte - first < longest - 1);
  bool is_well_formed = false;
  for (ptrdiff_t size = byte - first + 1; size <= std::min(longest, end - first); ++size) {
    is_well_formed = is_well_formed || protocol::isPlainText(first, static_cast<size_t>(size));
  }
  return is_well_formed;
}

// The size of a character at which some editors show a new line, although it ends no line here; 0 if there is none.
// These characters are those of ASCII, NUL, NEL in Latin-1 and in UTF-8, and U+2028 and U+2029.
size_t SizeOfUnclearLineEnd(const char* text, const char* end) {
  if (memchr("\v\f\x1a\x1c\x1d\x1e", *text, 7) != NULL) {  // the final NUL is one of the characters
    return 1;
  }
  if (*text == '\x85') {
    return ContinuesCharacter(text, end) ? 0 : 1;
  }
  if (end - text >= 2 && memcmp(text, "\xc2\x85", 2) == 0) {
    return 2;
  }
  return end - text >= 3 && (memcmp(text, "\xe2\x80\xa8", 3) == 0 || memcmp(text, "\xe2\x80\xa9", 3) == 0) ? 3 : 0;
}

bool IsLetter(char character) {
  return character == '_' || (character >= 'A' && character <= 'Z') || (character >= 'a' && character <= 'z');
}

// True if the text begins with NAME=, whatever the name.
bool BeginsLikeSetting(const char* text, const char* end) {
  while (text < end && (*text == ' ' || *text == '\t')) {
    ++text;
  }
  const char* const name = text;
  while (text < end && IsLetter(*text)) {
    ++text;
  }
  const bool has_name = text > name;
  while (text < end && (*text == ' ' || *text == '\t')) {
    ++text;
  }
  return has_name && text < end && *text == '=';
}

// True if an editor may show a setting in the comment as a line of its own, which may be meant to keep others out.
bool HidesSetting(const char* comment, const char* end) {
  for (const char* text = comment; text < end; ++text) {
    const size_t size = SizeOfUnclearLineEnd(text, end);
    if (size > 0 && BeginsLikeSetting(text + size, end)) {
      return true;
    }
  }
  return false;
}

// Reads lines NAME=VALUE into settings.
class Reader {
 public:
  explicit Reader(Settings* settings) : settings_(*settings) { memset(is_set_, 0, sizeof(is_set_)); }

  // Applies a line. Returns its problem, or NULL.
  const char* Read(const char* begin, const char* end);

  // The line in capitals, without its comment, and with a '?' for each byte that the console should not get.
  const char* Line() const { return line_; }

 private:
  bool TakeLine(const char* begin, const char* end);
  const char* Set();
  const char* ReadValue(int setting, const char* value);
  const char* ReadSeconds(const char* value);

  Settings& settings_;
  char line_[MAX_SETTINGS_LINE_SIZE + 1];
  bool is_set_[NUMBER_OF_SETTINGS];
};

const char* Reader::Read(const char* begin, const char* end) {
  const char* const comment = std::find(begin, end, '#');
  if (!TakeLine(begin, comment)) {
    return "it has a character that is not ASCII outside of a comment, or more than 1023 characters";
  }
  if (HidesSetting(comment, end)) {
    return "some editors show a setting in its comment on a line of its own";
  }
  return Set();
}

// Takes the line. Returns false if it has characters that no setting has, or too many.
bool Reader::TakeLine(const char* begin, const char* end) {
  while (end > begin && (end[-1] == ' ' || end[-1] == '\t')) {
    --end;
  }
  bool is_plain = end - begin <= static_cast<ptrdiff_t>(MAX_SETTINGS_LINE_SIZE);
  char* out = line_;
  for (; begin < end && out < line_ + MAX_SETTINGS_LINE_SIZE; ++begin) {
    const bool is_known = *begin == '\t' || (*begin >= ' ' && *begin <= '~');
    is_plain = is_plain && is_known;
    *out++ = static_cast<char>(is_known ? toupper(*begin) : '?');
  }
  *out = '\0';
  return is_plain;
}

const char* Reader::Set() {
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

// Sets what holds if the file has a fault, because the faulty line may have been meant to keep others out.
void MakeSafe(Settings* settings, const char* fault) {
  *settings = Settings();
  sprintf(settings->fault, "%.*s", static_cast<int>(MAX_SETTINGS_FAULT_SIZE), fault);
  settings->motors_at_boot = false;
  settings->allow_sound = false;
  settings->allowed_addresses.AllowOnlyThisComputer();
}

// The line ends of all systems count.
const char* EndOfLine(const char* text, const char* end) {
  while (text < end && *text != '\r' && *text != '\n') {
    ++text;
  }
  return text;
}

const char* NextLine(const char* line_end, const char* end) {
  const bool has_two = end - line_end >= 2 && line_end[0] == '\r' && line_end[1] == '\n';
  return line_end == end ? end : line_end + (has_two ? 2 : 1);
}

// Reads an open file; false if it cannot be read.
bool ReadFile(FILE* file, Settings* settings) {
  char* const bytes = static_cast<char*>(malloc(MAX_SETTINGS_FILE_SIZE + 1));
  const size_t size = bytes != NULL ? fread(bytes, 1, MAX_SETTINGS_FILE_SIZE + 1, file) : 0;
  const bool is_whole = bytes != NULL && size <= MAX_SETTINGS_FILE_SIZE && !ferror(file);
  if (is_whole) {
    readSettings(bytes, size, settings);
  }
  free(bytes);
  return is_whole;
}

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

// Looks into the settings folder for RCSERVER.CFG, and for another file that its owner may have meant to be it, such as
// RCSERVER.CFG.txt, which some editors write. Where names have at most eight characters, RCSERV~1.TXT stands for it.
// @param[out] other the other file's name; empty if there is none
// @return true if RCSERVER.CFG is there
bool LookIntoFolder(const HostSettings& host, char (&other)[64]) {
  char path[MAX_PATH_SIZE];
  DIR* const folder = pathOnMemoryStick(host, SETTINGS_FOLDER, path) ? opendir(path) : NULL;
  other[0] = '\0';
  if (folder == NULL) {
    return false;
  }
  bool is_there = false;
  while (const dirent* entry = readdir(folder)) {
    const char* const name = entry->d_name;
    if (strlen(name) == strlen(SettingsFileName()) && BeginsWith(name, SettingsFileName())) {
      is_there = true;
    } else if (BeginsWith(name, "RCSERVER") || BeginsWith(name, "RCSERV~")) {
      sprintf(other, "%.63s", name);
    }
  }
  closedir(folder);
  return is_there;
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

void readSettings(const char* bytes, size_t size, Settings* settings) {
  const protocol::Text text = protocol::textInFile(bytes, size);
  const char* const end = text.begin + text.size;
  Reader reader(settings);
  char first_fault[MAX_SETTINGS_FAULT_SIZE + 1] = "";
  int number = 0;
  for (const char* line = text.begin; line < end;) {
    ++number;
    const char* const line_end = EndOfLine(line, end);
    if (const char* problem = reader.Read(line, line_end)) {
      OSYSLOG1((osyslogERROR, "RCServer: %s, line %d: %s, so nothing is allowed: \"%.60s\"", SETTINGS_FILE, number,
                problem, reader.Line()));
      if (first_fault[0] == '\0') {
        sprintf(first_fault, "line %d: %.100s", number, problem);
      }
    }
    line = NextLine(line_end, end);
  }
  if (first_fault[0] != '\0') {
    MakeSafe(settings, first_fault);
  }
}

Settings readSettingsFile(const HostSettings& host) {
  Settings settings;
  char path[MAX_PATH_SIZE];
  char other[64];
  const bool is_there = LookIntoFolder(host, other);
  FILE* file = pathOnMemoryStick(host, SETTINGS_FILE, path) ? host.open_to_read(path) : NULL;
  const bool is_read = file != NULL && ReadFile(file, &settings);
  if (file != NULL) {
    fclose(file);
  }
  if (!is_read && (file != NULL || is_there)) {
    MakeSafe(&settings, "it cannot be read, or has more than 64 KB");
    OSYSLOG1(
        (osyslogERROR, "RCServer: %s cannot be read, or has more than 64 KB, so nothing is allowed", SETTINGS_FILE));
  } else if (file == NULL) {
    OSYSPRINT(
        ("RCServer: no %s on the memory stick: uploading, deleting, storing pictures, listening, shutting down and "
         "rebooting are not allowed\n",
         SETTINGS_FILE));
  }
  if (other[0] != '\0') {
    MakeSafe(&settings, "there is another file beside it whose name begins with RCSERV");
    OSYSLOG1((osyslogERROR, "RCServer: %s has another file, %s, which is not read; rename it to %s or remove it",
              SETTINGS_FOLDER, protocol::isPlainText(other, strlen(other)) ? other : "RCSERVER...",
              SettingsFileName()));
  }
  ReportWhoMayConnect(settings.allowed_addresses);
  return settings;
}
