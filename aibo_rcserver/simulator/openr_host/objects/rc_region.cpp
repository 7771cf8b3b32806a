#include <OPENR/RCRegion.h>

#include <cstring>
#include <new>

RCRegion::RCRegion(size_t size)
    : memory_id_(0),
      offset_(0),
      base_(static_cast<char*>(::operator new(size))),
      size_(size),
      owns_memory_(true),
      references_(1) {
  std::memset(base_, 0, size);
}

RCRegion::RCRegion(MemoryRegionID memID, size_t offset, void* base, size_t size)
    : memory_id_(memID),
      offset_(offset),
      base_(static_cast<char*>(base)),
      size_(size),
      owns_memory_(false),
      references_(1) {}

RCRegion::~RCRegion() {
  if (owns_memory_) {
    ::operator delete(base_);
  }
}

void RCRegion::AddReference() {
  ++references_;
}

void RCRegion::RemoveReference() {
  if (--references_ == 0) {
    delete this;
  }
}
