#ifndef AIBO_RCSERVER_RCSERVER_SETTINGS_ALLOWED_ADDRESSES_H
#define AIBO_RCSERVER_RCSERVER_SETTINGS_ALLOWED_ADDRESSES_H

#include <stddef.h>

/// A list of IPv4 addresses as numbers: 127.0.0.1 is 0x7f000001. Its memory has a fixed size.
class AllowedAddresses {
 public:
  static const int MAX_RANGES = 32;

  /// At first, the list allows any address.
  AllowedAddresses() : number_of_ranges_(0) {}

  void AllowOnlyThisComputer();

  /// Reads a list as in RCSERVER.CFG: "ANY", or addresses separated by commas, each a.b.c.d or a.b.c.d/n. The latter
  /// means all addresses that have the same first n bits, 0 to 32. Spaces around a comma are ignored.
  /// @param list ends in a zero byte
  /// @return the problem in a few words, or NULL; if there is a problem, nothing has changed
  const char* Read(const char* list);

  bool Allow(unsigned address) const;

  bool IsAny() const { return number_of_ranges_ == 0; }

  /// The number of entries in the list; 0 if any address is allowed.
  int NumberOfEntries() const { return number_of_ranges_; }

  /// Room for one entry as text: "192.168.100.100/24" and a zero byte.
  static const size_t ENTRY_TEXT_SIZE = sizeof("255.255.255.255/32");

  /// Prints an entry as in RCSERVER.CFG, without the bits that do not matter: "192.168.1.0/24".
  /// @param entry 0..NumberOfEntries() - 1
  /// @param[out] text ends in a zero byte
  void PrintEntry(int entry, char (&text)[ENTRY_TEXT_SIZE]) const;

 private:
  struct Range {
    unsigned address;
    unsigned bits;  ///< how many of the first bits matter; the others are 0
  };

  static const char* ReadRange(const char** text, Range* range);

  Range ranges_[MAX_RANGES];
  int number_of_ranges_;  ///< 0: any address is allowed
};

#endif  // AIBO_RCSERVER_RCSERVER_SETTINGS_ALLOWED_ADDRESSES_H
