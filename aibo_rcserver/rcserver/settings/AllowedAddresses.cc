#include "rcserver/settings/AllowedAddresses.h"

#include <stdio.h>
#include <string.h>

namespace {

const unsigned LOOPBACK = 0x7f000001;
const unsigned ALL_BITS = 32;

const char NO_ADDRESS[] = "it is not a list of addresses such as 192.168.1.20, 192.168.2.0/24";

const char* SkipSpaces(const char* text) {
  return text + strspn(text, " \t");
}

// Reads digits up to this number, and steps over them.
bool ReadNumber(const char** text, unsigned highest, unsigned* number) {
  const size_t digits = strspn(*text, "0123456789");
  if (digits < 1 || digits > 3) {
    return false;
  }
  *number = 0;
  for (size_t i = 0; i < digits; ++i) {
    *number = *number * 10 + static_cast<unsigned>((*text)[i] - '0');
  }
  *text += digits;
  return *number <= highest;
}

// Reads a.b.c.d and steps over it.
bool ReadAddress(const char** text, unsigned* address) {
  *address = 0;
  for (int i = 0; i < 4; ++i) {
    unsigned part = 0;
    if ((i > 0 && *(*text)++ != '.') || !ReadNumber(text, 255, &part)) {
      return false;
    }
    *address = (*address << 8) | part;
  }
  return true;
}

unsigned MaskOf(unsigned bits) {
  return bits == 0 ? 0 : 0xffffffff << (ALL_BITS - bits);
}

}  // namespace

const int AllowedAddresses::MAX_RANGES;
const size_t AllowedAddresses::ENTRY_TEXT_SIZE;

void AllowedAddresses::AllowOnlyThisComputer() {
  ranges_[0].address = LOOPBACK;
  ranges_[0].bits = ALL_BITS;
  number_of_ranges_ = 1;
}

const char* AllowedAddresses::Read(const char* list) {
  AllowedAddresses read;
  const bool is_any = strcmp(list, "ANY") == 0;
  const char* text = SkipSpaces(list);
  while (!is_any) {
    if (read.number_of_ranges_ == MAX_RANGES) {
      return "it has more than 32 entries";
    }
    if (const char* problem = ReadRange(&text, &read.ranges_[read.number_of_ranges_])) {
      return problem;
    }
    ++read.number_of_ranges_;
    text = SkipSpaces(text);
    if (*text == '\0') {
      break;
    }
    if (*text != ',') {
      return NO_ADDRESS;
    }
    text = SkipSpaces(text + 1);
  }
  *this = read;
  return NULL;
}

bool AllowedAddresses::Allow(unsigned address) const {
  bool is_allowed = IsAny();
  for (int i = 0; i < number_of_ranges_; ++i) {
    is_allowed = is_allowed || (address & MaskOf(ranges_[i].bits)) == ranges_[i].address;
  }
  return is_allowed;
}

void AllowedAddresses::PrintEntry(int entry, char (&text)[ENTRY_TEXT_SIZE]) const {
  const unsigned address = ranges_[entry].address;
  const int size =
      sprintf(text, "%u.%u.%u.%u", address >> 24, (address >> 16) & 0xff, (address >> 8) & 0xff, address & 0xff);
  if (ranges_[entry].bits < ALL_BITS) {
    sprintf(text + size, "/%u", ranges_[entry].bits);
  }
}

// Reads a.b.c.d or a.b.c.d/n and steps over it.
const char* AllowedAddresses::ReadRange(const char** text, Range* range) {
  range->bits = ALL_BITS;
  if (!ReadAddress(text, &range->address)) {
    return NO_ADDRESS;
  }
  if (**text == '/') {
    ++*text;
    if (!ReadNumber(text, ALL_BITS, &range->bits)) {
      return "it needs a number from 0 to 32 after the /";
    }
  }
  range->address &= MaskOf(range->bits);
  return NULL;
}
