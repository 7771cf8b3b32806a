/// @file AllowedAddresses.h
/// Who may connect.
#ifndef AIBO_RCSERVER_RCSERVER_SETTINGS_ALLOWED_ADDRESSES_H
#define AIBO_RCSERVER_RCSERVER_SETTINGS_ALLOWED_ADDRESSES_H

/// Internet addresses of version 4, as numbers: 127.0.0.1 is 0x7f000001. Pure logic, memory of a fixed size.
class AllowedAddresses {
 public:
  /// Most entries of a list.
  static const int MAX_RANGES = 32;

  /// Any address.
  AllowedAddresses() : is_any_(true), number_of_ranges_(0) {}

  /// No address but 127.0.0.1.
  void AllowNobodyElse();

  /// Takes a list as RCSERVER.CFG has it: "ANY", or addresses with commas between them, each a.b.c.d or a.b.c.d/n,
  /// which is all addresses that agree with it in the first n bits, 0 to 32. Spaces beside a comma do not count.
  /// @param list ends in a zero byte
  /// @return what is wrong in a few words, or NULL; nothing has changed if anything is wrong
  const char* Read(const char* list);

  bool Allow(unsigned address) const;

 private:
  struct Range {
    unsigned address;
    unsigned mask;
  };

  static const char* ReadRange(const char** text, Range* range);

  bool is_any_;
  Range ranges_[MAX_RANGES];
  int number_of_ranges_;
};

#endif  // AIBO_RCSERVER_RCSERVER_SETTINGS_ALLOWED_ADDRESSES_H
