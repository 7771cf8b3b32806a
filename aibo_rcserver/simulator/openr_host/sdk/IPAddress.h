/// @file IPAddress.h
#ifndef OPENR_IPADDRESS_H
#define OPENR_IPADDRESS_H

#include <antTypes.h>

/// An address of IP version 4.
class IPAddress {
 public:
  IPAddress() : address_(0) {}
  // NOLINTBEGIN(google-explicit-constructor): as in the SDK
  /// @param address 127.0.0.1 is 0x7f000001
  IPAddress(uint32 address) : address_(address) {}
  IPAddress(int address) : address_(static_cast<uint32>(address)) {}
  /// @param text such as "127.0.0.1"; any other text gives 0.0.0.0
  IPAddress(const char* text);
  // NOLINTEND(google-explicit-constructor)
  /// 127.0.0.1 is IPAddress(127, 0, 0, 1).
  IPAddress(byte b1, byte b2, byte b3, byte b4)
      : address_(static_cast<uint32>(b1) << 24 | static_cast<uint32>(b2) << 16 | static_cast<uint32>(b3) << 8 | b4) {}

  /// 127.0.0.1 is 0x7f000001.
  uint32 Address() const { return address_; }

  /// @param[out] text at least 16 characters: "127.0.0.1"
  /// @return text
  char* GetAsString(char* text) const;

  bool operator==(const IPAddress& other) const { return address_ == other.address_; }
  bool operator!=(const IPAddress& other) const { return address_ != other.address_; }
  bool operator<(const IPAddress& other) const { return address_ < other.address_; }
  IPAddress operator&(const IPAddress& other) const { return IPAddress(address_ & other.address_); }

 private:
  uint32 address_;
};

typedef uint16 Port;

const IPAddress IP_ADDR_ANY(0);
const IPAddress IP_ADDR_BROADCAST(static_cast<uint32>(0xffffffffU));

/// A request for this port means any free one.
#define IP_PORT_ANY 0

#endif  // OPENR_IPADDRESS_H
