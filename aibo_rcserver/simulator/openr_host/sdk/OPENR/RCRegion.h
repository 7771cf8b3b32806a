/// @file RCRegion.h
/// Memory that several objects read without copying, with a count of how many do.
#ifndef OPENR_RCREGION_H
#define OPENR_RCREGION_H

#include <OPENR/OPENR.h>

/// A reference-counted piece of memory. It begins with one reference, its maker's, and is deleted with the last one.
///
/// A maker who keeps a reference may fill the region again as soon as NumberOfReference() is 1 again: by then every
/// observer is done with it.
class RCRegion {
 public:
  /// Allocates `size` bytes, all zero, aligned for any type.
  explicit RCRegion(size_t size);

  /// Lends memory that is owned elsewhere and must outlive the region.
  /// @param memID, offset where the system knows the memory as; kept for the caller only
  RCRegion(MemoryRegionID memID, size_t offset, void* base, size_t size);

  /// Whoever keeps a region longer than the event that brought it adds a reference...
  void AddReference();

  /// ...and removes it later. Deletes the region with the last reference.
  void RemoveReference();

  int NumberOfReference() const { return references_; }

  char* Base() const { return base_; }
  size_t Size() const { return size_; }
  MemoryRegionID MemID() const { return memory_id_; }
  size_t Offset() const { return offset_; }

 private:
  ~RCRegion();
  RCRegion(const RCRegion&);
  RCRegion& operator=(const RCRegion&);

  MemoryRegionID memory_id_;
  size_t offset_;
  char* base_;
  size_t size_;
  bool owns_memory_;
  int references_;
};

#endif  // OPENR_RCREGION_H
