/// @file IPAddress.h
/// Internet addresses and ports.
#ifndef OPENR_IPADDRESS_H
#define OPENR_IPADDRESS_H

#include <OPENR/OPENR.h>

/// An address of version 4.
class IPAddress {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): as in the SDK
  IPAddress(longword address = 0) : address_(address) {}

  /// 127.0.0.1 is 0x7f000001.
  longword Address() const { return address_; }

  bool operator==(const IPAddress& other) const { return address_ == other.address_; }
  bool operator!=(const IPAddress& other) const { return address_ != other.address_; }

 private:
  longword address_;
};

typedef word Port;

const IPAddress IP_ADDR_ANY(0);

#endif  // OPENR_IPADDRESS_H
