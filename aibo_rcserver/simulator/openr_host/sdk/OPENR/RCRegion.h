/// @file RCRegion.h
/// Reference-counted memory, which several objects can read without copying.
#ifndef OPENR_RCREGION_H
#define OPENR_RCREGION_H

#include <OPENR/OPENR.h>

/// A reference-counted piece of memory. It starts with one reference, its creator's, and is deleted with the last one.
///
/// A creator that keeps its reference may fill the region again as soon as NumberOfReference() is 1: then all observers
/// are done with it.
class RCRegion {
 public:
  /// Allocates `size` bytes, all zero, aligned for any type.
  explicit RCRegion(size_t size);

  /// Refers to memory that is owned elsewhere and must outlive the region.
  /// @param memID, offset the system's name for the memory; only stored for the caller
  RCRegion(MemoryRegionID memID, size_t offset, void* base, size_t size);

  /// Call this to keep a region longer than the event that delivered it...
  void AddReference();

  /// ...and this when done with it. Deletes the region with the last reference.
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
