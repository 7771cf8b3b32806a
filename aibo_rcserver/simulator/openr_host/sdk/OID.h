/// @file OID.h
#ifndef OPENR_OID_H
#define OPENR_OID_H

#include <Types.h>

/// The identity of an object. Only the system creates valid ones; objects compare them and pass them on.
class OID {
 public:
  /// Makes an OID that identifies no object.
  OID() : address_(0) { MakeInvalid(); }
  // NOLINTNEXTLINE(google-explicit-constructor): as in the SDK
  OID(void* address) : address_(address) {}

  void SetAddress(void* address) { address_ = address; }
  void* GetAddress() const { return address_; }

  bool IsValid() const { return address_ != OID().address_; }
  void MakeInvalid() { address_ = reinterpret_cast<void*>(static_cast<size_t>(0xffffffffU)); }

  bool operator==(const OID& other) const { return address_ == other.address_; }
  bool operator!=(const OID& other) const { return address_ != other.address_; }
  bool operator<(const OID& other) const { return address_ < other.address_; }

 private:
  void* address_;
};

#endif  // OPENR_OID_H
